// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <utility>

namespace sim {

/// Calls visit(column, row) once for each cell of a line that lies in a grid of that size.
/// Canvas::draw_line defines the cells of a line.
///
/// Let n be the distance along the longer (major) axis and m the distance along the minor axis.
/// Cell i of the line lies at i on the major axis and, on the minor axis, at
///   k(i) = floor((2 m i + n) / (2 n)),
/// the nearest cell, as in Bresenham's algorithm. k does not decrease, so the cells inside the grid
/// are one interval of i, which has a closed form. The running error then starts at the first cell
/// of this interval.
template <typename Visit>
void visit_line(int width, int height, int column0, int row0, int column1, int row1, Visit visit) {
  // Coordinates may be any ints, so products of two differences need 66 bits.
  __extension__ typedef __int128 Int128;
  using std::int64_t;
  const int64_t width_distance = std::abs(int64_t{column1} - column0);
  const int64_t height_distance = std::abs(int64_t{row1} - row0);
  const bool steep = height_distance > width_distance;
  // Start at the smaller major coordinate, so that both directions give the same cells.
  if (steep ? row1 < row0 : column1 < column0) {
    std::swap(column0, column1);
    std::swap(row0, row1);
  }
  const int64_t n = steep ? height_distance : width_distance;
  const int64_t m = steep ? width_distance : height_distance;
  const int64_t major0 = steep ? row0 : column0;
  const int64_t minor0 = steep ? column0 : row0;
  const int64_t major_size = steep ? height : width;
  const int64_t minor_size = steep ? width : height;
  const bool minor_falls = steep ? column1 < column0 : row1 < row0;

  // The interval of cells inside along the major axis, then reduced to those inside along the minor
  // axis.
  int64_t first = std::max<int64_t>(0, -major0);
  int64_t last = std::min<int64_t>(n, major_size - 1 - major0);
  const int64_t k_least = std::max<int64_t>(0, minor_falls ? minor0 - (minor_size - 1) : -minor0);
  const int64_t k_most = std::min<int64_t>(m, minor_falls ? minor0 : minor_size - 1 - minor0);
  if (first > last || k_least > k_most) return;
  // The least i with k(i) >= k, for k >= 1: 2 m i + n >= 2 n k.
  const auto first_with = [&](int64_t k) {
    const Int128 numerator = Int128{n} * (2 * k - 1);
    const Int128 denominator = Int128{2} * m;
    return static_cast<int64_t>((numerator + denominator - 1) / denominator);
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
    visit(steep ? minor : major, steep ? major : minor);
    remainder += 2 * m;
    if (remainder >= 2 * n) {
      remainder -= 2 * n;
      minor += minor_step;
    }
  }
}

}  // namespace sim
