// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "render/painter.h"

/// Outlines of texts with non-ASCII characters (docs/decisions/fonts.md).
namespace sim::render {

/// Returns whether a text contains non-ASCII characters.
[[nodiscard]] bool has_wide_characters(std::string_view text);

/// Decodes a text in UTF-8. Each invalid byte becomes U+FFFD.
[[nodiscard]] std::vector<std::uint32_t> code_points(std::string_view text);

/// Returns the end of the character that begins at `begin`.
/// @pre begin < text.size()
[[nodiscard]] std::size_t end_of_character(std::string_view text, std::size_t begin);

/// Removes an incomplete character from the end of a text.
void drop_cut_character(std::string& text);

/// A text as closed outlines.
struct TextOutline {
  std::vector<std::vector<Vec2>> contours;  ///< x right, y down, base line at y = 0 [pixels]
  double width_px = 0.0;
};

/// Returns the outline of a line of text whose base line begins at (0, 0). An upright box replaces
/// a character that the font does not contain. A control character is blank.
[[nodiscard]] TextOutline text_outline(std::string_view text, double cap_height_px);

}  // namespace sim::render
