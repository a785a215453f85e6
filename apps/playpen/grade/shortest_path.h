// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "sim/core/pose.h"
#include "sim/world/occupancy_map.h"

namespace playpen::grade {

/// A way through free space, straight from point to point.
struct Way {
  double length_m = 0.0;          ///< [m]
  std::vector<sim::Vec2> points;  ///< in W, from start to goal [m]
};

/// The map as the centre of a round robot sees it: a cell is solid if the distance of its middle
/// from a solid cell's area is less than the radius.
/// @param map       cells over 0.5 are solid.
/// @param radius_m  >= 0.
/// @return 1 for solid cells, 0 for others.
/// @note Time grows with the number of cells, and with the solid ones beside free ones times the
///       cells within the radius.
[[nodiscard]] sim::OccupancyMap inflate(const sim::OccupancyMap& map, double radius_m);

/// The shortest way between two points that stays out of solid cells, at any angle.
///
/// The region of free cells is a polygon with holes, so the shortest way is straight but for
/// turns at its convex corners (Lozano-Perez and Wesley, "An algorithm for planning collision-free
/// paths among polyhedral obstacles", CACM 22(10), 1979). A* over these corners, with lines of
/// sight looked at only when needed; exact, in whole numbers, for ends rounded to 1/1024 cell.
/// A way may run along solid cells, but not between two that meet at a corner, and does not leave
/// the map.
///
/// @param space   cells over 0.5 are solid.
/// @param slip_m  an end in a solid cell is joined by a straight line to the middle of the nearest
///                free cell, if that is no farther than this [m].
/// @return nullopt if there is no way, or an end is in solid cells or off the map.
/// @note Time grows with the square of the number of convex corners in the worst case.
[[nodiscard]] std::optional<Way> shortest_way(const sim::OccupancyMap& space,
                                              const sim::Vec2& start, const sim::Vec2& goal,
                                              double slip_m = 0.0);

}  // namespace playpen::grade
