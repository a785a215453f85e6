// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sim {

/// Encodes bytes as base64 (RFC 4648, section 4), with padding. Thread-safe.
[[nodiscard]] std::string to_base64(std::span<const std::uint8_t> bytes);

/// Decodes base64; nullopt unless to_base64() could have written the text. Thread-safe.
[[nodiscard]] std::optional<std::vector<std::uint8_t>> from_base64(std::string_view text);

}  // namespace sim
