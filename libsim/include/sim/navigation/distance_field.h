// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "sim/core/pose.h"
#include "sim/world/occupancy_map.h"

namespace sim {

/// For each cell of a map, the distance to the nearest occupied cell. The layout is that of
/// OccupancyMap: row-major, row 0 at the top.
struct DistanceField {
  int width = 0;                   ///< columns
  int height = 0;                  ///< rows
  double cell_size_m = 0.0;        ///< [m], > 0
  Vec2 origin = Vec2::Zero();      ///< W position of the bottom left corner [m]
  std::vector<float> distances_m;  ///< between centres of cells, 0 in an occupied cell [m]

  [[nodiscard]] float at(int column, int row) const {
    return distances_m[static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                       static_cast<std::size_t>(column)];
  }
};

/// The Euclidean distance transform of a map: exact, in two passes over rows and columns
/// (P. F. Felzenszwalb and D. P. Huttenlocher, "Distance Transforms of Sampled Functions", Theory
/// of Computing 8, 2012, algorithm 1).
///
/// @param map         @pre at least one cell, cell size > 0
/// @param limit_m     larger distances, and all distances of a map without occupied cells, become
///                    this, > 0 [m].
/// @param threshold   a cell is occupied if its probability is above this, [0, 1).
/// @note O(cells). Pure; safe from many threads.
[[nodiscard]] DistanceField distance_field(const OccupancyMap& map, double limit_m,
                                           double threshold = 0.65);

}  // namespace sim
