// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>

/// Player's interfaces: their codes, their names and the messages that are supported.
namespace PlayerCc {

/// Whether the proxies of an interface receive or send such messages.
[[nodiscard]] bool has_message(uint32_t interface, uint32_t type, uint32_t subtype) noexcept;
/// The name of an interface code; null if there is none.
[[nodiscard]] const char* interface_name(int code) noexcept;
/// The code of an interface name; nullopt if there is none.
[[nodiscard]] std::optional<int> interface_code(const std::string& name) noexcept;

}  // namespace PlayerCc
