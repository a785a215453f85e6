// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "render/layout.h"
#include "render/painter.h"

/// Boxes with centred lines of text.
namespace sim::render {

/// Returns a text with control characters replaced by blanks, because the painter cannot draw them.
[[nodiscard]] std::string printable(const std::string& text);

/// Wraps a text into at most `most_lines` lines, broken between words; dots replace what does not
/// fit. A word that is longer than a line is broken.
[[nodiscard]] std::vector<std::string> wrapped(const std::string& text, const TextStyle& style,
                                               double width_px, int most_lines);

/// The corners of a rectangle with round corners.
[[nodiscard]] std::vector<Vec2> rounded(const Rectangle& place, double radius_px);

/// Centred lines of text in a rectangle.
struct TextBox {
  std::vector<std::string> lines;
  TextStyle style;
  double padding_px = 0.0;
  double line_px = 0.0;  ///< from one base line to the next
  Rectangle place;

  TextBox() = default;
  TextBox(std::vector<std::string> text_lines, const TextStyle& text_style);

  /// Half of the width and height that the lines need, with the padding.
  [[nodiscard]] Vec2 half_size() const;
  /// Draws the lines at the box's place.
  void draw_lines(Painter& painter) const;
};

}  // namespace sim::render
