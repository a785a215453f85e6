// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "sim/core/colour.h"
#include "sim/core/pose.h"
#include "sim/render/render.h"

namespace sim::render {

/// Whether a point is finite and not absurdly far off the picture: nearer than 1e9 pixels, where
/// doubles still tell a millionth of a pixel.
[[nodiscard]] inline bool is_drawable(const Vec2& point) {
  constexpr double kFarthest = 1e9;
  return std::abs(point.x()) < kFarthest && std::abs(point.y()) < kFarthest;
}

/// An area of a picture, bounded by straight edges. Coordinates are pixels, x right and y down,
/// (0, 0) being the top left corner of the top left pixel (whose centre is (0.5, 0.5)).
///
/// What it covers: everything that its outlines wind round, where outlines add up by their sense
/// of turning. So a ring is an outline with one of the other sense inside, and pieces that turn
/// alike may overlap.
class Shape {
 public:
  struct Edge {
    Vec2 from;
    Vec2 to;
  };

  /// A closed outline, with the sense of turning it has.
  void add_outline(const std::vector<Vec2>& points);
  /// A closed outline without crossings, turned the way all pieces are: pieces unite.
  void add_piece(std::vector<Vec2> points);
  void add_disc(const Vec2& center, double radius_px);
  /// A line of some width with round joints and ends, as pieces.
  void add_line(const std::vector<Vec2>& points, double width_px, bool closed = false);
  /// As add_line for a closed outline, dashed so that every corner lies within a dash.
  void add_dashed_outline(const std::vector<Vec2>& points, double width_px, double dash_px);

  /// Another shape as it is, moved.
  void append(const Shape& other, const Vec2& offset);
  /// Cuts out a shape that lies within this one.
  void cut(const Shape& hole);

  [[nodiscard]] const std::vector<Edge>& edges() const { return edges_; }

 private:
  std::vector<Edge> edges_;
};

/// How much of each pixel of a part of the picture something covers, in [0, 1].
struct Mask {
  int left = 0;  ///< of the part in the picture [pixels]
  int top = 0;
  int width = 0;
  int height = 0;
  std::vector<float> coverage;  ///< row-major, width * height
};

/// How a line of text looks.
struct TextStyle {
  double cap_height_px = 12.0;  ///< height of a capital letter
  double weight = 0.13;         ///< width of its strokes as a share of that height
  Colour colour;
  double halo_px = 0.0;  ///< width of a rim that sets it off from what is below; 0: none
  Colour halo;
};

/// Draws shapes and text on a picture, anti-aliased by the exact area that a shape covers of each
/// pixel.
///
/// All of it runs on the calling thread. The filling is our own for that reason, too: OpenCV's
/// scaling, colour conversion and filters use its pool of threads, whose size can only be set for
/// a whole process (cv::setNumThreads), which is not ours to do within a client's program. Of
/// OpenCV, only putText is used, which has no parallel part.
class Painter {
 public:
  Painter(int width, int height, Colour background);

  [[nodiscard]] const Image& image() const { return image_; }
  [[nodiscard]] Image take() && { return std::move(image_); }

  /// Lays a colour over the shape. Opacity, in [0, 1], comes on top of the colour's alpha.
  void fill(const Shape& shape, Colour colour, double opacity = 1.0);
  void fill(const Mask& mask, Colour colour, double opacity = 1.0);
  /// As fill, the opacity falling with the square of the distance from `center`, from
  /// `opacity_center` there to `opacity_rim` at `radius_px` and beyond.
  void fill_fading(const Shape& shape, Colour colour, const Vec2& center, double radius_px,
                   double opacity_center, double opacity_rim);
  /// From now on shapes (not text) are only drawn in [left, right) x [top, bottom).
  void set_clip(int left, int top, int right, int bottom);
  void clear_clip() { set_clip(0, 0, image_.width, image_.height); }

  /// Lays one colour over one pixel.
  void blend(int x, int y, Colour colour, float opacity) {
    const float share = opacity * static_cast<float>(colour.a) * (1.0F / 255.0F);
    std::uint8_t* const pixel =
        image_.rgb.data() +
        3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image_.width) +
             static_cast<std::size_t>(x));
    pixel[0] = mix(pixel[0], colour.r, share);
    pixel[1] = mix(pixel[1], colour.g, share);
    pixel[2] = mix(pixel[2], colour.b, share);
  }

  /// What the shape covers within the clip.
  [[nodiscard]] Mask mask(const Shape& shape);

  /// Length of a line of text [pixels].
  [[nodiscard]] static double text_width_px(const std::string& text, const TextStyle& style);
  /// Writes a line of ASCII text (other characters become '?'), its base line beginning at `start`.
  void draw_text(const std::string& text, const Vec2& start, const TextStyle& style);

 private:
  static std::uint8_t mix(std::uint8_t below, std::uint8_t above, float share) {
    const auto from = static_cast<float>(below);
    // Rounds right: the sum is positive. lround would be called once a pixel.
    // NOLINTNEXTLINE(bugprone-incorrect-roundings)
    return static_cast<std::uint8_t>(from + (static_cast<float>(above) - from) * share + 0.5F);
  }
  /// Calls visit(x, y, coverage) for every pixel that the shape covers in part or whole.
  template <typename Visitor>
  void rasterise(const Shape& shape, Visitor visit);
  /// The part of the picture in which the shape may cover something; no coverage yet.
  [[nodiscard]] Mask bounds(const Shape& shape) const;

  Image image_;
  int clip_left_ = 0;
  int clip_top_ = 0;
  int clip_right_ = 0;
  int clip_bottom_ = 0;
  std::vector<float> cells_;  ///< for rasterise; all zero between calls
};

}  // namespace sim::render
