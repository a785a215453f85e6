// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "physics/robot_body.h"

namespace sim::physics {

LineDistance distance_to_line(const Robot& r, const Wall& wall, const b2Transform& xf) {
  Vec2 normal(wall.along.y(), -wall.along.x());
  if (normal.dot(r.X_WB.position() - wall.start) < 0.0) normal = -normal;
  if (r.details->round) {
    const Vec2 off = r.X_WB.position() - wall.start;
    const double apart_m = normal.dot(off) - r.radius_m;
    const double way_m = wall.along.dot(off);
    return {apart_m,
            {static_cast<float>(-normal.x()), static_cast<float>(-normal.y())},
            apart_m > 0.0 && way_m >= 0.0 && way_m <= wall.length_m};
  }
  const b2Vec2 n(static_cast<float>(normal.x()), static_cast<float>(normal.y()));
  const b2Vec2 local = b2MulT(xf.q, n);
  const b2PolygonShape& shape = r.details->shape;
  const b2Vec2* nearest = std::min_element(
      shape.m_vertices, shape.m_vertices + shape.m_count,
      [&](const b2Vec2& p, const b2Vec2& q) { return b2Dot(local, p) < b2Dot(local, q); });
  const b2Vec2 corner = b2Mul(xf, *nearest);
  const Vec2 off = Vec2(metres(corner.x), metres(corner.y)) - wall.start;
  const double way_m = wall.along.dot(off);
  const double apart_m = normal.dot(off);
  return {apart_m, -n, apart_m > 0.0 && way_m >= 0.0 && way_m <= wall.length_m};
}

bool may_reach(const Robot& r, const Wall& wall, double reach_m) {
  if (!wall.is_edge) return true;
  const Vec2 off = r.X_WB.position() - wall.start;
  const double way_m = wall.along.dot(off);
  const double past_m = std::max({0.0, -way_m, way_m - wall.length_m});
  const double aside_m = wall.along.x() * off.y() - wall.along.y() * off.x();
  const double within_m = reach_m + r.radius_m;
  return past_m * past_m + aside_m * aside_m < within_m * within_m;
}

}  // namespace sim::physics
