// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "sim/core/pose.h"
#include "sim/world/description.h"

namespace sim::io {

/// A map of more edges than this is a photograph, not a floor plan.
inline constexpr std::size_t kMaxWallEdges = 1'000'000;
/// Pixels along a side of a map's picture.
inline constexpr int kMaxMapSide = 8192;

/// A raster of solid and free cells; row 0 is the top, as in a picture.
struct OccupancyGrid {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> solid;  ///< row by row; not 0: solid
};

/// Outlines of the solid regions, as closed loops with the solid on their left, a vertex only
/// where the direction changes.
///
/// Solid cells that share a side belong together; those that only meet at a corner do not, so
/// each has an outline of its own and the two touch in one vertex. Outside the grid all is free.
/// Loops come in the order of their lowest (then leftmost) edge with free space below it, and each
/// begins there.
///
/// @param origin        W position of the grid's bottom left corner [m].
/// @param resolution_m  side of a cell [m], > 0.
/// @return nullopt if there would be more than kMaxWallEdges edges.
/// @note Time and memory grow with the number of cells.
[[nodiscard]] std::optional<std::vector<WallLoop>> trace_walls(const OccupancyGrid& grid,
                                                               const Vec2& origin,
                                                               double resolution_m);

/// Takes vertices out of outlines, as long as what is left passes within `tolerance_m` of each:
/// what a slanted wall's pixels make a staircase becomes one straight edge. (D. H. Douglas, T. K.
/// Peucker, "Algorithms for the reduction of the number of points required to represent a
/// digitized line or its caricature", Cartographica 10(2), 1973.) An outline that would collapse
/// stays as it is.
void simplify_walls(std::vector<WallLoop>& walls, double tolerance_m);

}  // namespace sim::io
