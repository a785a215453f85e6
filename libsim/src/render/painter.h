// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "sim/core/colour.h"
#include "sim/core/pose.h"
#include "sim/render/render.h"

namespace sim::render {

/// Whether a point is finite and within 1e9 pixels of the picture's origin, where doubles still
/// resolve a millionth of a pixel.
[[nodiscard]] inline bool is_drawable(const Vec2& point) {
  constexpr double kFarthest = 1e9;
  return std::abs(point.x()) < kFarthest && std::abs(point.y()) < kFarthest;
}

/// An area of a picture, bounded by straight edges. Coordinates are pixels, x right and y down. (0,
/// 0) is the top left corner of the top left pixel, whose centre is (0.5, 0.5).
///
/// A shape covers the points with a non-zero winding number, summed over its outlines. So a ring is
/// an outline with another one of opposite orientation inside, and pieces of equal orientation may
/// overlap.
class Shape {
 public:
  struct Edge {
    Vec2 from;
    Vec2 to;
  };

  /// Adds a closed outline with its own orientation.
  void add_outline(const std::vector<Vec2>& points);
  /// Adds a closed outline without self-intersections, oriented like all pieces, so that pieces
  /// unite.
  void add_piece(std::vector<Vec2> points);
  void add_disc(const Vec2& center, double radius_px);
  /// Adds a line with round ends and joints, as pieces. (Joints with a very small angle get no
  /// disc, which would be invisible.)
  void add_line(const std::vector<Vec2>& points, double width_px, bool closed = false);
  /// Like add_line for a closed outline, dashed so that every corner lies within a dash.
  void add_dashed_outline(const std::vector<Vec2>& points, double width_px, double dash_px);

  /// Adds a copy of another shape, shifted by `offset`.
  void append(const Shape& other, const Vec2& offset);
  /// Cuts out a shape that lies within this one.
  void cut(const Shape& hole);

  [[nodiscard]] const std::vector<Edge>& edges() const { return edges_; }

 private:
  std::vector<Edge> edges_;
};

/// Style of a line of text.
struct TextStyle {
  double cap_height_px = 12.0;  ///< height of a capital letter
  double weight = 0.13;         ///< stroke width as a fraction of the cap height
  Colour colour;
  double halo_px = 0.0;  ///< width of a rim that separates the text from the background; 0: none
  Colour halo;
};

/// Change of a pixel: each channel becomes (below * keep + add) >> 16.
struct Blend {
  std::uint32_t keep = 1U << 16;                                   ///< 0..2^16
  std::array<std::uint32_t, 3> add = {1 << 15, 1 << 15, 1 << 15};  ///< with 1/2 for rounding

  /// @param kept   weight of the pixel below, in [0, 1].
  /// @param added  value to add, 0..255 * (1 - kept).
  static Blend of(float kept, const std::array<float, 3>& added) {
    constexpr float kOne = 65536.0F;
    const auto whole = [](float value) { return static_cast<std::uint32_t>(value * kOne + 0.5F); };
    constexpr std::uint32_t kHalf = 1 << 15;
    return {whole(kept),
            {whole(added[0]) + kHalf, whole(added[1]) + kHalf, whole(added[2]) + kHalf}};
  }
  void apply(std::uint8_t* pixel) const {
    for (std::size_t i = 0; i < 3; ++i) {
      pixel[i] = static_cast<std::uint8_t>((pixel[i] * keep + add[i]) >> 16);
    }
  }
};

/// Columns [left, right) and rows [top, bottom) of a picture.
struct PixelRect {
  int left = 0;
  int top = 0;
  int right = 0;
  int bottom = 0;

  friend bool operator==(const PixelRect&, const PixelRect&) = default;
};

/// Computes which pixels a shape covers, and the exact covered area of each.
class Rasteriser {
 public:
  /// Calls visit(y, x_begin, x_end, coverage) for every run of pixels of a row within `clip` with
  /// the same non-zero coverage.
  template <typename Visitor>
  void rasterise(const Shape& shape, const PixelRect& clip, Visitor visit);

  /// The columns [begin, end) of a row that edges have changed; begin is at least end if none.
  struct Extent {
    int begin = 0;
    int end = 0;
  };

 private:
  std::vector<float> cells_;  // all zero between calls
  std::vector<Extent> extents_;
};

/// A precomputed drawing that can be laid over many pictures: its effect on each pixel.
class Overlay {
 public:
  /// The drawing surface for making an overlay; used like a Painter.
  class Canvas {
   public:
    /// Like Painter::fill.
    void fill(const Shape& shape, Colour colour, double opacity = 1.0);

   private:
    friend class Overlay;
    struct Span {
      int y = 0;
      int begin = 0;  // columns
      int end = 0;
      float share = 0.0F;  // of the colour
      Colour colour;
    };
    PixelRect whole_;
    std::vector<Span> spans_;  // in the order of drawing
    Rasteriser rasteriser_;
  };

  Overlay() = default;
  /// @param draw  called once with a Canvas, on which it draws.
  Overlay(int width, int height, const std::function<void(Canvas&)>& draw);

  /// Applies the overlay to a part of a picture of its size.
  void draw_on(Image& image, const PixelRect& part) const;
  /// The area of a part of the picture that the overlay hides, in pixels.
  [[nodiscard]] double hidden_px(const PixelRect& part) const;

 private:
  struct Run {
    int begin = 0;  // columns
    int end = 0;
    bool opaque = false;
    std::size_t first = 0;  // index in bytes_ if opaque, otherwise in blends_
  };
  void add_run(int begin, std::span<const std::array<float, 4>> pixels, bool opaque);

  std::vector<Run> runs_;            // sorted by row, then by column
  std::vector<std::size_t> row_{0};  // index of the first run of each row, and the end
  std::vector<std::uint8_t> bytes_;
  std::vector<Blend> blends_;
};

/// Draws shapes and text on a picture, anti-aliased by the exact area of each pixel that a shape
/// covers.
///
/// Everything runs on the calling thread. This is also why filling is implemented here: OpenCV's
/// scaling, colour conversion and filters use its thread pool, whose size can only be set for the
/// whole process (cv::setNumThreads), and a library must not do that in a client's program. Of
/// OpenCV only putText is used, which is single-threaded.
class Painter {
 public:
  Painter(int width, int height, Colour background);

  [[nodiscard]] const Image& image() const { return image_; }
  [[nodiscard]] Image& image() { return image_; }

  /// Blends a colour over the shape. The opacity, in [0, 1], multiplies the colour's alpha.
  void fill(const Shape& shape, Colour colour, double opacity = 1.0);
  /// Fills a ring whose line is centred on the circle of `radius_px`.
  void fill_ring(const Vec2& center, double radius_px, double width_px, Colour colour);
  /// Like fill, but the opacity falls with the square of the distance from `center`, from
  /// `opacity_center` there to `opacity_rim` at `radius_px` and beyond.
  void fill_fading(const Shape& shape, Colour colour, const Vec2& center, double radius_px,
                   double opacity_center, double opacity_rim);
  /// Records a shape to be drawn with some opacity. Where recorded shapes overlap, the highest
  /// opacity counts.
  void accumulate(const Shape& shape, double opacity);
  /// Blends a colour over all shapes recorded since the last call.
  void fill_accumulated(Colour colour);
  /// Limits the drawing of shapes (not text) to a rectangle from now on.
  void set_clip(const PixelRect& clip);
  void clear_clip() { set_clip({0, 0, image_.width, image_.height}); }

  /// Length of a line of text [pixels].
  [[nodiscard]] static double text_width_px(const std::string& text, const TextStyle& style);
  /// Draws a line of text in UTF-8 whose base line begins at `start`. ASCII texts are drawn as
  /// strokes, all other texts as outlines of a font (text_outline.h). Rendered texts are cached, so
  /// repeated texts cost less.
  void draw_text(const std::string& text, const Vec2& start, const TextStyle& style);

 private:
  /// Coverage of each pixel around a text by its strokes: 0..2^16.
  struct TextMask {
    int left = 0;  ///< relative to the start, rounded down [pixels]
    int top = 0;
    int width = 0;
    int height = 0;
    std::vector<std::uint32_t> coverage;  ///< row-major
  };
  [[nodiscard]] static TextMask make_text_mask(const std::string& text, const TextStyle& style,
                                               int quarter_px, double rim_px);
  [[nodiscard]] static TextMask make_outline_mask(const std::string& text, const TextStyle& style,
                                                  int quarter_px, double rim_px);
  void fill(const TextMask& mask, int left, int top, Colour colour);

  /// Blends a colour over the pixels of a row from x_begin to x_end.
  void blend(int y, int x_begin, int x_end, Colour colour, float opacity);
  [[nodiscard]] std::uint8_t* pixel(int x, int y) {
    return image_.rgb.data() +
           3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image_.width) +
                static_cast<std::size_t>(x));
  }

  Image image_;
  PixelRect clip_;
  Rasteriser rasteriser_;
  /// Pixels of a row with the same opacity.
  struct Stretch {
    int y;
    int begin;  // columns
    int end;
    float opacity;
  };
  std::vector<Stretch> accumulated_;  ///< since the last fill_accumulated()
  std::map<std::string, TextMask> texts_;
};

}  // namespace sim::render
