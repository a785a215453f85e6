// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "physics/body.h"

namespace sim::physics {
namespace {

// The point of a polygon's outline that is nearest to p.
b2Vec2 nearest_on_outline(const b2PolygonShape& shape, const b2Vec2& p) {
  b2Vec2 nearest = shape.m_vertices[0];
  for (int32 i = 0; i < shape.m_count; ++i) {
    const b2Vec2& a = shape.m_vertices[i];
    const b2Vec2 side = shape.m_vertices[(i + 1) % shape.m_count] - a;
    const float share = b2Clamp(b2Dot(p - a, side) / side.LengthSquared(), 0.0F, 1.0F);
    const b2Vec2 on_side = a + share * side;
    if (b2DistanceSquared(p, on_side) < b2DistanceSquared(p, nearest)) nearest = on_side;
  }
  return nearest;
}

}  // namespace

b2AABB box_of(const BodyDetails& d, const b2Transform& xf) {
  b2AABB box;
  d.solid().ComputeAABB(&box, xf, 0);
  for (const b2PolygonShape& part : d.further) {
    b2AABB other;
    part.ComputeAABB(&other, xf, 0);
    box.Combine(other);
  }
  return box;
}

ShapeDistance distance_between(const BodyDetails& a, const b2Transform& xf_a, const b2Shape& b,
                               const b2Transform& xf_b) {
  ShapeDistance least = distance_between(a.solid(), xf_a, b, xf_b);
  for (const b2PolygonShape& part : a.further) {
    const ShapeDistance found = distance_between(part, xf_a, b, xf_b);
    if (found.distance < least.distance) least = found;
  }
  return least;
}

ShapeDistance distance_between(const BodyDetails& a, const b2Transform& xf_a, const BodyDetails& b,
                               const b2Transform& xf_b) {
  ShapeDistance least = distance_between(a, xf_a, b.solid(), xf_b);
  for (const b2PolygonShape& part : b.further) {
    const ShapeDistance found = distance_between(a, xf_a, part, xf_b);
    if (found.distance < least.distance) least = found;
  }
  return least;
}

bool is_between_parts(const BodyDetails& d, std::size_t part, const b2Vec2& point,
                      const b2Vec2& normal) {
  if (d.further.empty()) return false;
  // A point a little inside of the part, and then farther out along the normal: it is outside of
  // the part. If another part contains it, no other body can be there.
  constexpr float kInwards = 0.001F * kScaleF;
  constexpr float kOutwards = 0.002F * kScaleF;
  const auto& own = static_cast<const b2PolygonShape&>(d.part(part));
  const b2Vec2 near = nearest_on_outline(own, point);
  b2Vec2 inwards = own.m_centroid - near;
  inwards.Normalize();
  const b2Vec2 probe = near + kInwards * inwards + kOutwards * normal;
  for (std::size_t i = 0; i < d.part_count(); ++i) {
    if (i != part && d.part(i).TestPoint(identity_transform(), probe)) return true;
  }
  return false;
}

LineDistance distance_to_line(const Body& r, const Wall& wall, const b2Transform& xf) {
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
  b2Vec2 nearest = r.details->shape.m_vertices[0];
  for_each_corner(*r.details, [&](const b2Vec2& p) {
    if (b2Dot(local, p) < b2Dot(local, nearest)) nearest = p;
  });
  const b2Vec2 corner = b2Mul(xf, nearest);
  const Vec2 off = Vec2(metres(corner.x), metres(corner.y)) - wall.start;
  const double way_m = wall.along.dot(off);
  const double apart_m = normal.dot(off);
  return {apart_m, -n, apart_m > 0.0 && way_m >= 0.0 && way_m <= wall.length_m};
}

bool may_reach(const Body& r, const Wall& wall, double reach_m) {
  if (!wall.is_edge) return true;
  const Vec2 off = r.X_WB.position() - wall.start;
  const double way_m = wall.along.dot(off);
  const double past_m = std::max({0.0, -way_m, way_m - wall.length_m});
  const double aside_m = wall.along.x() * off.y() - wall.along.y() * off.x();
  const double within_m = reach_m + r.radius_m;
  return past_m * past_m + aside_m * aside_m < within_m * within_m;
}

}  // namespace sim::physics
