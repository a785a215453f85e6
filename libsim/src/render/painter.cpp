// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "render/painter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <numeric>
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

// Accumulates the contributions of edges to the pixels of some rows. In each row that it crosses,
// an edge covers what lies to its right, counted positive downwards and negative upwards. Cell (x,
// y) holds the change of this coverage from pixel x - 1 to pixel x, so a running sum along the row
// gives the covered area of each pixel exactly.
class Accumulator {
 public:
  // `cells` must hold (width + 1) * (bottom - top) zeros, `extents` as many extents as rows.
  Accumulator(int width, int top, int bottom, float* cells, Rasteriser::Extent* extents)
      : width_(width),
        top_(top),
        bottom_(bottom),
        stride_(static_cast<std::size_t>(width) + 1),
        cells_(cells),
        extents_(extents) {
    std::fill_n(extents_, bottom - top, Rasteriser::Extent{width, 0});
  }

  void add(Vec2 from, Vec2 to) {
    if (from.y() == to.y()) return;
    const bool up = from.y() > to.y();
    if (up) std::swap(from, to);
    if (to.y() <= top_ || from.y() >= bottom_) return;
    const double slope = (to.x() - from.x()) / (to.y() - from.y());
    const double y_end = std::min(to.y(), static_cast<double>(bottom_));
    double y = std::max(from.y(), static_cast<double>(top_));
    double x = from.x() + (y - from.y()) * slope;
    for (int row = static_cast<int>(y); row < bottom_ && y < y_end; ++row) {
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
    for (int y = top_; y < bottom_; ++y) {
      float* const cell = cells_ + static_cast<std::size_t>(y - top_) * stride_;
      const Rasteriser::Extent extent = extents_[y - top_];
      float total = 0.0F;
      for (int x = extent.begin; x < width_;) {
        total += cell[x];
        cell[x] = 0.0F;
        const int begin = x++;
        x = first_not_zero(cell, x, extent.end);
        if (x >= extent.end) x = width_;  // the coverage no longer changes
        const float covered = std::abs(total);
        if (covered > kLeast) visit(y, begin, x, std::min(covered, 1.0F));
      }
      cell[width_] = 0.0F;
    }
  }

 private:
  // Part of an edge within one row, from x0 to x1, of (signed) height dy.
  void add_in_row(int row, double x0, double x1, double dy) {
    float* const cells = cells_ + static_cast<std::size_t>(row - top_) * stride_;
    Rasteriser::Extent& extent = extents_[row - top_];
    if (x0 > x1) std::swap(x0, x1);
    if (x0 >= width_) return;
    if (x1 <= 0.0) {
      cells[0] += static_cast<float>(dy);
      extent = {0, std::max(extent.end, 1)};
      return;
    }
    const double dy_dx = x1 > x0 ? dy / (x1 - x0) : 0.0;
    if (x0 < 0.0) {
      cells[0] += static_cast<float>(-x0 * dy_dx);  // in the extent, which begins at 0 then
      dy += x0 * dy_dx;
      x0 = 0.0;
    }
    if (x1 > width_) {
      dy -= (x1 - width_) * dy_dx;
      x1 = width_;
    }
    const int last = std::min(static_cast<int>(x1), width_ - 1);
    extent = {std::min(extent.begin, static_cast<int>(x0)),
              std::max(extent.end, std::min(last + 2, width_))};
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
  int top_;
  int bottom_;
  std::size_t stride_;
  float* cells_;
  Rasteriser::Extent* extents_;
};

// The number of rows to accumulate at once. The cells of a large shape would be a page fault for
// each page; those of a few rows stay in the processor's cache. But each edge is looked at once for
// each band of rows.
int rows_at_once(int width, int height, std::size_t edges) {
  constexpr std::size_t kCells = std::size_t{1} << 16;
  constexpr std::size_t kCellsAnEdge = 8;  // looking at an edge costs like so many cells
  const std::size_t row = static_cast<std::size_t>(width) + 1;
  const std::size_t all = row * static_cast<std::size_t>(height);
  const std::size_t most_bands = std::max<std::size_t>(all / (kCellsAnEdge * edges), 1);
  const std::size_t bands = std::min((all + kCells - 1) / kCells, most_bands);
  return static_cast<int>((static_cast<std::size_t>(height) + bands - 1) / bands);
}

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

// The elements of a vector by their rows `y`, in each row in the order of the vector.
template <typename Span>
std::vector<const Span*> sorted_by_row(const std::vector<Span>& spans, int height) {
  std::vector<std::size_t> next(static_cast<std::size_t>(height) + 1);  // position of a row's next
  for (const Span& span : spans) ++next[static_cast<std::size_t>(span.y) + 1];
  std::partial_sum(next.begin(), next.end(), next.begin());
  std::vector<const Span*> sorted(spans.size());
  for (const Span& span : spans) sorted[next[static_cast<std::size_t>(span.y)]++] = &span;
  return sorted;
}

// Gives pixels a colour: the first one, then copies of what is already there.
void fill_pixels(std::uint8_t* pixels, int count, Colour colour) {
  if (count <= 0) return;
  pixels[0] = colour.r;
  pixels[1] = colour.g;
  pixels[2] = colour.b;
  const std::size_t size = 3 * static_cast<std::size_t>(count);
  for (std::size_t done = 3; done < size; done *= 2) {
    std::memcpy(pixels + done, pixels, std::min(done, size - done));
  }
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

template <typename Visitor>
void Rasteriser::rasterise(const Shape& shape, const PixelRect& clip, Visitor visit) {
  const PixelRect part = bounds_within(shape, clip);
  const int width = part.right - part.left;
  const int height = part.bottom - part.top;
  if (width <= 0 || height <= 0) return;
  const int rows = rows_at_once(width, height, shape.edges().size());
  const std::size_t size = (static_cast<std::size_t>(width) + 1) * static_cast<std::size_t>(rows);
  if (cells_.size() < size) cells_.resize(size);
  if (extents_.size() < static_cast<std::size_t>(rows)) {
    extents_.resize(static_cast<std::size_t>(rows));
  }
  const Vec2 corner(part.left, part.top);
  for (int top = 0; top < height; top += rows) {
    Accumulator accumulator(width, top, std::min(top + rows, height), cells_.data(),
                            extents_.data());
    for (const Shape::Edge& edge : shape.edges()) {
      accumulator.add(edge.from - corner, edge.to - corner);
    }
    accumulator.visit_and_clear([&](int y, int begin, int end, float coverage) {
      visit(part.top + y, part.left + begin, part.left + end, coverage);
    });
  }
}

void Overlay::Canvas::fill(const Shape& shape, Colour colour, double opacity) {
  const float strength = static_cast<float>(opacity) * static_cast<float>(colour.a) / 255.0F;
  rasteriser_.rasterise(shape, whole_, [&](int y, int begin, int end, float coverage) {
    spans_.push_back({y, begin, end, coverage * strength, colour});
  });
}

namespace {

// What an overlay does to the pixels of one row, before it is rounded.
class OverlayRow {
 public:
  // What is added to the three channels, and the share that is kept of the pixel below.
  using Pixel = std::array<float, 4>;

  explicit OverlayRow(int width)
      : width_(width),
        touched_(static_cast<std::size_t>((width + kBlock_px - 1) / kBlock_px)),
        pixels_(touched_.size() * kBlock_px) {}

  void clear() { std::fill(touched_.begin(), touched_.end(), false); }

  void fill(int begin, int end, Colour colour, float share) {
    touch(begin, end);
    const Pixel channels = {static_cast<float>(colour.r), static_cast<float>(colour.g),
                            static_cast<float>(colour.b), 0.0F};
    if (share == 1.0F) {
      std::fill(pixels_.begin() + begin, pixels_.begin() + end, channels);
      return;
    }
    for (auto pixel = pixels_.begin() + begin; pixel != pixels_.begin() + end; ++pixel) {
      for (std::size_t i = 0; i < pixel->size(); ++i) {
        (*pixel)[i] = (*pixel)[i] * (1.0F - share) + channels[i] * share;
      }
    }
  }

  // Calls visit(begin, pixels, opaque) for each run of changed pixels that are all opaque or all
  // translucent.
  template <typename Visitor>
  void visit_runs(Visitor visit) const {
    constexpr float kLeastKept = 1.0F / 1024.0F;  // smaller values are invisible
    const auto kept = [this](int x) { return pixels_[static_cast<std::size_t>(x)][3]; };
    int end = 0;  // of the touched blocks from x on
    for (int x = 0; x < width_;) {
      if (x >= end) {
        const auto next = std::find(touched_.begin() + x / kBlock_px, touched_.end(), true);
        const auto past = std::find(next, touched_.end(), false);
        x = kBlock_px * static_cast<int>(next - touched_.begin());
        end = std::min(kBlock_px * static_cast<int>(past - touched_.begin()), width_);
        continue;
      }
      if (kept(x) == 1.0F) {
        ++x;
        continue;
      }
      const int begin = x;
      const bool opaque = kept(x) < kLeastKept;
      while (x < end && kept(x) != 1.0F && (kept(x) < kLeastKept) == opaque) ++x;
      visit(begin, std::span(pixels_.begin() + begin, pixels_.begin() + x), opaque);
    }
  }

 private:
  static constexpr int kBlock_px = 32;  // pixels that are initialised together

  void touch(int begin, int end) {
    for (int block = begin / kBlock_px; block <= (end - 1) / kBlock_px; ++block) {
      if (std::exchange(touched_[static_cast<std::size_t>(block)], std::uint8_t{true}) != 0)
        continue;
      std::fill_n(pixels_.begin() + block * kBlock_px, kBlock_px, Pixel{0.0F, 0.0F, 0.0F, 1.0F});
    }
  }

  int width_;
  std::vector<std::uint8_t> touched_;  // whether a block has been drawn on
  std::vector<Pixel> pixels_;
};

}  // namespace

Overlay::Overlay(int width, int height, const std::function<void(Canvas&)>& draw) {
  Canvas canvas;
  canvas.whole_ = {0, 0, width, height};
  draw(canvas);
  const std::vector<const Canvas::Span*> spans = sorted_by_row(canvas.spans_, height);
  row_.assign(static_cast<std::size_t>(height) + 1, 0);
  OverlayRow row(width);
  auto span = spans.begin();
  for (int y = 0; y < height; ++y) {
    row.clear();
    for (; span != spans.end() && (*span)->y == y; ++span) {
      row.fill((*span)->begin, (*span)->end, (*span)->colour, (*span)->share);
    }
    row.visit_runs([this](int begin, std::span<const OverlayRow::Pixel> pixels, bool opaque) {
      add_run(begin, pixels, opaque);
    });
    row_[static_cast<std::size_t>(y) + 1] = runs_.size();
  }
}

void Overlay::add_run(int begin, std::span<const std::array<float, 4>> pixels, bool opaque) {
  runs_.push_back({begin, begin + static_cast<int>(pixels.size()), opaque,
                   opaque ? bytes_.size() : blends_.size()});
  for (const std::array<float, 4>& p : pixels) {
    if (!opaque) {
      blends_.push_back(Blend::of(p[3], {p[0], p[1], p[2]}));
      continue;
    }
    for (std::size_t i = 0; i < 3; ++i) {
      bytes_.push_back(static_cast<std::uint8_t>(std::min(p[i] + 0.5F, 255.0F)));
    }
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
  std::vector<std::uint8_t> row;
  for (int x = 0; x < width; ++x) row.insert(row.end(), {background.r, background.g, background.b});
  image_.rgb.reserve(row.size() * static_cast<std::size_t>(height));
  for (int y = 0; y < height; ++y) image_.rgb.insert(image_.rgb.end(), row.begin(), row.end());
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
  if (weight == 1 << 16) {
    fill_pixels(at, x_end - x_begin, colour);
    return;
  }
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
  rasteriser_.rasterise(shape, clip_, [&](int y, int begin, int end, float coverage) {
    accumulated_.push_back({y, begin, end, coverage * strength});
  });
}

void Painter::fill_accumulated(Colour colour) {
  std::vector<float> row(static_cast<std::size_t>(image_.width));  // opacities, zero between rows
  const std::vector<const Stretch*> stretches = sorted_by_row(accumulated_, image_.height);
  for (auto first = stretches.begin(); first != stretches.end();) {
    const int y = (*first)->y;
    int begin = image_.width;
    int end = 0;
    for (; first != stretches.end() && (*first)->y == y; ++first) {
      const Stretch& stretch = **first;
      begin = std::min(begin, stretch.begin);
      end = std::max(end, stretch.end);
      for (int x = stretch.begin; x < stretch.end; ++x) {
        float& opacity = row[static_cast<std::size_t>(x)];
        opacity = std::max(opacity, stretch.opacity);
      }
    }
    for (int x = first_not_zero(row.data(), begin, end); x < end;
         x = first_not_zero(row.data(), x + 1, end)) {
      blend(y, x, x + 1, colour, std::exchange(row[static_cast<std::size_t>(x)], 0.0F));
    }
  }
  accumulated_.clear();
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
