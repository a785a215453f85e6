// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "sim/world/description.h"
#include "sim/world/robot_model.h"

/// What the physics can build: sizes, places and outlines outside of these limits end in an
/// assertion of Box2D, or in a division by zero.
namespace sim::io {

/// What is wrong with a number, an outline or a place, as a ConfigIssue tells it.
struct SolidFault {
  std::string key;  ///< the member that it concerns, e.g. "/size/0"; "": the whole
  std::string expected;
  std::string found;
  std::string hint;
};

/// Of a box that stands on the floor: finite, at least least_length_m() along each side and
/// kLeastLength_m high, within kFarthest_m of the origin of W. nullopt if it can be built.
[[nodiscard]] std::optional<SolidFault> box_fault(const ObstacleDescription& box);

/// Of a floor: its size and how far it reaches.
[[nodiscard]] std::optional<SolidFault> floor_fault(const ArenaDescription& arena);

/// Of the walls of a map: finite, within kFarthest_m, no edge shorter than least_length_m().
[[nodiscard]] std::optional<SolidFault> walls_fault(const ArenaDescription& arena);

/// Of a robot's outline: 3 to 8 vertices, convex, counter-clockwise, at least 1 cm^2 large and
/// kLeastLength_m across, no side shorter than that.
[[nodiscard]] std::optional<SolidFault> footprint_fault(const Polygon& outline);

/// Of a robot model: its outline, height, mass and wheels.
[[nodiscard]] std::optional<SolidFault> model_fault(const RobotModel& model);

/// Whether a pose is one of numbers, within kFarthest_m of the origin of W.
[[nodiscard]] bool is_place(const Pose& X_WB) noexcept;

/// Twice the area of a polygon is positive if it runs counter-clockwise [m^2].
[[nodiscard]] double area_m2(const Polygon& outline);

}  // namespace sim::io
