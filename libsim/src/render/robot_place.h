// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "render/layout.h"
#include "sim/core/pose.h"
#include "sim/simulation/scene_snapshot.h"

/// Where robots are in a picture.
namespace sim::render {

/// Distance from the axle's centre to the footprint's farthest corner.
[[nodiscard]] double radius_px(const RobotSnapshot& robot, const Layout& layout);

/// Radius of a robot with the disc that marks it where it is small.
[[nodiscard]] double marked_radius_px(const RobotSnapshot& robot, const Layout& layout);

/// Whether any of a robot is in the picture.
[[nodiscard]] bool has_place(const RobotSnapshot& robot, const Layout& layout);

[[nodiscard]] inline Rectangle rectangle(const Vec2& low, const Vec2& high) {
  return {low.x(), low.y(), high.x(), high.y()};
}

}  // namespace sim::render
