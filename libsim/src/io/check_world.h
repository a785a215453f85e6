// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "sim/core/error.h"
#include "sim/world/description.h"

namespace sim::io {

/// Whether the part of a world at that JSON pointer is known to be as its author meant it. A part
/// that was in error holds a default, about which nothing is to be complained of a second time.
using TrustedPart = std::function<bool(const std::string& pointer)>;

/// check_world, leaving out what rests on parts that are not trusted.
[[nodiscard]] std::vector<ConfigIssue> check_world_parts(const WorldDescription& world,
                                                         const TrustedPart& trusted);

/// What keeps a robot of `world` from standing at X_WB, in words that go on from "robot r1 cannot
/// stand at (1.00, 2.00): ", by the same rules as a robot's start; nullopt if nothing.
/// @param poses  X_WB of all robots now; robot's own is not looked at.
/// @param robot  index.
[[nodiscard]] std::optional<std::string> blocked_by(const WorldDescription& world,
                                                    const std::vector<Pose>& poses,
                                                    std::size_t robot, const Pose& X_WB);

/// The same of an obstacle that a robot is to put down: the robot itself is not in the way.
/// @param robot     index of that robot.
/// @param obstacle  as it is to stand.
[[nodiscard]] std::optional<std::string> put_down_blocked_by(const WorldDescription& world,
                                                             const std::vector<Pose>& poses,
                                                             std::size_t robot,
                                                             const ObstacleDescription& obstacle);

/// What is against an obstacle's standing where it does, in words that go on from "obstacle o1
/// would "; nullopt if nothing.
[[nodiscard]] std::optional<std::string> outside_floor(const ArenaDescription& arena,
                                                       const ObstacleDescription& obstacle);

/// A place on the floor, clear of everything by some centimetres, for a robot with that outline:
/// in the SyRoTek arena its start pose if free, else as near to the middle of the floor as can be,
/// looking where it can drive farthest. Robots listed in `world` are in its way.
/// @param places_tried  how many of the places are known to be taken, 0 at first. Raised by those
///                      that are found so, for the next call with the same arena and footprint,
///                      the same robots and others.
/// @return nullopt if none of the places tried (every 0.1 m, at most 41 x 41) is free.
[[nodiscard]] std::optional<Pose> find_free_pose(const WorldDescription& world,
                                                 const Polygon& footprint,
                                                 std::size_t& places_tried);

}  // namespace sim::io
