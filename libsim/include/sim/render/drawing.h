// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
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

/// Colours of the parts that all pages share.
namespace page_palette {
inline constexpr Colour kInk{0x35, 0x38, 0x3d};       ///< of titles and names
inline constexpr Colour kFaintInk{0x6d, 0x6f, 0x72};  ///< of numbers and notes
inline constexpr Colour kGrid{0xe4, 0xe4, 0xe2};      ///< of lines at ticks
inline constexpr Colour kFrame{0xb4, 0xb6, 0xb8};     ///< of axes
}  // namespace page_palette

/// Returns the colour with the given number, from 0, of a series of distinguishable colours.
[[nodiscard]] Colour distinct_colour(std::size_t number);

/// A number on an axis.
struct Tick {
  double value = 0.0;
  std::string text;  ///< the value, with as many digits as tell the axis's ticks apart
};

/// Returns the ticks of an axis: round, evenly spaced numbers in [least, most], 1, 2 or 5 times a
/// power of ten apart.
/// @param count  approximate number of ticks, >= 1; never exceeded by more than one.
/// @return empty unless least < most, or if doubles cannot resolve the range (1e-12 of the
/// numbers).
[[nodiscard]] std::vector<Tick> ticks(double least, double most, int count);

}  // namespace sim::render
