// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "par_common/grid.h"

/// Small grids for tests.
namespace par::test {

inline GridFrame frame(int width, int height, double cell_size_m = 1.0) {
  GridFrame result;
  result.width = width;
  result.height = height;
  result.cell_size_m = cell_size_m;
  return result;
}

/// A mask from rows of `#` (1) and anything else (0), the top row first; cells of 1 m.
inline Mask mask(const std::vector<std::string>& rows) {
  Mask result(frame(static_cast<int>(rows.front().size()), static_cast<int>(rows.size())));
  for (int row = 0; row < result.height(); ++row) {
    for (int column = 0; column < result.width(); ++column) {
      const char c = rows[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)];
      result[{column, row}] = c == '#' ? 1 : 0;
    }
  }
  return result;
}

/// A random cell. (It uses the engine's bits, because distributions differ between libraries.)
inline Cell random_cell(const GridFrame& frame, std::mt19937& random) {
  return frame.cell_at(random() % frame.size());
}

/// A grid in which each cell is blocked with a probability of `percent`.
inline Mask random_mask(const GridFrame& frame, std::mt19937::result_type percent,
                        std::mt19937& random) {
  Mask result(frame);
  for (std::uint8_t& cell : result.values()) cell = random() % 100 < percent ? 1 : 0;
  return result;
}

}  // namespace par::test
