// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <utility>

#include "par_common/grid.h"

namespace par {

/// Walks along Bresenham's line and calls `visit` for each of its cells, both ends included, until
/// `visit` returns false.
template <typename Visit>
void walk_line(const Cell& from, const Cell& to, Visit visit) {
  const std::int64_t columns = std::abs(std::int64_t{to.column} - from.column);
  const std::int64_t rows = std::abs(std::int64_t{to.row} - from.row);
  const int column_step = to.column < from.column ? -1 : 1;
  const int row_step = to.row < from.row ? -1 : 1;
  const bool steep = rows > columns;
  const std::int64_t major = steep ? rows : columns;
  const std::int64_t minor = steep ? columns : rows;

  Cell cell = from;
  std::int64_t error = major;  // twice the distance to the next minor step, in parts of 2 major
  for (std::int64_t i = 0;; ++i) {
    if (!visit(cell) || i == major) return;
    error += 2 * minor;
    const bool side_step = error >= 2 * major;
    if (side_step) error -= 2 * major;
    if (!steep || side_step) cell.column += column_step;
    if (steep || side_step) cell.row += row_step;
  }
}

/// Whether the straight line between the centres of two cells touches only cells that are 0 in a
/// row-major list with `stride` cells per row. Cells are closed squares, so a cell that the line
/// touches at a corner counts. Both ends must be inside the list.
///
/// On the border between the columns i and i + 1 (i counts along the longer side, of length n), the
/// line is m (2 i + 1) / (2 n) cells up the shorter side. There the row changes from k to k + 1
/// when this value has reached k + 1/2. If it is exactly k + 1/2, the line goes through the corner
/// of four cells.
[[nodiscard]] inline bool line_is_clear(const std::uint8_t* cells, std::ptrdiff_t stride, int x0,
                                        int y0, int x1, int y1) {
  std::ptrdiff_t n = std::abs(std::ptrdiff_t{x1} - x0);
  std::ptrdiff_t m = std::abs(std::ptrdiff_t{y1} - y0);
  std::ptrdiff_t along = x1 < x0 ? -1 : 1;  // index step from a cell to the next one
  std::ptrdiff_t across = y1 < y0 ? -stride : stride;
  if (m > n) {
    std::swap(n, m);
    std::swap(along, across);
  }
  const std::uint8_t* cell = cells + y0 * stride + x0;
  if (*cell != 0) return false;
  std::ptrdiff_t height = n + m;  // m (2 i + 1) + n - 2 n k
  for (std::ptrdiff_t i = 0; i < n; ++i) {
    if (height >= 2 * n) {
      if (cell[across] != 0) return false;
      if (height == 2 * n && cell[along] != 0) return false;
      cell += across;
      height -= 2 * n;
    }
    cell += along;
    if (*cell != 0) return false;
    height += 2 * m;
  }
  return true;
}

}  // namespace par
