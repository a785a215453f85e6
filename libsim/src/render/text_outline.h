// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "render/painter.h"

/// Texts with characters beyond ASCII, as outlines of a font (docs/decisions/fonts.md).
namespace sim::render {

/// Whether a text has characters beyond ASCII.
[[nodiscard]] bool has_wide_characters(std::string_view text);

/// The characters of a text in UTF-8, U+FFFD for each byte that belongs to none.
[[nodiscard]] std::vector<std::uint32_t> code_points(std::string_view text);

/// Where the character ends that begins at `begin`, which must be less than the text's size.
[[nodiscard]] std::size_t end_of_character(std::string_view text, std::size_t begin);

/// Takes away the last character of a text as far as it is cut off.
void drop_cut_character(std::string& text);

/// A text as closed outlines.
struct TextOutline {
  std::vector<std::vector<Vec2>> contours;  ///< x right, y down, the base line at y = 0 [pixels]
  double width_px = 0.0;
};

/// The outline of a line of text, its base line beginning at (0, 0). A character that the font does
/// not have is an upright box; a control character is blank.
[[nodiscard]] TextOutline text_outline(std::string_view text, double cap_height_px);

}  // namespace sim::render
