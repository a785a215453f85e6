// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

/// Texts of submissions in HTML pages. Whatever they contain, they stay text.
namespace playpen::course {

/// A text for the content of an element of HTML or XML, or for an attribute in double quotes:
/// without control characters (see plain_text()), and with &, <, >, " and ' as references.
[[nodiscard]] std::string html_escaped(const std::string& text);

/// A relative path as a URL: each byte but letters, digits and -._~/ is percent-encoded (RFC 3986).
[[nodiscard]] std::string url_of(const std::filesystem::path& path);

/// What a terminal would show of a program's output, as far as it is text: escape sequences
/// (ECMA-48) are removed, of a line that was overwritten by carriage returns the last version
/// remains, tabs become blanks, and other control characters "?".
[[nodiscard]] std::string terminal_text(std::string_view output);

/// The end of a log.
struct LogTail {
  std::string text;      ///< see terminal_text(); "": the file is empty or missing
  bool is_whole = true;  ///< false: the file begins with more
};

/// Reads the last lines of a log. Symbolic links are not followed.
/// @param most_lines  maximum number of lines; longer lines than 500 bytes are cut.
[[nodiscard]] LogTail tail_of(const std::filesystem::path& file, std::size_t most_lines);

}  // namespace playpen::course
