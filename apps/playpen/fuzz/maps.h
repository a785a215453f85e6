// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "fuzz/element.h"
#include "sim/core/random_stream.h"

namespace playpen::fuzz {

/// Where a map is generated.
struct MapPlan {
  sim::Vec2 low = sim::Vec2::Zero();   ///< bottom left corner of the area in W [m]
  sim::Vec2 high = sim::Vec2::Zero();  ///< top right corner in W [m]
  sim::Vec2 width_m = {0.4, 0.8};      ///< least and greatest width of corridors, or of doors [m]
  double least_room_m = 0.5;           ///< side of a room [m]
  std::vector<sim::Vec2> places;       ///< to which walls keep a distance, in W [m]
  double away_m = 0.3;                 ///< this distance [m]
};

/// Thickness of the walls of generated maps [m].
inline constexpr double kMapWall_m = 0.05;

/// The walls of a maze of square corridors of one width: a perfect maze by a randomised depth-first
/// search (the recursive backtracker of J. Buck, Mazes for Programmers, 2015, ch. 5), in which
/// about a seventh of the inner walls are then taken away, so that there are loops (braiding, ch.
/// 9). Walls in a line are one box. @return empty if the area holds no two cells along each side.
[[nodiscard]] std::vector<Element> maze_walls(const MapPlan& plan, sim::RandomStream& random);

/// The walls of rooms with doors: a rectangle is divided across its longer side by a wall with a
/// door, then each part, until the rooms are small (recursive division, Buck 2015, ch. 12). No wall
/// ends at a door. @return empty if the area is too small.
[[nodiscard]] std::vector<Element> room_walls(const MapPlan& plan, sim::RandomStream& random);

}  // namespace playpen::fuzz
