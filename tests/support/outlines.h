// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>

#include "sim/core/pose.h"
#include "sim/world/outline.h"

/// Obstacles of each shape, and outlines.
namespace sim::test {

/// A notch of 1 x 1 m that opens upwards: concave.
inline const Polygon kNotch{{0, 0},     {1.4, 0},   {1.4, 1.2}, {1.2, 1.2},
                            {1.2, 0.2}, {0.2, 0.2}, {0.2, 1.2}, {0, 1.2}};

[[nodiscard]] inline ObstacleDescription box(std::string name, Vec2 center, Vec2 size,
                                             double yaw_rad = 0.0) {
  ObstacleDescription obstacle;
  obstacle.name = std::move(name);
  obstacle.center = std::move(center);
  obstacle.size = std::move(size);
  obstacle.yaw_rad = yaw_rad;
  return obstacle;
}

[[nodiscard]] inline ObstacleDescription circle(std::string name, Vec2 center, double radius_m) {
  ObstacleDescription obstacle;
  obstacle.name = std::move(name);
  obstacle.center = std::move(center);
  make_circle(obstacle, radius_m);
  return obstacle;
}

/// @param outline  in the obstacle's own frame, whose origin is at `center` [m].
[[nodiscard]] inline ObstacleDescription polygon(std::string name, Vec2 center, Polygon outline,
                                                 double yaw_rad = 0.0) {
  ObstacleDescription obstacle;
  obstacle.name = std::move(name);
  obstacle.center = std::move(center);
  obstacle.yaw_rad = yaw_rad;
  make_polygon(obstacle, std::move(outline));
  return obstacle;
}

/// Distance of a point from the nearest side of a closed outline [m].
[[nodiscard]] inline double distance_to_outline_m(const Vec2& p, const Polygon& outline) {
  double least_m = distance_to_segment_m(p, outline.back(), outline.front());
  for (std::size_t i = 1; i < outline.size(); ++i) {
    least_m = std::min(least_m, distance_to_segment_m(p, outline[i - 1], outline[i]));
  }
  return least_m;
}

}  // namespace sim::test
