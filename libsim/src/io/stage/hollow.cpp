// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "io/stage/draft.h"
#include "sim/core/math.h"
#include "sim/world/outline.h"

namespace sim::io::stage {

bool stands_inside(const RobotDraft& robot, const Polygon& outline) {
  if (outline.empty() || robot.footprint.empty()) return false;
  Polygon footprint_W;
  for (const Vec2& corner : robot.footprint) footprint_W.push_back(robot.X_WB * corner);
  const bool corners_inside =
      std::all_of(footprint_W.begin(), footprint_W.end(),
                  [&](const Vec2& corner) { return is_inside(outline, corner); });
  if (!corners_inside) return false;
  // No corner of the outline reaches into the body, so no side crosses it.
  return std::none_of(outline.begin(), outline.end(),
                      [&](const Vec2& corner) { return is_inside(footprint_W, corner); });
}

std::vector<Json> walls_of(const Polygon& outline, const Json& solid) {
  std::vector<Json> walls;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec2& begin = outline[i];
    const Vec2 side = outline[(i + 1) % outline.size()] - begin;
    const double length_m = side.norm();
    if (length_m < kBoundaryThickness_m) continue;
    const Vec2 left(-side.y() / length_m, side.x() / length_m);
    Json wall = solid;
    for (const char* key : {"shape", "outline", "fiducial"}) wall.erase(key);
    wall["center"] = point_json(begin + 0.5 * side + 0.5 * kBoundaryThickness_m * left);
    wall["yaw_deg"] = neat_deg(math::atan2(side.y(), side.x()));
    wall["size"] = Json::array({neat(length_m), kBoundaryThickness_m});
    walls.push_back(std::move(wall));
  }
  return walls;
}

}  // namespace sim::io::stage
