// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string_view>

/// UTF-8 as the Unicode Standard 15 has it (table 3-7: no overlong forms, no surrogates, nothing
/// above U+10FFFF).
namespace sim {

/// Bytes of the character that a text begins with, 1 to 4; 0 if it begins with none, or is empty.
[[nodiscard]] std::size_t utf8_length(std::string_view text) noexcept;

/// Offset of the first byte that begins no character, or npos.
[[nodiscard]] std::size_t find_invalid_utf8(std::string_view text) noexcept;

}  // namespace sim
