// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "sim/core/colour.h"
#include "sim/core/pose.h"
#include "sim/render/render.h"

namespace sim::render {

/// Lines, areas, texts and pictures on a white page, for charts: the same page as a picture and as
/// SVG. Coordinates are pixels, x right and y down, (0, 0) being the top left corner.
/// Not thread-safe. Deterministic, on the calling thread.
class Drawing {
 public:
  /// Which end of a text stands at its place.
  enum class Align { kLeft, kMiddle, kRight };

  /// @throws std::invalid_argument unless each side is in 64..8192 pixels.
  Drawing(int width_px, int height_px);

  /// A line through points; one that is dashed has dashes of four times its width.
  void add_line(std::vector<Vec2> points, Colour colour, double width_px, bool dashed = false);
  /// A filled area with straight edges.
  void add_area(std::vector<Vec2> corners, Colour colour);
  /// A line of text in UTF-8.
  /// @param place  an end or the middle of its base line.
  /// @param cap_height_px  height of a capital letter.
  void add_text(std::string text, const Vec2& place, double cap_height_px, Colour colour,
                Align align = Align::kLeft);
  /// A picture at its own size. @param place  of its top left corner, rounded to whole pixels.
  void add_picture(Image image, const Vec2& place);

  /// Length of a line of text as a picture has it [pixels].
  [[nodiscard]] static double text_width_px(const std::string& text, double cap_height_px);

  /// The page as a picture.
  [[nodiscard]] Image image() const;
  /// The page as SVG 1.1, with the pictures in it. Its letters are those of the viewer's font.
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
  std::vector<Item> items_;  // in the order in which they lie over one another
};

/// One of many colours that can be told apart, for the thing of that number, from 0.
[[nodiscard]] Colour distinct_colour(std::size_t number);

}  // namespace sim::render
