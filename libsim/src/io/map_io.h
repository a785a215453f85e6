// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "sim/core/pose.h"
#include "sim/world/description.h"

namespace sim::io {

/// Maximum number of edges of a map; an image with more is a photograph, not a floor plan.
inline constexpr std::size_t kMaxWallEdges = 1'000'000;
/// Maximum side of a map's image [pixels].
inline constexpr int kMaxMapSide = 8192;

/// A raster of solid and free cells; row 0 is at the top.
struct OccupancyGrid {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> solid;  ///< row-major; non-zero: solid
};

/// Traces the outlines of the solid regions: closed loops with the solid on their left, with
/// vertices only where the direction changes.
///
/// Solid cells that share a side belong to the same region. Cells that meet only at a corner do
/// not; their outlines touch in one vertex. Everything outside the grid is free. Loops are sorted
/// by their lowest (then leftmost) edge with free space below it, and each begins there.
///
/// @param origin        W position of the grid's bottom left corner [m].
/// @param resolution_m  side of a cell [m], > 0.
/// @return nullopt if there would be more than kMaxWallEdges edges.
/// @note O(cells) time and memory.
[[nodiscard]] std::optional<std::vector<WallLoop>> trace_walls(const OccupancyGrid& grid,
                                                               const Vec2& origin,
                                                               double resolution_m);

/// Removes vertices from outlines as long as the remaining outline passes within `tolerance_m` of
/// each removed vertex. So the pixel staircase of a slanted wall becomes one straight edge. (D. H.
/// Douglas, T. K. Peucker, "Algorithms for the reduction of the number of points required to
/// represent a digitized line or its caricature", Cartographica 10(2), 1973.) An outline that would
/// collapse remains unchanged.
void simplify_walls(std::vector<WallLoop>& walls, double tolerance_m);

}  // namespace sim::io
