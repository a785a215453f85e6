// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "sim/world/description.h"
#include "sim/world/robot_model.h"

/// Limits of what the physics can build. Sizes, positions and outlines outside these limits end in
/// an assertion of Box2D or in a division by zero.
namespace sim::io {

/// An error in a number, an outline or a position, with the texts of a ConfigIssue.
struct SolidError {
  std::string key;  ///< the wrong member, e.g. "/size/0"; "": the whole
  std::string expected;
  std::string found;
  std::string hint;
  const char* id = "world/out-of-range";  ///< of the ConfigIssue
};

/// Checks a box that stands on the floor: finite numbers, at least least_length_m() along each side
/// and kLeastLength_m high, within kFarthest_m of the origin of W. nullopt if it can be built.
[[nodiscard]] std::optional<SolidError> check_box(const ObstacleDescription& box);

/// Checks an obstacle of any shape: as check_box(); the outline of a polygon must be simple, with 3
/// to kMostOutlineVertices vertices, no side shorter than least_length_m(), and at least 1 mm^2
/// large. nullopt if it can be built.
[[nodiscard]] std::optional<SolidError> check_obstacle(const ObstacleDescription& obstacle);

/// Checks what only obstacles need that move or can be pushed: a circle, a box, or a convex polygon
/// of at most 8 vertices; neither dynamic nor portable. nullopt for others.
[[nodiscard]] std::optional<SolidError> check_movable(const ObstacleDescription& obstacle);

/// Checks the size and the position of a floor.
[[nodiscard]] std::optional<SolidError> check_floor(const ArenaDescription& arena);

/// Checks the walls of a map: finite numbers, within kFarthest_m, no edge shorter than
/// least_length_m().
[[nodiscard]] std::optional<SolidError> check_walls(const ArenaDescription& arena);

/// Checks a robot's outline: 3 to 8 vertices, convex, counter-clockwise, at least 1 cm^2 large and
/// kLeastLength_m across, no side shorter than that.
[[nodiscard]] std::optional<SolidError> check_footprint(const Polygon& outline);
/// Checks the parts of a body that has several.
[[nodiscard]] std::optional<SolidError> check_parts(const RobotModel& model);

/// Checks a superstructure of a robot: 3 to 8 vertices, convex, counter-clockwise, at least 1 mm^2
/// large and kLeastLength_m across, no side shorter than that; higher than the body, at most 10 m.
[[nodiscard]] std::optional<SolidError> check_superstructure(const Superstructure& part,
                                                             double body_height_m);

/// Checks a robot model: its outline, height, superstructures, mass and wheels.
[[nodiscard]] std::optional<SolidError> check_model(const RobotModel& model);

/// Whether a pose is finite and within kFarthest_m of the origin of W.
[[nodiscard]] bool is_valid_pose(const Pose& X_WB) noexcept;

}  // namespace sim::io
