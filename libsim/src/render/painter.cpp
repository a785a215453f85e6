// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "render/painter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <numbers>
#include <span>
#include <stdexcept>
#include <utility>

#include "render/modules/module_file.h"
#include "render/text_outline.h"

namespace sim::render {
namespace {

// Text is drawn enlarged by this factor and averaged. This is finer than the module's own
// smoothing, and allows stroke widths in quarters of a pixel.
constexpr int kTextOversampling = 4;
constexpr double kFontCapHeight = 21.0;  // of the text module's font at scale 1 [pixels]
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

// Words with their positions. The font's own space is as wide as a letter, which is too wide.
std::vector<Word> words_of(const std::string& text, const TextStyle& style) {
  constexpr double kSpace = 0.5;  // as a fraction of the cap height
  std::vector<Word> words;
  double at_px = 0.0;
  const std::size_t length = std::min(text.size(), kMaxTextLength);
  for (std::size_t begin = 0; begin < length;) {
    const std::size_t end = std::min(text.find(' ', begin), length);
    if (end > begin) {
      const std::string word = text.substr(begin, end - begin);
      const int width = modules::text_functions().width(word.c_str(), font_scale(style),
                                                        stroke_width(style, 0.0));
      const double width_px = static_cast<double>(width) / kTextOversampling;
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

// Most of a row is empty: skips eight cells at a time.
int first_not_zero(const float* cells, int begin, int end) {
  constexpr int kAtOnce = 8;
  for (; begin + kAtOnce <= end; begin += kAtOnce) {
    std::array<std::uint64_t, kAtOnce / 2> pairs{};
    std::memcpy(pairs.data(), cells + begin, sizeof pairs);
    if ((pairs[0] | pairs[1] | pairs[2] | pairs[3]) != 0) break;
  }
  while (begin < end && cells[begin] == 0.0F) ++begin;
  return begin;
}

// Accumulates the contributions of edges to the pixels of a part of the picture. In each row that
// it crosses, an edge covers what lies to its right, counted positive downwards and negative
// upwards. Cell (x, y) holds the change of this coverage from pixel x - 1 to pixel x, so a running
// sum along the row gives the covered area of each pixel exactly.
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

  // Calls visit(y, x_begin, x_end, coverage) for each covered run, row by row, and resets all cells
  // to zero.
  template <typename Visitor>
  void visit_and_clear(Visitor visit) {
    constexpr float kLeast = 1.0F / 2048.0F;  // less is rounding error and would be invisible
    for (int y = 0; y < height_; ++y) {
      float* const cell = cells_ + static_cast<std::size_t>(y) * stride_;
      float total = 0.0F;
      for (int x = 0; x < width_;) {
        total += cell[x];
        cell[x] = 0.0F;
        const int begin = x++;
        x = first_not_zero(cell, x, width_);
        const float covered = std::abs(total);
        if (covered > kLeast) visit(y, begin, x, std::min(covered, 1.0F));
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

// The part of `clip` that the shape may cover.
PixelRect bounds_within(const Shape& shape, const PixelRect& clip) {
  if (shape.edges().empty()) return {};
  Vec2 low = shape.edges().front().from;
  Vec2 high = low;
  for (const Shape::Edge& edge : shape.edges()) {  // outlines are closed, so `from` visits every
                                                   // corner
    low = low.cwiseMin(edge.from);
    high = high.cwiseMax(edge.from);
  }
  const auto within = [](double at, int from, int to) {
    return static_cast<int>(std::clamp<double>(at, from, to));
  };
  return {within(std::floor(low.x()), clip.left, clip.right),
          within(std::floor(low.y()), clip.top, clip.bottom),
          within(std::ceil(high.x()), clip.left, clip.right),
          within(std::ceil(high.y()), clip.top, clip.bottom)};
}

std::uint32_t whole_weight(float share) {
  return static_cast<std::uint32_t>(share * 65536.0F + 0.5F);
}

// Blends a colour over a pixel with the weight `weight` / 2^16.
void blend_pixel(std::uint8_t* pixel, Colour colour, std::uint32_t weight) {
  constexpr std::uint32_t kOne = 1 << 16;
  constexpr std::uint32_t kHalf = kOne / 2;
  const std::uint32_t keep = kOne - weight;
  pixel[0] = static_cast<std::uint8_t>((pixel[0] * keep + colour.r * weight + kHalf) >> 16);
  pixel[1] = static_cast<std::uint8_t>((pixel[1] * keep + colour.g * weight + kHalf) >> 16);
  pixel[2] = static_cast<std::uint8_t>((pixel[2] * keep + colour.b * weight + kHalf) >> 16);
}

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
  // The number of corners keeps the polygon within 1/20 pixel of the circle.
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
  const double radius_px = 0.5 * width_px;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool end = !closed && (i == 0 || i + 1 == points.size());
    if (!end) {
      // At a joint that turns by t, the open wedge on the outside is radius (1 - cos(t / 2)) high.
      constexpr double kLeastGap_px = 0.02;
      const Vec2 in = points[i] - points[(i + points.size() - 1) % points.size()];
      const Vec2 out = points[(i + 1) % points.size()] - points[i];
      const double lengths = in.norm() * out.norm();
      if (lengths > 0.0) {
        const double half_angle_cosine =
            std::sqrt(std::max(0.0, 0.5 * (1.0 + in.dot(out) / lengths)));
        if (radius_px * (1.0 - half_angle_cosine) < kLeastGap_px) continue;
      }
    }
    add_disc(points[i], radius_px);
  }
}

void Shape::add_dashed_outline(const std::vector<Vec2>& points, double width_px, double dash_px) {
  // Bounds the work for an outline far longer than the picture.
  constexpr double kMostPeriods = 8000.0;
  const double most_per_side = std::max(1.0, kMostPeriods / static_cast<double>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec2& a = points[i];
    const Vec2& b = points[(i + 1) % points.size()];
    // A side consists of half a dash, alternating gaps and dashes, and half a dash: n periods.
    const double length = (b - a).norm();
    if (!std::isfinite(length)) continue;
    const int periods =
        static_cast<int>(std::clamp(std::round(length / (2.0 * dash_px)), 1.0, most_per_side));
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

template <typename Visitor>
void Rasteriser::rasterise(const Shape& shape, const PixelRect& clip, Visitor visit) {
  const PixelRect part = bounds_within(shape, clip);
  const int width = part.right - part.left;
  const int height = part.bottom - part.top;
  if (width <= 0 || height <= 0) return;
  const std::size_t size = (static_cast<std::size_t>(width) + 1) * static_cast<std::size_t>(height);
  if (cells_.size() < size) cells_.resize(size);
  Accumulator accumulator(width, height, cells_.data());
  const Vec2 corner(part.left, part.top);
  for (const Shape::Edge& edge : shape.edges()) {
    accumulator.add(edge.from - corner, edge.to - corner);
  }
  accumulator.visit_and_clear([&](int y, int begin, int end, float coverage) {
    visit(part.top + y, part.left + begin, part.left + end, coverage);
  });
}

void Overlay::Canvas::fill(const Shape& shape, Colour colour, double opacity) {
  const float strength = static_cast<float>(opacity) * static_cast<float>(colour.a) / 255.0F;
  const std::array<float, 3> channels = {static_cast<float>(colour.r), static_cast<float>(colour.g),
                                         static_cast<float>(colour.b)};
  rasteriser_.rasterise(shape, part_, [&](int y, int begin, int end, float coverage) {
    const float share = coverage * strength;
    Pixel* pixel = pixels_.data() + static_cast<std::size_t>(y - part_.top) *
                                        static_cast<std::size_t>(part_.right - part_.left);
    for (int x = begin; x < end; ++x) {
      Pixel& out = pixel[x - part_.left];
      for (std::size_t i = 0; i < 3; ++i) {
        out.added[i] = out.added[i] * (1.0F - share) + channels[i] * share;
      }
      out.kept *= 1.0F - share;
    }
  });
}

Overlay::Overlay(int width, int height, const std::function<void(Canvas&)>& draw) {
  constexpr int kBand_px = 1 << 17;  // 2 MB: the memory of larger bands costs more than drawing
  const int rows = std::max(1, kBand_px / width);
  bytes_.reserve(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  Canvas canvas;
  for (int top = 0; top < height; top += rows) {
    canvas.part_ = {0, top, width, std::min(top + rows, height)};
    canvas.pixels_.assign(
        static_cast<std::size_t>(canvas.part_.bottom - top) * static_cast<std::size_t>(width),
        Canvas::Pixel{});
    draw(canvas);
    add_runs(canvas);
  }
}

void Overlay::add_runs(const Canvas& canvas) {
  constexpr float kLeastKept = 1.0F / 1024.0F;  // smaller values are invisible
  const int width = canvas.part_.right - canvas.part_.left;
  const Canvas::Pixel* pixel = canvas.pixels_.data();
  for (int y = canvas.part_.top; y < canvas.part_.bottom; ++y, pixel += width) {
    for (int x = 0; x < width;) {
      if (pixel[x].kept == 1.0F) {
        ++x;
        continue;
      }
      Run run;
      run.begin = x;
      run.opaque = pixel[x].kept < kLeastKept;
      run.first = run.opaque ? bytes_.size() : blends_.size();
      while (x < width && pixel[x].kept != 1.0F && (pixel[x].kept < kLeastKept) == run.opaque) ++x;
      run.end = x;
      runs_.push_back(run);
      const std::span pixels(pixel + run.begin, pixel + run.end);
      if (!run.opaque) {
        for (const Canvas::Pixel& p : pixels) blends_.push_back(Blend::of(p.kept, p.added));
        continue;
      }
      bytes_.resize(run.first + 3 * pixels.size());
      std::uint8_t* to = bytes_.data() + run.first;
      for (const Canvas::Pixel& p : pixels) {
        for (const float channel : p.added) {
          *to++ = static_cast<std::uint8_t>(std::min(channel + 0.5F, 255.0F));
        }
      }
    }
    row_.push_back(runs_.size());
  }
}

void Overlay::draw_on(Image& image, const PixelRect& part) const {
  const int bottom = std::min(part.bottom, static_cast<int>(row_.size()) - 1);
  for (int y = part.top; y < bottom; ++y) {
    std::uint8_t* const row =
        image.rgb.data() + 3 * static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width);
    const std::size_t last = row_[static_cast<std::size_t>(y) + 1];
    for (std::size_t i = row_[static_cast<std::size_t>(y)]; i < last; ++i) {
      const Run& run = runs_[i];
      const int begin = std::max(run.begin, part.left);
      const int end = std::min(run.end, part.right);
      if (begin >= end) continue;
      const auto skipped = static_cast<std::size_t>(begin - run.begin);
      const auto count = static_cast<std::size_t>(end - begin);
      std::uint8_t* pixel = row + 3 * static_cast<std::size_t>(begin);
      if (run.opaque) {
        std::memcpy(pixel, bytes_.data() + run.first + 3 * skipped, 3 * count);
        continue;
      }
      const Blend* blend = blends_.data() + run.first + skipped;
      for (std::size_t k = 0; k < count; ++k, pixel += 3) blend[k].apply(pixel);
    }
  }
}

double Overlay::hidden_px(const PixelRect& part) const {
  double hidden = 0.0;
  const int bottom = std::min(part.bottom, static_cast<int>(row_.size()) - 1);
  for (int y = part.top; y < bottom; ++y) {
    const std::size_t last = row_[static_cast<std::size_t>(y) + 1];
    for (std::size_t i = row_[static_cast<std::size_t>(y)]; i < last; ++i) {
      const Run& run = runs_[i];
      for (int x = std::max(run.begin, part.left); x < std::min(run.end, part.right); ++x) {
        const std::size_t at = run.first + static_cast<std::size_t>(x - run.begin);
        hidden += run.opaque ? 1.0 : 1.0 - static_cast<double>(blends_[at].keep) / 65536.0;
      }
    }
  }
  return hidden;
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

void Painter::set_clip(const PixelRect& clip) {
  clip_.left = std::clamp(clip.left, 0, image_.width);
  clip_.top = std::clamp(clip.top, 0, image_.height);
  clip_.right = std::clamp(clip.right, clip_.left, image_.width);
  clip_.bottom = std::clamp(clip.bottom, clip_.top, image_.height);
}

void Painter::blend(int y, int x_begin, int x_end, Colour colour, float opacity) {
  const std::uint32_t weight =
      whole_weight(opacity * static_cast<float>(colour.a) * (1.0F / 255.0F));
  std::uint8_t* at = pixel(x_begin, y);
  for (int x = x_begin; x < x_end; ++x, at += 3) blend_pixel(at, colour, weight);
}

void Painter::fill(const Shape& shape, Colour colour, double opacity) {
  const auto strength = static_cast<float>(opacity);
  rasteriser_.rasterise(shape, clip_, [&](int y, int begin, int end, float coverage) {
    blend(y, begin, end, colour, coverage * strength);
  });
}

void Painter::fill_ring(const Vec2& center, double radius_px, double width_px, Colour colour) {
  Shape ring;
  ring.add_disc(center, radius_px + 0.5 * width_px);
  Shape hole;
  hole.add_disc(center, std::max(radius_px - 0.5 * width_px, 0.0));
  ring.cut(hole);
  fill(ring, colour);
}

void Painter::fill_fading(const Shape& shape, Colour colour, const Vec2& center, double radius_px,
                          double opacity_center, double opacity_rim) {
  const float alpha = static_cast<float>(colour.a) / 255.0F;
  const float at_center = static_cast<float>(opacity_center) * alpha;
  const float fall = static_cast<float>(opacity_center - opacity_rim) * alpha;
  const auto inverse_square = static_cast<float>(1.0 / (radius_px * radius_px));
  const auto center_x = static_cast<float>(center.x() - 0.5);
  const auto center_y = static_cast<float>(center.y() - 0.5);
  rasteriser_.rasterise(shape, clip_, [&](int y, int begin, int end, float coverage) {
    const float dy = static_cast<float>(y) - center_y;
    std::uint8_t* at = pixel(begin, y);
    for (int x = begin; x < end; ++x, at += 3) {
      const float dx = static_cast<float>(x) - center_x;
      const float share = std::min(1.0F, (dx * dx + dy * dy) * inverse_square);
      blend_pixel(at, colour, whole_weight(coverage * (at_center - fall * share)));
    }
  });
}

void Painter::accumulate(const Shape& shape, double opacity) {
  const auto strength = static_cast<float>(opacity);
  if (accumulated_.empty()) accumulated_.resize(image_.rgb.size() / 3);
  rasteriser_.rasterise(shape, clip_, [&](int y, int begin, int end, float coverage) {
    float* const row =
        accumulated_.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(image_.width);
    for (int x = begin; x < end; ++x) row[x] = std::max(row[x], coverage * strength);
    PixelRect& part = accumulated_part_;
    const bool none = part.right == 0;
    part = {none ? begin : std::min(part.left, begin), none ? y : std::min(part.top, y),
            std::max(part.right, end), std::max(part.bottom, y + 1)};
  });
}

void Painter::fill_accumulated(Colour colour) {
  for (int y = accumulated_part_.top; y < accumulated_part_.bottom; ++y) {
    float* const row =
        accumulated_.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(image_.width);
    for (int x = first_not_zero(row, accumulated_part_.left, accumulated_part_.right);
         x < accumulated_part_.right; x = first_not_zero(row, x + 1, accumulated_part_.right)) {
      blend(y, x, x + 1, colour, row[x]);
      row[x] = 0.0F;
    }
  }
  accumulated_part_ = {};
}

double Painter::text_width_px(const std::string& text, const TextStyle& style) {
  if (has_wide_characters(text)) return text_outline(text, style.cap_height_px).width_px;
  double width_px = 0.0;
  for (const Word& word : words_of(text, style)) {
    width_px = word.start_px + word.width_px;
  }
  return width_px;
}

Painter::TextMask Painter::make_outline_mask(const std::string& text, const TextStyle& style,
                                             int quarter_px, double rim_px) {
  const TextOutline outline = text_outline(text, style.cap_height_px);
  // Accents extend above capitals, and some characters extend far below the base line.
  const int room = static_cast<int>(std::ceil(0.7 * style.cap_height_px + style.halo_px)) + 2;
  const int cap_height = static_cast<int>(std::ceil(style.cap_height_px));
  TextMask mask;
  mask.left = -room;
  mask.top = -cap_height - room;
  mask.width = static_cast<int>(std::ceil(outline.width_px)) + 2 * room + 2;
  mask.height = cap_height + 2 * room;
  mask.coverage.resize(static_cast<std::size_t>(mask.width) *
                       static_cast<std::size_t>(mask.height));
  const Vec2 offset(room + static_cast<double>(quarter_px) / kTextOversampling,
                    static_cast<double>(-mask.top));
  Rasteriser rasteriser;
  // The contours of letters have both orientations, strokes have only one. They cannot be filled as
  // one path.
  const auto add = [&](const Shape& shape) {
    rasteriser.rasterise(
        shape, {0, 0, mask.width, mask.height}, [&](int y, int begin, int end, float coverage) {
          const std::uint32_t value = whole_weight(std::min(coverage, 1.0F));
          for (int x = begin; x < end; ++x) {
            std::uint32_t& cell =
                mask.coverage[static_cast<std::size_t>(y) * static_cast<std::size_t>(mask.width) +
                              static_cast<std::size_t>(x)];
            cell = std::max(cell, value);
          }
        });
  };
  Shape letters;
  Shape strokes;
  // At a weight of 0.13, the strokes of the Hershey letters are as wide as the font's.
  const double stroke_px = 2.0 * rim_px + std::max(0.0, style.weight - 0.13) * style.cap_height_px;
  for (std::vector<Vec2> contour : outline.contours) {
    for (Vec2& point : contour) point += offset;
    letters.add_outline(contour);
    if (stroke_px > 0.0) strokes.add_line(contour, stroke_px, true);
  }
  add(letters);
  if (stroke_px > 0.0) add(strokes);
  return mask;
}

Painter::TextMask Painter::make_text_mask(const std::string& text, const TextStyle& style,
                                          int quarter_px, double rim_px) {
  const std::vector<Word> words = words_of(text, style);
  // Margin on all sides for strokes, the halo and descenders.
  const int room =
      static_cast<int>(std::ceil(style.cap_height_px * (0.5 + style.weight) + style.halo_px)) + 1;
  const int cap_height = static_cast<int>(std::ceil(style.cap_height_px));
  TextMask mask;
  mask.left = -room;
  mask.top = -cap_height - room;
  mask.width = static_cast<int>(std::ceil(text_width_px(text, style))) + 2 * room + 2;
  mask.height = cap_height + 2 * room;
  const int large_width = mask.width * kTextOversampling;
  const int large_height = mask.height * kTextOversampling;
  std::vector<std::uint8_t> large(static_cast<std::size_t>(large_width) *
                                  static_cast<std::size_t>(large_height));
  for (const Word& word : words) {
    const int x =
        static_cast<int>(std::lround((word.start_px + room) * kTextOversampling)) + quarter_px;
    if (!modules::text_functions().draw(word.text.c_str(), x, -mask.top * kTextOversampling,
                                        font_scale(style), stroke_width(style, rim_px),
                                        large.data(), large_width, large_height)) {
      throw std::runtime_error("OpenCV cannot draw the text \"" + word.text + '"');
    }
  }
  mask.coverage.reserve(static_cast<std::size_t>(mask.width) *
                        static_cast<std::size_t>(mask.height));
  for (int y = 0; y < mask.height; ++y) {
    for (int x = 0; x < mask.width; ++x) {
      std::uint32_t total = 0;
      for (int sub = 0; sub < kTextOversampling; ++sub) {
        const std::uint8_t* row =
            large.data() + static_cast<std::ptrdiff_t>(y * kTextOversampling + sub) * large_width +
            static_cast<std::ptrdiff_t>(x) * kTextOversampling;
        for (int i = 0; i < kTextOversampling; ++i) total += row[i];
      }
      constexpr std::uint32_t kMost = 255 * kTextOversampling * kTextOversampling;
      mask.coverage.push_back((total << 16) / kMost);
    }
  }
  return mask;
}

void Painter::fill(const TextMask& mask, int left, int top, Colour colour) {
  const int x_begin = std::max(0, -left);
  const int x_end = std::min(mask.width, image_.width - left);
  for (int y = std::max(0, -top); y < std::min(mask.height, image_.height - top); ++y) {
    const std::uint32_t* const row =
        mask.coverage.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(mask.width);
    for (int x = x_begin; x < x_end; ++x) {
      if (row[x] > 0) blend_pixel(pixel(left + x, top + y), colour, row[x] * colour.a / 255);
    }
  }
}

void Painter::draw_text(const std::string& text, const Vec2& start, const TextStyle& style) {
  if (!is_drawable(start)) return;
  constexpr std::size_t kMostRemembered = 400;
  static_assert(kTextOversampling == 4, "places are rounded to quarters of a pixel");
  const auto quarters = static_cast<std::int64_t>(std::llround(start.x() * kTextOversampling));
  const auto quarter_px = static_cast<int>(((quarters % 4) + 4) % 4);
  const auto x = static_cast<int>((quarters - quarter_px) / 4);
  const auto y = static_cast<int>(std::lround(start.y()));
  const auto draw = [&](double rim_px, Colour colour) {
    const std::array<double, 4> look = {style.cap_height_px, style.weight, style.halo_px, rim_px};
    std::string key(1, static_cast<char>('0' + quarter_px));
    key.append(reinterpret_cast<const char*>(look.data()), sizeof look);
    key += text;
    auto known = texts_.find(key);
    if (known == texts_.end()) {
      if (texts_.size() >= kMostRemembered) texts_.clear();
      known = texts_
                  .emplace(key, has_wide_characters(text)
                                    ? make_outline_mask(text, style, quarter_px, rim_px)
                                    : make_text_mask(text, style, quarter_px, rim_px))
                  .first;
    }
    fill(known->second, x + known->second.left, y + known->second.top, colour);
  };
  if (style.halo_px > 0.0) draw(style.halo_px, style.halo);
  draw(0.0, style.colour);
}

}  // namespace sim::render
