// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "render/robot_place.h"

#include <algorithm>
#include <cmath>

#include "render/painter.h"

namespace sim::render {

double radius_px(const RobotSnapshot& robot, const Layout& layout) {
  double radius_m = 0.0;
  for (const Vec2& corner : robot.footprint) radius_m = std::max(radius_m, corner.norm());
  return radius_m * layout.pixels_per_m;
}

double marked_radius_px(const RobotSnapshot& robot, const Layout& layout) {
  return std::max(radius_px(robot, layout), 8.0 * layout.unit_px);
}

bool has_place(const RobotSnapshot& robot, const Layout& layout) {
  const Vec2 center = layout(robot.X_WB.position());
  if (robot.footprint.empty() || !is_drawable(center) || !std::isfinite(robot.X_WB.yaw_rad)) {
    return false;
  }
  const Vec2 reach = Vec2::Constant(marked_radius_px(robot, layout));
  return !layout.view_only || rectangle(center - reach, center + reach).overlap(layout.view) > 0.0;
}

}  // namespace sim::render
