// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>

/// What the command must know of the terminal that it writes to.
namespace playpen {

/// Columns of text where no terminal says how many there are.
inline constexpr std::size_t kUsualColumns = 80;

/// Whether a descriptor is a terminal, and how many columns that has; kUsualColumns if it is none
/// or does not say.
/// @param descriptor  for example STDOUT_FILENO.
[[nodiscard]] std::size_t terminal_columns(int descriptor);

/// Whether text for a descriptor may be coloured: it is a terminal that can, and the user has not
/// set NO_COLOR (https://no-color.org).
[[nodiscard]] bool shows_colour(int descriptor);

/// A text in lines of at most `columns - indent` characters, all but the first of which begin with
/// `indent` blanks. Lines break at blanks; a longer word has a line of its own.
[[nodiscard]] std::string wrapped(const std::string& text, std::size_t columns, std::size_t indent);

/// A word as a shell reads it: in single quotes if it needs them.
[[nodiscard]] std::string shell_word(const std::string& word);

/// What is printed in colour, if it is.
enum class Tint { kGood, kBad, kWarning, kStrong };

/// A text in colour, or as it is.
[[nodiscard]] std::string tinted(const std::string& text, Tint tint, bool colour);

}  // namespace playpen
