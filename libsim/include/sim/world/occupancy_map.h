// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "sim/core/pose.h"
#include "sim/world/description.h"

namespace sim {

/// An occupancy grid: the probability that each square cell of the floor is occupied.
///
/// The layout is that of the canvas: row-major, row 0 at the top (highest y), column 0 at the left.
/// `origin` is the W position of the bottom left corner of the bottom left cell.
struct OccupancyMap {
  int width = 0;               ///< columns
  int height = 0;              ///< rows
  double cell_size_m = 0.02;   ///< [m], > 0
  Vec2 origin = Vec2::Zero();  ///< [m]
  std::vector<float> cells;    ///< width * height values: 0 free .. 1 occupied; 0.5: unknown

  [[nodiscard]] float at(int column, int row) const {
    return cells[static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                 static_cast<std::size_t>(column)];
  }
};

/// The grid of a map of an arena's whole floor, from its bottom left corner.
/// @param cell_size_m  side of a cell [m].
/// @return nullopt if the cell size is not a positive number, or if the map would have more than
///     kMaxCanvasSide cells along a side.
[[nodiscard]] std::optional<CanvasDescription> floor_grid(const ArenaDescription& arena,
                                                          double cell_size_m);

/// The true map of an arena: 1 for each cell that a solid reaches into, else 0. Solids are extended
/// obstacles, dock separators, walls and, if the arena has a border, everything beyond the floor,
/// whatever their height. Robots are left out. A cell that a solid only touches with an edge, or
/// enters by less than a millionth of its side, is free. The result is exact for rotated boxes and
/// slanted walls as well.
/// @param arena  with the current state of its obstacles.
/// @param grid   size and position of the cells, as for a canvas. @pre sides >= 1, cell size > 0
/// @note Cost grows with the number of cells on outlines and of filled cells; an arena of thirty
///     boxes takes microseconds.
[[nodiscard]] OccupancyMap true_map(const ArenaDescription& arena, const CanvasDescription& grid);

}  // namespace sim
