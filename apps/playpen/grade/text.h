// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace playpen::grade {

/// A number with the given number of decimals, or with more if rounding would make it equal to a
/// limit that it differs from: 0.97996 is not "0.980" beside a limit of 0.98.
[[nodiscard]] std::string telling_number(double value, double limit, int decimals);

/// A text without control characters and invalid UTF-8, for names and reasons that come from
/// programs and their authors.
[[nodiscard]] std::string plain_text(const std::string& text);

/// Whether a byte of a UTF-8 text is the first one of a character.
[[nodiscard]] constexpr bool begins_character(char c) noexcept {
  return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U;
}

/// The number of characters of a UTF-8 text.
[[nodiscard]] std::size_t character_count(const std::string& text);

/// A text with &, <, >, " and ' as references of HTML and XML.
[[nodiscard]] std::string markup_escaped(std::string_view text);

/// A value of a CSV file (RFC 4180), as plain_text(). An apostrophe precedes a text that
/// spreadsheets would take for a formula.
[[nodiscard]] std::string csv_value(const std::string& text);

/// Quotes a word for the shell, if necessary.
[[nodiscard]] std::string shell_word(const std::string& word);

/// Writes a file of results, with the folders that are missing, and replaces an existing one.
/// @throws std::runtime_error that names the file.
void write_text_file(const std::filesystem::path& file, std::string_view text);

}  // namespace playpen::grade
