// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "par_common/grid.h"
#include "par_common/occupancy_grid.h"

namespace par {

/// A section of the border between known and unknown.
struct Frontier {
  std::vector<Cell> cells;  ///< at least one; in the order of discovery
  Cell centre;              ///< the cell nearest to the mean of its cells: a place to go
};

/// The free cells that have an unknown neighbour (of 4): from there something new can be seen.
/// Cells beyond the edge of the grid do not count as unknown.
///
/// B. Yamauchi, "A frontier-based approach for autonomous exploration", CIRA 1997.
[[nodiscard]] Mask frontier_cells(const Grid<CellState>& states);

/// Groups cells that touch one another, also at corners.
/// @param min_cells  ignores smaller groups: mostly single cells behind corners, and noise.
/// @return the groups, in the row-major order of their first cells.
[[nodiscard]] std::vector<Frontier> cluster(const Mask& cells, std::size_t min_cells = 1);

/// frontier_cells() followed by cluster(): Yamauchi's "frontier regions".
[[nodiscard]] std::vector<Frontier> find_frontiers(const Grid<CellState>& states,
                                                   std::size_t min_cells = 1);

/// Splits a long frontier into parts. One look from the middle of a part covers the part.
///
/// The number of parts is 1 + floor(cells / (1.8 range_cells) + 0.5); k-means finds the parts. Both
/// follow J. Faigl, M. Kulich and L. Preucil, "Goal assignment using distance cost in multi-robot
/// exploration", IROS 2012. The initial means are cells evenly spaced in the frontier's list, so
/// the result is deterministic.
/// @param range_cells  useful range of the sensor, in cells, > 0.
[[nodiscard]] std::vector<Frontier> split(const Frontier& frontier, double range_cells);

/// How much new floor a robot would see from a cell: the number of unknown cells within range_m
/// that no occupied cell hides, assuming that all unknown cells are free.
///
/// An estimate of the information gain after H. H. Gonzalez-Banos and J.-C. Latombe, "Navigation
/// strategies for exploring indoor environments", International Journal of Robotics Research
/// 21(10-11), 2002. They weigh it against the path: gain x exp(-lambda x length). Rays are
/// Bresenham lines to all cells on the edge of the square around the circle: O(range^2).
/// @return 0 if `from` is outside the grid or occupied.
[[nodiscard]] std::size_t information_gain(const Grid<CellState>& states, const Cell& from,
                                           double range_m);

}  // namespace par
