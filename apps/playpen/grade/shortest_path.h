// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "sim/core/pose.h"
#include "sim/world/description.h"
#include "sim/world/occupancy_map.h"

namespace playpen::grade {

/// A path through free space, straight from point to point.
struct Way {
  double length_m = 0.0;          ///< [m]
  std::vector<sim::Vec2> points;  ///< in W, from start to goal [m]
};

/// Radius of the largest circle around the origin inside a convex outline [m].
[[nodiscard]] double inscribed_radius(const sim::Polygon& outline);

/// Inflates a map for the centre of a round robot: a cell becomes solid if the distance from its
/// centre to the area of a solid cell is less than the radius.
/// @param map       cells over 0.5 are solid.
/// @param radius_m  >= 0.
/// @return 1 for solid cells, 0 for others.
/// @note Time grows with the number of cells, and with the number of solid cells beside free ones
///       times the number of cells within the radius.
[[nodiscard]] sim::OccupancyMap inflate(const sim::OccupancyMap& map, double radius_m);

/// The shortest path between two points that avoids solid cells, at any angle.
///
/// The region of free cells is a polygon with holes, so the shortest path consists of straight
/// lines that turn at its convex corners (Lozano-Perez and Wesley, "An algorithm for planning
/// collision-free paths among polyhedral obstacles", CACM 22(10), 1979). A* searches these corners
/// and tests lines of sight only when needed. It uses integers and is exact for ends rounded to
/// 1/1024 cell. A path may run along solid cells, but not between two that meet at a corner, and
/// does not leave the map.
///
/// @param space   cells over 0.5 are solid.
/// @param slip_m  an end in a solid cell is connected by a straight line to the centre of the
///        nearest free cell, if that is within this distance [m].
/// @return nullopt if there is no path, or an end is in solid cells or outside the map.
/// @note Time grows with the square of the number of convex corners in the worst case.
[[nodiscard]] std::optional<Way> shortest_way(const sim::OccupancyMap& space,
                                              const sim::Vec2& start, const sim::Vec2& goal,
                                              double slip_m = 0.0);

}  // namespace playpen::grade
