// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "par_common/grid.h"

namespace par {

/// What lies beyond the edge of a grid.
enum class Outside { kFree, kBlocked };

/// Distance from the centre of each cell to the centre of the nearest blocked cell [m]; 0 on
/// blocked cells, infinity if there is none.
///
/// The exact Euclidean distance transform of P. F. Felzenszwalb and D. P. Huttenlocher, "Distance
/// transforms of sampled functions" (Theory of Computing 8, 2012): the squared distance is a sum
/// over x and y, so it is found by columns first and then by rows, and in one dimension it is the
/// lower envelope of one parabola a cell, which a single sweep finds. O(cells), whatever the
/// distances.
///
/// @param outside  kBlocked: the grid is surrounded by blocked cells.
[[nodiscard]] Grid<double> distance_to_blocked_m(const Mask& blocked,
                                                 Outside outside = Outside::kBlocked);

/// Blocked cells grown by a radius: those whose centre is at most radius_m from that of a blocked
/// one. With the radius of the robot's circle the robot becomes a point, and may be planned for as
/// one (T. Lozano-Perez, "Spatial planning: a configuration space approach", IEEE Transactions on
/// Computers 32(2), 1983).
///
/// Distances are from centre to centre, and what stands in a cell may fill it: to be on the safe
/// side add half a cell's diagonal (0.71 cells) to the radius. The S1R's own circle has 0.098 m.
/// @throw std::invalid_argument if radius_m is negative or not a number.
[[nodiscard]] Mask inflate(const Mask& blocked, double radius_m,
                           Outside outside = Outside::kBlocked);

/// The free cell nearest to a given one (itself, if it is free), by the distance of their centres;
/// of equally near ones the one that comes first in row-major order. For a robot that finds itself
/// a little inside an inflated wall. nullopt if none is within max_distance_m.
/// `from` may lie outside the grid.
[[nodiscard]] std::optional<Cell> nearest_free(const Mask& blocked, const Cell& from,
                                               double max_distance_m);

}  // namespace par
