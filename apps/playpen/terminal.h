// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>

#include "grade/text.h"

/// Properties of the terminal that the command writes to.
namespace playpen {

/// Default width [columns of text] where no terminal reports one.
inline constexpr std::size_t kUsualColumns = 80;

/// Whether a descriptor is a terminal, and its number of columns; kUsualColumns if it is not a
/// terminal or does not report a width.
/// @param descriptor  for example STDOUT_FILENO.
[[nodiscard]] std::size_t terminal_columns(int descriptor);

/// Whether text for a descriptor may be coloured: it is a terminal with colours, and the user has
/// not set NO_COLOR (https://no-color.org).
[[nodiscard]] bool shows_colour(int descriptor);

/// Wraps a text into lines of at most `columns - indent` characters; all lines but the first begin
/// with `indent` blanks. Lines break at blanks; a longer word gets its own line.
[[nodiscard]] std::string wrapped(const std::string& text, std::size_t columns, std::size_t indent);

using grade::shell_word;

/// Meaning of a text, for its colour.
enum class Tint { kGood, kBad, kWarning, kStrong };

/// A text in colour, or unchanged.
[[nodiscard]] std::string tinted(const std::string& text, Tint tint, bool colour);

}  // namespace playpen
