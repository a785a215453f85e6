// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <limits>

#include "sim/core/pose.h"
#include "sim/world/description.h"

namespace sim::test {

/// A polygon given in frame B, transformed to W.
[[nodiscard]] inline Polygon placed(const Polygon& polygon, const Pose& X_WB) {
  Polygon result;
  for (const Vec2& v : polygon) result.push_back(X_WB * v);
  return result;
}

/// The outline of a box, counter-clockwise, in W.
[[nodiscard]] inline Polygon box_polygon(const ObstacleDescription& o) {
  const Vec2 h = 0.5 * o.size;
  return placed({{h.x(), -h.y()}, {h.x(), h.y()}, {-h.x(), h.y()}, {-h.x(), -h.y()}},
                {o.center.x(), o.center.y(), o.yaw_rad});
}

/// The smallest distance by which two convex, counter-clockwise polygons must be moved apart so
/// that they do not overlap (separating axes over all edge normals); 0 if they do not overlap.
[[nodiscard]] inline double overlap_depth_m(const Polygon& a, const Polygon& b) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [p, q] : {std::pair(&a, &b), std::pair(&b, &a)}) {
    for (std::size_t i = 0; i < p->size(); ++i) {
      const Vec2 edge = (*p)[(i + 1) % p->size()] - (*p)[i];
      const Vec2 outward = Vec2(edge.y(), -edge.x()).normalized();
      double reach = std::numeric_limits<double>::infinity();
      for (const Vec2& v : *q) reach = std::min(reach, outward.dot(v - (*p)[i]));
      least = std::min(least, -reach);
    }
  }
  return std::max(0.0, least);
}

}  // namespace sim::test
