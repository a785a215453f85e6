// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "sim/world/description.h"
#include "sim/world/robot_model.h"

/// Overlaps of solids that stand on the floor, in double precision.
namespace sim::io {

/// Touching does not count as overlap; positions in files have few digits.
inline constexpr double kTouching_m = 1e-6;

/// A convex polygon, or a circle around a single point, with its bounding circle for quick
/// rejection.
struct Solid {
  /// @param polygon  convex, counter-clockwise, in W.
  explicit Solid(Polygon polygon);
  Solid(const Vec2& center, double round_radius_m);

  Polygon outline;
  Vec2 middle = Vec2::Zero();
  double radius_m = 0.0;  ///< of the bounding circle
  bool round = false;     ///< a circle of that radius; `outline` is its centre
};

/// A footprint at a pose in W, scaled about the body's origin.
[[nodiscard]] Polygon placed(const Polygon& footprint, const Pose& X_WB, double scale = 1.0);

/// Convex solids that together are the body of a robot at a pose in W.
[[nodiscard]] std::vector<Solid> solids_of(const RobotModel& model, const Pose& X_WB);

/// Convex solids that together are the obstacle.
[[nodiscard]] std::vector<Solid> solids_of(const ObstacleDescription& obstacle);

/// Penetration depth of two solids: the shortest shift that separates them [m]; 0 if they do not
/// overlap. Separating axes: C. Ericson, Real-Time Collision Detection (2005), sec. 5.2.1.
[[nodiscard]] double overlap_m(const Solid& a, const Solid& b);

/// The greatest overlap of any two of the solids [m].
[[nodiscard]] double overlap_m(const std::vector<Solid>& a, const std::vector<Solid>& b);

/// A point of a wall that the solid overlaps; nullopt if there is none.
[[nodiscard]] std::optional<Vec2> wall_within(const std::vector<WallLoop>& walls,
                                              const Solid& solid);

/// The side of the floor beyond which the solids reach farthest, and by how much [m]; "" and 0 if
/// they are on the floor.
[[nodiscard]] std::pair<const char*, double> beyond_floor(const ArenaDescription& arena,
                                                          const std::vector<Solid>& solids);

}  // namespace sim::io
