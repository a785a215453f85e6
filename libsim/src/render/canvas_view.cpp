// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "render/canvas_view.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace sim::render {
namespace {

PixelRect whole(const Image& image) { return {0, 0, image.width, image.height}; }

// The place with only the pixels that a picture has.
CanvasView::Place clamped(CanvasView::Place place, const Image& picture) {
  PixelRect& part = place.part;
  part.left = std::clamp(part.left, 0, picture.width);
  part.right = std::clamp(part.right, part.left, picture.width);
  part.top = std::clamp(part.top, 0, picture.height);
  part.bottom = std::clamp(part.bottom, part.top, picture.height);
  return place;
}

}  // namespace

std::size_t canvas_bytes(const CanvasDescription& description) {
  if (description.width < 1 || description.height < 1) return 0;
  return 4 * static_cast<std::size_t>(description.width) *
         static_cast<std::size_t>(description.height);
}

// Span of cells under [begin, end), in cells from the canvas's edge. The weights sum up to the
// fraction of the pixel that lies on the canvas.
CanvasView::Span CanvasView::span(double begin, double end, int cells) {
  Span span;
  const double low = std::max(begin, 0.0);
  const double high = std::min(end, static_cast<double>(cells));
  if (!(high > low)) return span;
  span.first = static_cast<int>(low);
  for (int cell = span.first; cell < high; ++cell) {
    const double length = std::min(high, cell + 1.0) - std::max(low, static_cast<double>(cell));
    span.weights.push_back(static_cast<float>(length / (end - begin)));
  }
  return span;
}

void CanvasView::start(const Place& place) {
  place_ = place;
  const PixelRect& part = place_.part;
  cells_.assign(4 * static_cast<std::size_t>(place.columns) * static_cast<std::size_t>(place.rows),
                0);
  // Division instead of multiplication by the inverse gives integer positions for integer scales.
  const auto span_of = [&](int pixel, double start_px, int count) {
    return span((pixel - start_px) / place.cell_px, (pixel + 1 - start_px) / place.cell_px, count);
  };
  columns_.clear();
  rows_.clear();
  for (int x = part.left; x < part.right; ++x) {
    columns_.push_back(span_of(x, place.left_px, place.columns));
  }
  for (int y = part.top; y < part.bottom; ++y) {
    rows_.push_back(span_of(y, place.top_px, place.rows));
  }
  first_pixel_.assign(static_cast<std::size_t>(place.columns), part.right);
  end_pixel_.assign(static_cast<std::size_t>(place.columns), part.left);
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    const int x = part.left + static_cast<int>(i);
    for (std::size_t k = 0; k < columns_[i].weights.size(); ++k) {
      const std::size_t cell = static_cast<std::size_t>(columns_[i].first) + k;
      first_pixel_[cell] = std::min(first_pixel_[cell], x);
      end_pixel_[cell] = std::max(end_pixel_[cell], x + 1);
    }
  }
  for (std::size_t cell = first_pixel_.size(); cell-- > 1;) {
    first_pixel_[cell - 1] = std::min(first_pixel_[cell - 1], first_pixel_[cell]);
  }
  for (std::size_t cell = 1; cell < end_pixel_.size(); ++cell) {
    end_pixel_[cell] = std::max(end_pixel_[cell], end_pixel_[cell - 1]);
  }
  dirty_.assign(static_cast<std::size_t>(place.rows), Dirty{});
  sums_.resize(static_cast<std::size_t>(place.columns));
  line_.resize(columns_.size());
  valid_ = true;
}

bool CanvasView::find_changes(const std::vector<std::uint8_t>& cells) {
  const std::size_t row_bytes = 4 * static_cast<std::size_t>(place_.columns);
  bool any = false;
  for (std::size_t row = 0; row < dirty_.size(); ++row) {
    dirty_[row] = {};
    std::uint8_t* const old = cells_.data() + row * row_bytes;
    const std::uint8_t* const now = cells.empty() ? nullptr : cells.data() + row * row_bytes;
    const auto differs = [&](std::size_t begin, std::size_t count) {
      if (now != nullptr) return std::memcmp(old + begin, now + begin, count) != 0;
      return std::any_of(old + begin, old + begin + count, [](auto byte) { return byte != 0; });
    };
    if (!differs(0, row_bytes)) continue;
    std::size_t begin = 0;
    std::size_t end = row_bytes;
    while (!differs(begin, 4)) begin += 4;
    while (!differs(end - 4, 4)) end -= 4;
    dirty_[row] = {static_cast<int>(begin / 4), static_cast<int>(end / 4)};
    if (now != nullptr) {
      std::memcpy(old + begin, now + begin, end - begin);
    } else {
      std::memset(old + begin, 0, end - begin);
    }
    any = true;
  }
  return any;
}

// Blends the cells under a row of pixels into the row.
void CanvasView::mix_line(const Span& row, int x_begin, int x_end) {
  const auto span_at = [this](int x) -> const Span& {
    return columns_[static_cast<std::size_t>(x - place_.part.left)];
  };
  // Sums along the columns, then along the row. Colours are premultiplied by alpha.
  const Span& last = span_at(x_end - 1);
  const auto column_begin = static_cast<std::size_t>(span_at(x_begin).first);
  const std::size_t column_end = static_cast<std::size_t>(last.first) + last.weights.size();
  const std::size_t row_bytes = 4 * static_cast<std::size_t>(place_.columns);
  std::fill(sums_.begin() + static_cast<std::ptrdiff_t>(column_begin),
            sums_.begin() + static_cast<std::ptrdiff_t>(column_end), std::array<float, 4>{});
  for (std::size_t i = 0; i < row.weights.size(); ++i) {
    const std::uint8_t* cell =
        cells_.data() + (static_cast<std::size_t>(row.first) + i) * row_bytes + 4 * column_begin;
    const float weight = row.weights[i] / 255.0F;
    for (std::size_t column = column_begin; column < column_end; ++column, cell += 4) {
      const float alpha = weight * static_cast<float>(cell[3]);
      std::array<float, 4>& sum = sums_[column];
      sum[0] += alpha * static_cast<float>(cell[0]);
      sum[1] += alpha * static_cast<float>(cell[1]);
      sum[2] += alpha * static_cast<float>(cell[2]);
      sum[3] += alpha;
    }
  }
  const Span* before = nullptr;
  for (int x = x_begin; x < x_end; ++x) {
    const Span& span = span_at(x);
    Blend& blend = line_[static_cast<std::size_t>(x - place_.part.left)];
    if (before != nullptr && before->first == span.first && span.weights.size() == 1 &&
        before->weights == span.weights) {
      blend = (&blend)[-1];
    } else {
      std::array<float, 3> added{};
      float alpha = 0.0F;
      for (std::size_t i = 0; i < span.weights.size(); ++i) {
        const std::array<float, 4>& sum = sums_[static_cast<std::size_t>(span.first) + i];
        const float weight = span.weights[i];
        for (std::size_t k = 0; k < 3; ++k) added[k] += weight * sum[k];
        alpha += weight * sum[3];
      }
      blend = Blend::of(std::max(1.0F - alpha, 0.0F), added);
    }
    before = &span;
  }
}

// Draws the changed cells on the picture: with a background where they were drawn before, else over
// what the picture shows.
void CanvasView::draw_changes(const Image* below, const Overlay* above) {
  struct Line {
    int row = -1;
    int begin = 0;
    int end = 0;
  } known;  // content of line_, if it comes from a single row of cells
  const PixelRect& part = place_.part;
  for (int y = part.top; y < part.bottom; ++y) {
    const Span& row = rows_[static_cast<std::size_t>(y - part.top)];
    int begin = part.right;
    int end = part.left;
    for (std::size_t i = 0; i < row.weights.size(); ++i) {
      const Dirty& dirty = dirty_[static_cast<std::size_t>(row.first) + i];
      if (dirty.begin == dirty.end) continue;
      begin = std::min(begin, first_pixel_[static_cast<std::size_t>(dirty.begin)]);
      end = std::max(end, end_pixel_[static_cast<std::size_t>(dirty.end) - 1]);
    }
    if (begin >= end) continue;
    const bool alone = row.weights.size() == 1 && row.weights.front() == 1.0F;
    if (!alone || known.row != row.first || known.begin != begin || known.end != end) {
      mix_line(row, begin, end);
      known = {alone ? row.first : -1, begin, end};
    }
    const std::size_t at =
        3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture_.width) +
             static_cast<std::size_t>(begin));
    std::uint8_t* pixel = picture_.rgb.data() + at;
    if (below != nullptr) {
      std::memcpy(pixel, below->rgb.data() + at, 3 * static_cast<std::size_t>(end - begin));
    }
    for (int x = begin; x < end; ++x, pixel += 3) {
      line_[static_cast<std::size_t>(x - part.left)].apply(pixel);
    }
    if (above != nullptr) above->draw_on(picture_, {begin, y, end, y + 1});
  }
}

const Image& CanvasView::update(const Place& place, const std::vector<std::uint8_t>& cells,
                                const Image& below, const Overlay* above) {
  const Place inside = clamped(place, below);
  if (!valid_ || !(inside == place_)) {
    start(inside);
    picture_ = below;
    if (above != nullptr) above->draw_on(picture_, whole(picture_));
  }
  if (find_changes(cells)) draw_changes(&below, above);
  return picture_;
}

Image CanvasView::draw_once(const Place& place, const std::vector<std::uint8_t>& cells, Image below,
                            const Overlay* above) {
  start(clamped(place, below));
  picture_ = std::move(below);
  if (find_changes(cells)) draw_changes(nullptr, nullptr);
  if (above != nullptr) above->draw_on(picture_, whole(picture_));
  forget();
  return std::move(picture_);
}

}  // namespace sim::render
