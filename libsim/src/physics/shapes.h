// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <box2d/b2_circle_shape.h>
#include <box2d/b2_collision.h>
#include <box2d/b2_distance.h>
#include <box2d/b2_edge_shape.h>
#include <box2d/b2_polygon_shape.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

#include "sim/core/pose.h"

/// Box2D shapes and units: see docs/decisions/box2d_scale.md.
namespace sim {

inline constexpr double kScale = 10.0;  ///< Box2D units per metre
inline constexpr float kScaleF = 10.0F;

[[nodiscard]] inline b2Vec2 to_box2d(const Vec2& p) {
  return {static_cast<float>(p.x() * kScale), static_cast<float>(p.y() * kScale)};
}

[[nodiscard]] inline double metres(float units) { return static_cast<double>(units) / kScale; }

/// Transform of static solids, whose shapes are given in W.
[[nodiscard]] inline b2Transform identity_transform() {
  b2Transform xf;
  xf.SetIdentity();
  return xf;
}

/// Makes a polygon shape.
/// @param vertices  of a convex polygon, counter-clockwise, 3 to b2_maxPolygonVertices [m].
[[nodiscard]] b2PolygonShape polygon_shape(const std::vector<Vec2>& vertices);

/// Makes a circle shape with a skin outside of it, as polygons and edges have. So bodies keep the
/// same distance from solids of any shape.
[[nodiscard]] b2CircleShape circle_shape(const Vec2& center, double radius_m);

/// Makes a side of an outline: an edge that is solid on its left, with smooth joints to the sides
/// before and after it.
/// @param vertices  of the outline, counter-clockwise around the solid [m].
/// @param index     of the side's first vertex.
[[nodiscard]] b2EdgeShape edge_shape(const std::vector<Vec2>& vertices, std::size_t index);

/// Radius of a shape without its skin [Box2D units]: 0 for polygons and edges.
[[nodiscard]] inline float core_radius(const b2Shape& shape) {
  return shape.GetType() == b2Shape::e_circle ? shape.m_radius - b2_polygonRadius : 0.0F;
}

/// The least n . v over the points v of a shape without its skin, in W.
[[nodiscard]] inline float least_along(const b2Vec2& n, const b2Shape& shape,
                                       const b2Transform& xf) {
  const b2Vec2 local = b2MulT(xf.q, n);
  float least = std::numeric_limits<float>::infinity();
  if (shape.GetType() == b2Shape::e_polygon) {
    const auto& polygon = static_cast<const b2PolygonShape&>(shape);
    for (int32 i = 0; i < polygon.m_count; ++i) {
      least = std::min(least, b2Dot(local, polygon.m_vertices[i]));
    }
  } else if (shape.GetType() == b2Shape::e_circle) {
    least = b2Dot(local, static_cast<const b2CircleShape&>(shape).m_p) - core_radius(shape);
  } else {
    const auto& edge = static_cast<const b2EdgeShape&>(shape);
    least = std::min(b2Dot(local, edge.m_vertex1), b2Dot(local, edge.m_vertex2));
  }
  return least + b2Dot(n, xf.p);
}

/// Nearest points of two shapes, in W, and their distance; 0: they overlap, and the points mean
/// nothing [Box2D units].
struct ShapeDistance {
  b2Vec2 pointA;
  b2Vec2 pointB;
  float distance;
};

/// Distance of two shapes without their skins.
[[nodiscard]] ShapeDistance distance_between(const b2Shape& a, const b2Transform& xf_a,
                                             const b2Shape& b, const b2Transform& xf_b);
/// The same with circles as their centres.
[[nodiscard]] ShapeDistance core_distance(const b2Shape& a, const b2Transform& xf_a,
                                          const b2Shape& b, const b2Transform& xf_b);
/// Whether two shapes with their skins overlap.
[[nodiscard]] bool overlap(const b2Shape& a, const b2Transform& xf_a, const b2Shape& b,
                           const b2Transform& xf_b);

/// Distance of two boxes; 0 if they overlap.
[[nodiscard]] inline float gap_between(const b2AABB& a, const b2AABB& b) {
  return b2Max(b2Max(b.lowerBound - a.upperBound, a.lowerBound - b.upperBound), b2Vec2(0.0F, 0.0F))
      .Length();
}

/// A box extended on all sides by `by_m` [m].
[[nodiscard]] b2AABB expanded(b2AABB box, double by_m);

}  // namespace sim
