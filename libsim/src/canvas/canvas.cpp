// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/canvas/canvas.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "sim/core/assert.h"

namespace sim {
namespace {

// Coordinates are any ints, so products of two differences need 66 bits.
__extension__ typedef __int128 Int128;

constexpr int kCoordinateLimit = 1 << 30;
constexpr int kMaxCells = 8192;

// floor(value), saturated; NaN counts as far to the left.
int saturated_floor(double value) noexcept {
  const double floored = std::floor(value);
  if (!(floored > -kCoordinateLimit)) return -kCoordinateLimit;
  if (floored > kCoordinateLimit) return kCoordinateLimit;
  return static_cast<int>(floored);
}

// ceil(a / b) for a of any sign and b > 0.
Int128 ceil_divide(Int128 a, Int128 b) noexcept { return a >= 0 ? (a + b - 1) / b : -(-a / b); }

}  // namespace

Canvas::Canvas(const CanvasDescription& description)
    : width_(description.width),
      height_(description.height),
      cell_size_m_(description.cell_size_m),
      origin_(description.origin) {
  SIM_ASSERT(width_ >= 1 && width_ <= kMaxCells && height_ >= 1 && height_ <= kMaxCells);
  SIM_ASSERT(cell_size_m_ > 0.0);
  data_.assign(offset(0, height_), 0);
}

int Canvas::column(double x_m) const noexcept {
  return saturated_floor((x_m - origin_.x()) / cell_size_m_);
}

int Canvas::row(double y_m) const noexcept {
  const int from_bottom = saturated_floor((y_m - origin_.y()) / cell_size_m_);
  return std::clamp(height_ - 1 - from_bottom, -kCoordinateLimit, kCoordinateLimit);
}

// Source-over of colours that are not premultiplied. With weights ws = a_s * 255 of the source and
// wd = a_d * (255 - a_s) of what is there, alpha = (ws + wd) / 255 and each channel is the weighted
// mean, both rounded to nearest.
void Canvas::blend(std::uint8_t* cell, Colour colour) noexcept {
  const unsigned source_weight = colour.a * 255u;
  const unsigned cell_weight = cell[3] * (255u - colour.a);
  const unsigned total = source_weight + cell_weight;
  if (source_weight == 0) return;
  const auto mix = [&](std::uint8_t source, std::uint8_t below) {
    return static_cast<std::uint8_t>((source * source_weight + below * cell_weight + total / 2) /
                                     total);
  };
  cell[0] = mix(colour.r, cell[0]);
  cell[1] = mix(colour.g, cell[1]);
  cell[2] = mix(colour.b, cell[2]);
  cell[3] = static_cast<std::uint8_t>((total + 127) / 255);
}

std::optional<Colour> Canvas::pixel(int column, int row) const noexcept {
  if (!contains(column, row)) return std::nullopt;
  const std::uint8_t* const cell = data_.data() + offset(column, row);
  return Colour{cell[0], cell[1], cell[2], cell[3]};
}

// Along the longer side ("major"), cell i of n = major distance lies at i on the major axis and at
//   k(i) = floor((2 m i + n) / (2 n))
// on the minor one, m being the minor distance: the nearest cell, as Bresenham's running error
// finds it. k does not fall, so the cells inside the canvas are one interval of i, which has a
// closed form; the running error is then entered at its first cell.
void Canvas::draw_line(int column0, int row0, int column1, int row1, Colour colour) noexcept {
  using std::int64_t;
  const int64_t width_distance = std::abs(int64_t{column1} - column0);
  const int64_t height_distance = std::abs(int64_t{row1} - row0);
  const bool steep = height_distance > width_distance;
  // Start at the lesser major coordinate, so that both directions give the same cells.
  if (steep ? row1 < row0 : column1 < column0) {
    std::swap(column0, column1);
    std::swap(row0, row1);
  }
  const int64_t n = steep ? height_distance : width_distance;
  const int64_t m = steep ? width_distance : height_distance;
  const int64_t major0 = steep ? row0 : column0;
  const int64_t minor0 = steep ? column0 : row0;
  const int64_t major_size = steep ? height_ : width_;
  const int64_t minor_size = steep ? width_ : height_;
  const bool minor_falls = steep ? column1 < column0 : row1 < row0;

  // Cells that lie inside along the major axis, then those that do along the minor one too.
  int64_t first = std::max<int64_t>(0, -major0);
  int64_t last = std::min<int64_t>(n, major_size - 1 - major0);
  const int64_t k_least = std::max<int64_t>(0, minor_falls ? minor0 - (minor_size - 1) : -minor0);
  const int64_t k_most = std::min<int64_t>(m, minor_falls ? minor0 : minor_size - 1 - minor0);
  if (first > last || k_least > k_most) return;
  // Least i with k(i) >= k, for k >= 1: 2 m i + n >= 2 n k.
  const auto first_with = [&](int64_t k) {
    return static_cast<int64_t>(ceil_divide(Int128{n} * (2 * k - 1), Int128{2} * m));
  };
  if (k_least > 0) first = std::max(first, first_with(k_least));
  if (k_most < m) last = std::min(last, first_with(k_most + 1) - 1);
  if (first > last) return;

  const Int128 numerator = Int128{2} * m * first + n;
  const int64_t k_first = n == 0 ? 0 : static_cast<int64_t>(numerator / (Int128{2} * n));
  int64_t remainder = n == 0 ? 0 : static_cast<int64_t>(numerator % (Int128{2} * n));
  int major = static_cast<int>(major0 + first);
  int minor = static_cast<int>(minor_falls ? minor0 - k_first : minor0 + k_first);
  const int minor_step = minor_falls ? -1 : 1;
  for (int64_t i = first; i <= last; ++i, ++major) {
    set_pixel(steep ? minor : major, steep ? major : minor, colour);
    remainder += 2 * m;
    if (remainder >= 2 * n) {
      remainder -= 2 * n;
      minor += minor_step;
    }
  }
}

void Canvas::clear(Colour colour) noexcept {
  for (std::size_t i = 0; i < data_.size(); i += sizeof colour) {
    std::memcpy(data_.data() + i, &colour, sizeof colour);
  }
}

void Canvas::hash(StateHash& hash) const noexcept {
  hash.add(width_);
  hash.add(height_);
  hash.add_bytes(data_.data(), data_.size());
}

}  // namespace sim
