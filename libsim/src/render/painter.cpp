// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "render/painter.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <utility>

namespace sim::render {
namespace {

// Text is drawn this many times too large and averaged: finer than putText's own smoothing, and
// widths of strokes come in quarters of a pixel.
constexpr int kTextOversampling = 4;
constexpr int kFont = cv::FONT_HERSHEY_SIMPLEX;
constexpr double kFontCapHeight = 21.0;  // of that font at scale 1 [pixels]
constexpr std::size_t kMaxTextLength = 256;

double font_scale(const TextStyle& style) {
  return style.cap_height_px * kTextOversampling / kFontCapHeight;
}

int stroke_width(const TextStyle& style, double rim_px) {
  const double width_px = style.cap_height_px * style.weight + 2.0 * rim_px;
  return std::max(1, static_cast<int>(std::lround(width_px * kTextOversampling)));
}

struct Word {
  std::string text;
  double start_px;
  double width_px;
};

// Words with their places. The font's own space is as wide as a letter, which looks like a gap.
std::vector<Word> words_of(const std::string& text, const TextStyle& style) {
  constexpr double kSpace = 0.5;  // as a share of the height of capitals
  std::vector<Word> words;
  double at_px = 0.0;
  const std::size_t length = std::min(text.size(), kMaxTextLength);
  for (std::size_t begin = 0; begin < length;) {
    const std::size_t end = std::min(text.find(' ', begin), length);
    if (end > begin) {
      int baseline = 0;
      const std::string word = text.substr(begin, end - begin);
      const cv::Size size =
          cv::getTextSize(word, kFont, font_scale(style), stroke_width(style, 0.0), &baseline);
      const double width_px = static_cast<double>(size.width) / kTextOversampling;
      words.push_back({word, at_px, width_px});
      at_px += width_px;
    }
    at_px += kSpace * style.cap_height_px;
    begin = end + 1;
  }
  return words;
}

double signed_area(const std::vector<Vec2>& points) {
  double twice = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec2& a = points[i];
    const Vec2& b = points[(i + 1) % points.size()];
    twice += a.x() * b.y() - b.x() * a.y();
  }
  return 0.5 * twice;
}

// Sums up what edges contribute to the pixels of a part of the picture. An edge covers, in each
// row it crosses, what lies to its right, counted positive downwards and negative upwards. Cell
// (x, y) holds the change of that from pixel x - 1 to pixel x, so that a running sum along the row
// gives the covered area of each pixel exactly.
class Accumulator {
 public:
  // `cells` must hold (width + 1) * height zeros.
  Accumulator(int width, int height, float* cells)
      : width_(width),
        height_(height),
        stride_(static_cast<std::size_t>(width) + 1),
        cells_(cells) {}

  void add(Vec2 from, Vec2 to) {
    if (from.y() == to.y()) return;
    const bool up = from.y() > to.y();
    if (up) std::swap(from, to);
    if (to.y() <= 0.0 || from.y() >= height_) return;
    const double slope = (to.x() - from.x()) / (to.y() - from.y());
    const double y_end = std::min(to.y(), static_cast<double>(height_));
    double y = std::max(from.y(), 0.0);
    double x = from.x() + (y - from.y()) * slope;
    for (int row = static_cast<int>(y); row < height_ && y < y_end; ++row) {
      const double y_next = std::min(y_end, row + 1.0);
      const double x_next = y_next == to.y() ? to.x() : from.x() + (y_next - from.y()) * slope;
      add_in_row(row, x, x_next, up ? y - y_next : y_next - y);
      y = y_next;
      x = x_next;
    }
  }

  // Calls visit(x, y, coverage) where there is any, row by row, and sets all cells back to zero.
  template <typename Visitor>
  void visit_and_clear(Visitor visit) {
    constexpr float kLeast = 1.0F / 2048.0F;  // less than that is rounding, and would not show
    for (int y = 0; y < height_; ++y) {
      float* const cell = cells_ + static_cast<std::size_t>(y) * stride_;
      float total = 0.0F;
      for (int x = 0; x < width_; ++x) {
        total += cell[x];
        cell[x] = 0.0F;
        const float covered = std::abs(total);
        if (covered > kLeast) visit(x, y, std::min(covered, 1.0F));
      }
      cell[width_] = 0.0F;
    }
  }

 private:
  // Part of an edge within one row, from x0 to x1, of (signed) height dy.
  void add_in_row(int row, double x0, double x1, double dy) {
    float* const cells = cells_ + static_cast<std::size_t>(row) * stride_;
    if (x0 > x1) std::swap(x0, x1);
    if (x0 >= width_) return;
    if (x1 <= 0.0) {
      cells[0] += static_cast<float>(dy);
      return;
    }
    const double dy_dx = x1 > x0 ? dy / (x1 - x0) : 0.0;
    if (x0 < 0.0) {
      cells[0] += static_cast<float>(-x0 * dy_dx);
      dy += x0 * dy_dx;
      x0 = 0.0;
    }
    if (x1 > width_) {
      dy -= (x1 - width_) * dy_dx;
      x1 = width_;
    }
    const int last = std::min(static_cast<int>(x1), width_ - 1);
    for (int column = static_cast<int>(x0); column <= last; ++column) {
      const double x_next = column == last ? x1 : column + 1.0;
      const double part = x1 > x0 && column < last ? (x_next - x0) * dy_dx : dy;
      const double middle = 0.5 * (x0 + x_next) - column;
      cells[column] += static_cast<float>(part * (1.0 - middle));
      cells[column + 1] += static_cast<float>(part * middle);
      dy -= part;
      x0 = x_next;
    }
  }

  int width_;
  int height_;
  std::size_t stride_;
  float* cells_;
};

}  // namespace

void Shape::add_outline(const std::vector<Vec2>& points) {
  for (const Vec2& point : points) {
    if (!is_drawable(point)) return;
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    edges_.push_back({points[i], points[(i + 1) % points.size()]});
  }
}

void Shape::add_piece(std::vector<Vec2> points) {
  if (signed_area(points) < 0.0) std::reverse(points.begin(), points.end());
  add_outline(points);
}

void Shape::add_disc(const Vec2& center, double radius_px) {
  // So many corners that the polygon is less than 1/20 pixel off the circle.
  const int corners = std::clamp(static_cast<int>(std::ceil(10.0 * std::sqrt(radius_px))), 8, 256);
  std::vector<Vec2> points;
  points.reserve(static_cast<std::size_t>(corners));
  for (int i = 0; i < corners; ++i) {
    const double angle_rad = 2.0 * std::numbers::pi * i / corners;
    points.emplace_back(center.x() + radius_px * std::cos(angle_rad),
                        center.y() + radius_px * std::sin(angle_rad));
  }
  add_piece(std::move(points));
}

void Shape::add_line(const std::vector<Vec2>& points, double width_px, bool closed) {
  const std::size_t segments = closed || points.empty() ? points.size() : points.size() - 1;
  for (std::size_t i = 0; i < segments; ++i) {
    const Vec2& a = points[i];
    const Vec2& b = points[(i + 1) % points.size()];
    const Vec2 along = b - a;
    const double length = along.norm();
    if (!(length > 0.0)) continue;
    const Vec2 side = Vec2(-along.y(), along.x()) * (0.5 * width_px / length);
    add_piece({a + side, b + side, b - side, a - side});
  }
  for (const Vec2& point : points) add_disc(point, 0.5 * width_px);
}

void Shape::add_dashed_outline(const std::vector<Vec2>& points, double width_px, double dash_px) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec2& a = points[i];
    const Vec2& b = points[(i + 1) % points.size()];
    // A side is half a dash, then gaps and dashes in turn, then half a dash: n of both together.
    const double length = (b - a).norm();
    constexpr double kMostPeriods =
        2000.0;  // bounds the work for a side far longer than the picture
    const int periods =
        static_cast<int>(std::clamp(std::round(length / (2.0 * dash_px)), 1.0, kMostPeriods));
    for (int k = 0; k <= periods; ++k) {
      const double begin = std::max(0.0, (k - 0.25) / periods);
      const double end = std::min(1.0, (k + 0.25) / periods);
      add_line({a + (b - a) * begin, a + (b - a) * end}, width_px);
    }
  }
}

void Shape::append(const Shape& other, const Vec2& offset) {
  for (const Edge& edge : other.edges_) edges_.push_back({edge.from + offset, edge.to + offset});
}

void Shape::cut(const Shape& hole) {
  for (const Edge& edge : hole.edges_) edges_.push_back({edge.to, edge.from});
}

Painter::Painter(int width, int height, Colour background) {
  image_.width = width;
  image_.height = height;
  const std::size_t count = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  image_.rgb.resize(3 * count);
  for (std::size_t i = 0; i < 3 * count; i += 3) {
    image_.rgb[i] = background.r;
    image_.rgb[i + 1] = background.g;
    image_.rgb[i + 2] = background.b;
  }
  clear_clip();
}

void Painter::set_clip(int left, int top, int right, int bottom) {
  clip_left_ = std::clamp(left, 0, image_.width);
  clip_top_ = std::clamp(top, 0, image_.height);
  clip_right_ = std::clamp(right, clip_left_, image_.width);
  clip_bottom_ = std::clamp(bottom, clip_top_, image_.height);
}

Mask Painter::bounds(const Shape& shape) const {
  Mask mask;
  if (shape.edges().empty()) return mask;
  Vec2 low = shape.edges().front().from;
  Vec2 high = low;
  for (const Shape::Edge& edge : shape.edges()) {  // outlines are closed: `from` is every corner
    low = low.cwiseMin(edge.from);
    high = high.cwiseMax(edge.from);
  }
  const auto within = [](double at, int from, int to) {
    return static_cast<int>(std::clamp<double>(at, from, to));
  };
  mask.left = within(std::floor(low.x()), clip_left_, clip_right_);
  mask.top = within(std::floor(low.y()), clip_top_, clip_bottom_);
  mask.width = within(std::ceil(high.x()), clip_left_, clip_right_) - mask.left;
  mask.height = within(std::ceil(high.y()), clip_top_, clip_bottom_) - mask.top;
  return mask;
}

template <typename Visitor>
void Painter::rasterise(const Shape& shape, Visitor visit) {
  const Mask part = bounds(shape);
  if (part.width <= 0 || part.height <= 0) return;
  const std::size_t size =
      (static_cast<std::size_t>(part.width) + 1) * static_cast<std::size_t>(part.height);
  if (cells_.size() < size) cells_.resize(size);
  Accumulator accumulator(part.width, part.height, cells_.data());
  const Vec2 corner(part.left, part.top);
  for (const Shape::Edge& edge : shape.edges()) {
    accumulator.add(edge.from - corner, edge.to - corner);
  }
  accumulator.visit_and_clear(
      [&](int x, int y, float coverage) { visit(part.left + x, part.top + y, coverage); });
}

void Painter::fill(const Shape& shape, Colour colour, double opacity) {
  const auto strength = static_cast<float>(opacity);
  rasterise(shape, [&](int x, int y, float coverage) { blend(x, y, colour, coverage * strength); });
}

void Painter::fill_fading(const Shape& shape, Colour colour, const Vec2& center, double radius_px,
                          double opacity_center, double opacity_rim) {
  const auto at_center = static_cast<float>(opacity_center);
  const auto fall = static_cast<float>(opacity_center - opacity_rim);
  const auto inverse_square = static_cast<float>(1.0 / (radius_px * radius_px));
  const auto center_x = static_cast<float>(center.x() - 0.5);
  const auto center_y = static_cast<float>(center.y() - 0.5);
  rasterise(shape, [&](int x, int y, float coverage) {
    const float dx = static_cast<float>(x) - center_x;
    const float dy = static_cast<float>(y) - center_y;
    const float share = std::min(1.0F, (dx * dx + dy * dy) * inverse_square);
    blend(x, y, colour, coverage * (at_center - fall * share));
  });
}

Mask Painter::mask(const Shape& shape) {
  Mask mask = bounds(shape);
  mask.coverage.resize(static_cast<std::size_t>(mask.width) *
                       static_cast<std::size_t>(mask.height));
  rasterise(shape, [&](int x, int y, float coverage) {
    mask.coverage[static_cast<std::size_t>(y - mask.top) * static_cast<std::size_t>(mask.width) +
                  static_cast<std::size_t>(x - mask.left)] = coverage;
  });
  return mask;
}

void Painter::fill(const Mask& mask, Colour colour, double opacity) {
  const auto strength = static_cast<float>(opacity);
  const float* coverage = mask.coverage.data();
  for (int y = mask.top; y < mask.top + mask.height; ++y) {
    for (int x = mask.left; x < mask.left + mask.width; ++x, ++coverage) {
      if (*coverage > 0.0F) blend(x, y, colour, *coverage * strength);
    }
  }
}

double Painter::text_width_px(const std::string& text, const TextStyle& style) {
  double width_px = 0.0;
  for (const Word& word : words_of(text, style)) {
    width_px = word.start_px + word.width_px;
  }
  return width_px;
}

void Painter::draw_text(const std::string& text, const Vec2& start, const TextStyle& style) {
  if (!is_drawable(start)) return;
  const std::vector<Word> words = words_of(text, style);
  // Room on all sides for strokes, the halo and letters below the base line.
  const int room =
      static_cast<int>(std::ceil(style.cap_height_px * (0.5 + style.weight) + style.halo_px)) + 1;
  const int left = static_cast<int>(std::floor(start.x())) - room;
  const int top = static_cast<int>(std::lround(start.y() - style.cap_height_px)) - room;
  const int width = static_cast<int>(std::ceil(text_width_px(text, style))) + 2 * room + 1;
  const int height = static_cast<int>(std::ceil(style.cap_height_px)) + 2 * room;
  const auto draw = [&](double rim_px, Colour colour) {
    cv::Mat large = cv::Mat::zeros(height * kTextOversampling, width * kTextOversampling, CV_8UC1);
    for (const Word& word : words) {
      const cv::Point origin(
          static_cast<int>(std::lround((start.x() + word.start_px - left) * kTextOversampling)),
          static_cast<int>(std::lround(start.y()) - top) * kTextOversampling);
      cv::putText(large, word.text, origin, kFont, font_scale(style), cv::Scalar(255),
                  stroke_width(style, rim_px), cv::LINE_AA);
    }
    for (int y = std::max(0, -top); y < std::min(height, image_.height - top); ++y) {
      for (int x = std::max(0, -left); x < std::min(width, image_.width - left); ++x) {
        int total = 0;
        for (int sub = 0; sub < kTextOversampling; ++sub) {
          const std::uint8_t* row = large.ptr(y * kTextOversampling + sub) + x * kTextOversampling;
          for (int i = 0; i < kTextOversampling; ++i) total += row[i];
        }
        if (total > 0) {
          blend(left + x, top + y, colour,
                static_cast<float>(total) / (255.0F * kTextOversampling * kTextOversampling));
        }
      }
    }
  };
  if (style.halo_px > 0.0) draw(style.halo_px, style.halo);
  draw(0.0, style.colour);
}

}  // namespace sim::render
