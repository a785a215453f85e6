// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "par_common/grid.h"

#include <algorithm>
#include <cmath>

namespace par {
namespace {

// Columns and rows saturate here, so that the difference of two of them fits into an int.
constexpr int kLimit = 1 << 30;

// floor(value), saturated at the limits; NaN gives the lower limit.
int bounded_floor(double value) {
  const double floored = std::floor(value);
  if (!(floored > -kLimit)) return -kLimit;
  return floored > kLimit ? kLimit : static_cast<int>(floored);
}

}  // namespace

Cell GridFrame::cell_of(const Point& point) const {
  const int from_bottom = bounded_floor((point.y - origin.y) / cell_size_m);
  return {bounded_floor((point.x - origin.x) / cell_size_m),
          std::clamp(height - 1 - from_bottom, -kLimit, kLimit)};
}

std::size_t count(const Mask& mask) {
  return static_cast<std::size_t>(std::count_if(mask.values().begin(), mask.values().end(),
                                                [](std::uint8_t value) { return value != 0; }));
}

std::vector<Point> to_points(const GridFrame& frame, const std::vector<Cell>& cells) {
  std::vector<Point> points;
  points.reserve(cells.size());
  for (const Cell& cell : cells) points.push_back(frame.centre_of(cell));
  return points;
}

}  // namespace par
