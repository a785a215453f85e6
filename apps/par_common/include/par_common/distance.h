// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "par_common/grid.h"

namespace par {

/// How the cells beyond the edge of a grid count.
enum class Outside { kFree, kBlocked };

/// Distance from the centre of each cell to the centre of the nearest blocked cell [m]; 0 on
/// blocked cells, infinity if no cell is blocked.
///
/// The exact Euclidean distance transform of P. F. Felzenszwalb and D. P. Huttenlocher, "Distance
/// transforms of sampled functions" (Theory of Computing 8, 2012). The squared distance is a sum
/// over x and y, so the algorithm processes first the columns and then the rows. In one dimension
/// the result is the lower envelope of one parabola per cell, which a single sweep finds. O(cells),
/// independent of the distances.
///
/// @param outside  kBlocked: the grid is surrounded by blocked cells.
[[nodiscard]] Grid<double> distance_to_blocked_m(const Mask& blocked,
                                                 Outside outside = Outside::kBlocked);

/// Inflates blocked cells by a radius: the result contains the cells whose centre is at most
/// radius_m from the centre of a blocked cell. With the radius of the robot's circle, a planner can
/// treat the robot as a point (T. Lozano-Perez, "Spatial planning: a configuration space approach",
/// IEEE Transactions on Computers 32(2), 1983).
///
/// Distances are between centres, but an obstacle may fill its whole cell. To be safe, add half a
/// cell's diagonal (0.71 cells) to the radius. The S1R's own circle has a radius of 0.098 m.
/// @throw std::invalid_argument if radius_m is negative or not a number.
[[nodiscard]] Mask inflate(const Mask& blocked, double radius_m,
                           Outside outside = Outside::kBlocked);

/// The free cell nearest to `from` (`from` itself, if it is free), by the distance of their
/// centres. Of equally near cells, the first in row-major order. Use it for a robot whose own cell
/// is inside an inflated wall. nullopt if no free cell is within max_distance_m. `from` may be
/// outside the grid.
[[nodiscard]] std::optional<Cell> nearest_free(const Mask& blocked, const Cell& from,
                                               double max_distance_m);

}  // namespace par
