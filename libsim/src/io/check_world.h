// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "sim/core/error.h"
#include "sim/world/description.h"

namespace sim::io {

/// Whether the part of a world at that JSON pointer is as its author wrote it. A part that was in
/// error holds a default, and must not cause further issues.
using TrustedPart = std::function<bool(const std::string& pointer)>;

/// Like check_world, without the issues that depend on parts that are not trusted.
[[nodiscard]] std::vector<ConfigIssue> check_world_parts(const WorldDescription& world,
                                                         const TrustedPart& trusted);

/// The obstacle that keeps a robot of `world` from standing at X_WB, by the rules for start poses;
/// nullopt if there is none.
/// @param poses  X_WB of all robots now; the robot's own is ignored.
/// @param robot  index.
/// @return a text that follows "robot r1 cannot stand at (1.00, 2.00): ".
[[nodiscard]] std::optional<std::string> blocked_by(const WorldDescription& world,
                                                    const std::vector<Pose>& poses,
                                                    std::size_t robot, const Pose& X_WB);

/// The obstacle that keeps a robot from putting down an object; the robot itself does not count.
/// @param robot     index of that robot.
/// @param obstacle  the object in the pose in which it would stand.
[[nodiscard]] std::optional<std::string> put_down_blocked_by(const WorldDescription& world,
                                                             const std::vector<Pose>& poses,
                                                             std::size_t robot,
                                                             const ObstacleDescription& obstacle);

/// The reason why an obstacle cannot stand in its place on the floor, as a text that follows
/// "obstacle o1 would "; nullopt if it can.
[[nodiscard]] std::optional<std::string> outside_floor(const ArenaDescription& arena,
                                                       const ObstacleDescription& obstacle);

/// Finds a pose on the floor for a robot with that outline, clear of everything by some
/// centimetres. In the SyRoTek arena it is the start pose if that is free. Otherwise it is as near
/// to the middle of the floor as possible, facing the direction with the longest free way. The
/// robots in `world` count as obstacles.
/// @param places_tried  number of candidate places that are known to be taken, initially 0. This
///     call increases it for the next call with the same arena and footprint and at least the same
///     robots.
/// @return nullopt if no candidate (every 0.1 m, at most 41 x 41) is free.
[[nodiscard]] std::optional<Pose> find_free_pose(const WorldDescription& world,
                                                 const Polygon& footprint,
                                                 std::size_t& places_tried);

}  // namespace sim::io
