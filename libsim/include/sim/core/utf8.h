// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

/// UTF-8 as defined by the Unicode Standard 15 (table 3-7: no overlong forms, no surrogates,
/// nothing above U+10FFFF).
namespace sim {

/// Number of bytes of the text's first character, 1 to 4; 0 if the text is empty or starts with an
/// invalid sequence.
[[nodiscard]] std::size_t utf8_length(std::string_view text) noexcept;

/// Offset of the first byte that starts no valid character, or npos.
[[nodiscard]] std::size_t find_invalid_utf8(std::string_view text) noexcept;

/// Replaces each byte that starts no valid character by "\xNN", for messages with names from
/// outside.
[[nodiscard]] std::string escape_invalid_utf8(std::string_view text);

}  // namespace sim
