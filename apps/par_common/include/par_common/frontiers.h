// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "par_common/grid.h"
#include "par_common/occupancy_grid.h"

namespace par {

/// A stretch of border between the known and the unknown.
struct Frontier {
  std::vector<Cell> cells;  ///< at least one; in the order in which they were found
  Cell centre;              ///< the one of its cells that lies nearest to their mean: a place to go
};

/// The cells that are free and have a neighbour (of 4) that is unknown: from there something new is
/// to be seen. What lies beyond the edge of the grid does not count as unknown.
///
/// B. Yamauchi, "A frontier-based approach for autonomous exploration", CIRA 1997.
[[nodiscard]] Mask frontier_cells(const Grid<CellState>& states);

/// Puts cells that touch one another, also at corners, together.
/// @param min_cells  smaller groups are left out: mostly single cells behind corners and noise.
/// @return by the first of their cells in row-major order.
[[nodiscard]] std::vector<Frontier> cluster(const Mask& cells, std::size_t min_cells = 1);

/// frontier_cells() and cluster() in one: Yamauchi's "frontier regions".
[[nodiscard]] std::vector<Frontier> find_frontiers(const Grid<CellState>& states,
                                                   std::size_t min_cells = 1);

/// Cuts a long frontier into parts that one look from the middle of each can cover.
///
/// The number of parts is 1 + floor(cells / (1.8 range_cells) + 0.5), the parts are found by
/// k-means, both as in J. Faigl, M. Kulich and L. Preucil, "Goal assignment using distance cost in
/// multi-robot exploration", IROS 2012. The first means are cells evenly spaced in the frontier's
/// list, so no chance is in it.
/// @param range_cells  how far the sensor (usefully) sees, in cells, > 0.
[[nodiscard]] std::vector<Frontier> split(const Frontier& frontier, double range_cells);

/// How much new floor a robot would see from a cell: the number of unknown cells within range_m
/// that no occupied cell hides, were all unknown ones free.
///
/// An estimate of the information gain of going there, after H. H. Gonzalez-Banos and J.-C.
/// Latombe, "Navigation strategies for exploring indoor environments", International Journal of
/// Robotics Research 21(10-11), 2002. They weigh it against the way: gain x exp(-lambda x length).
/// Rays are Bresenham lines to all cells on the edge of the square round the circle: O(range^2).
/// @return 0 if `from` lies outside the grid or is occupied.
[[nodiscard]] std::size_t information_gain(const Grid<CellState>& states, const Cell& from,
                                           double range_m);

}  // namespace par
