// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "sim/core/colour.h"
#include "sim/core/pose.h"
#include "sim/render/render.h"

namespace sim::render {

/// A white page for charts with lines, areas, texts and pictures. It can be rendered as a picture
/// and as SVG. Coordinates are pixels, x right, y down; (0, 0) is the top left corner. Not
/// thread-safe. Deterministic; runs on the calling thread.
class Drawing {
 public:
  /// The point of a text that its `place` defines.
  enum class Align { kLeft, kMiddle, kRight };

  /// @throws std::invalid_argument unless each side is in 64..8192 pixels.
  Drawing(int width_px, int height_px);

  /// Adds a line through points. The dashes of a dashed line are four times as long as its width.
  void add_line(std::vector<Vec2> points, Colour colour, double width_px, bool dashed = false);
  /// Adds a filled polygon.
  void add_area(std::vector<Vec2> corners, Colour colour);
  /// Adds a line of text in UTF-8.
  /// @param place  an end or the middle of the base line.
  /// @param cap_height_px  height of a capital letter.
  void add_text(std::string text, const Vec2& place, double cap_height_px, Colour colour,
                Align align = Align::kLeft);
  /// Adds a picture without scaling. @param place  top left corner, rounded to whole pixels.
  void add_picture(Image image, const Vec2& place);

  /// Returns the length of a line of text in pictures [pixels].
  [[nodiscard]] static double text_width_px(const std::string& text, double cap_height_px);

  /// Returns the page as a picture.
  [[nodiscard]] Image image() const;
  /// Returns the page as SVG 1.1 with embedded pictures. Texts use the font of the viewer.
  [[nodiscard]] std::string svg() const;

 private:
  struct Line {
    std::vector<Vec2> points;
    Colour colour;
    double width_px;
    bool dashed;
  };
  struct Area {
    std::vector<Vec2> corners;
    Colour colour;
  };
  struct Text {
    std::string text;
    Vec2 place;
    double cap_height_px;
    Colour colour;
    Align align;
  };
  struct Picture {
    Image image;
    int left;
    int top;
  };
  using Item = std::variant<Line, Area, Text, Picture>;

  struct PixelWriter;
  struct SvgWriter;

  int width_;
  int height_;
  std::vector<Item> items_;  // in drawing order
};

/// Returns the colour with the given number, from 0, of a series of distinguishable colours.
[[nodiscard]] Colour distinct_colour(std::size_t number);

}  // namespace sim::render
