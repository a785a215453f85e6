// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "sim/core/pose.h"
#include "sim/world/description.h"

namespace sim {

/// An occupancy grid: how likely each square cell of the floor is occupied.
///
/// Laid out as the canvas is: row-major, row 0 at the top (highest y), column 0 at the left;
/// `origin` is the W position of the bottom left corner of the bottom left cell.
struct OccupancyMap {
  int width = 0;               ///< columns
  int height = 0;              ///< rows
  double cell_size_m = 0.02;   ///< [m], > 0
  Vec2 origin = Vec2::Zero();  ///< [m]
  std::vector<float> cells;    ///< width * height, each in 0 (free) .. 1 (occupied); 0.5: unknown

  [[nodiscard]] float at(int column, int row) const {
    return cells[static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                 static_cast<std::size_t>(column)];
  }
};

/// The true map of an arena: 1 for each cell whose area solid things reach into (extended
/// obstacles, dock separators and walls, and, if it has a border, all beyond the floor), else 0;
/// whatever their height. Robots are left out. A cell that a solid only touches with an edge (or
/// reaches into by less than a millionth of its side) is free. Otherwise exact, for turned boxes
/// and slanted walls too.
/// @param arena  with its obstacles' present state.
/// @param grid   size and place of the cells, as of a canvas. @pre sides >= 1, cell size > 0
/// @note Time grows with the cells on outlines and the cells that are filled: an arena of thirty
///       boxes takes microseconds.
[[nodiscard]] OccupancyMap true_map(const ArenaDescription& arena, const CanvasDescription& grid);

}  // namespace sim
