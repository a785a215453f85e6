// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "render/layout.h"
#include "sim/core/pose.h"
#include "sim/simulation/scene_snapshot.h"

/// Positions of robots in a picture.
namespace sim::render {

/// Distance from the axle's centre to the footprint's farthest corner.
[[nodiscard]] double radius_px(const RobotSnapshot& robot, const Layout& layout);

/// Radius of a robot, including the disc that marks a small robot.
[[nodiscard]] double marked_radius_px(const RobotSnapshot& robot, const Layout& layout);

/// Whether any part of a robot is in the picture.
[[nodiscard]] bool has_place(const RobotSnapshot& robot, const Layout& layout);

[[nodiscard]] inline Rectangle rectangle(const Vec2& low, const Vec2& high) {
  return {low.x(), low.y(), high.x(), high.y()};
}

}  // namespace sim::render
