// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "physics/shapes.h"

#include <array>
#include <cstddef>

#include "sim/core/assert.h"

namespace sim {
namespace {

// Moves a nearest point from the centre of a circle to its outline.
void shorten(b2DistanceOutput& output, float radius, b2Vec2& center, const b2Vec2& other) {
  if (output.distance <= radius) {
    center = other;
    output.distance = 0.0F;
    return;
  }
  center -= (radius / output.distance) * (center - other);
  output.distance -= radius;
}

}  // namespace

b2PolygonShape polygon_shape(const std::vector<Vec2>& vertices) {
  SIM_ASSERT(vertices.size() >= 3 && vertices.size() <= b2_maxPolygonVertices);
  std::array<b2Vec2, b2_maxPolygonVertices> points;
  const std::size_t n = std::min(vertices.size(), points.size());
  std::transform(vertices.begin(), vertices.begin() + static_cast<std::ptrdiff_t>(n),
                 points.begin(), to_box2d);
  b2PolygonShape shape;
  shape.Set(points.data(), static_cast<int32>(n));
  return shape;
}

b2CircleShape circle_shape(const Vec2& center, double radius_m) {
  b2CircleShape shape;
  shape.m_p = to_box2d(center);
  shape.m_radius = static_cast<float>(radius_m * kScale) + b2_polygonRadius;
  return shape;
}

b2EdgeShape edge_shape(const std::vector<Vec2>& vertices, std::size_t index) {
  const std::size_t n = vertices.size();
  b2EdgeShape shape;
  shape.SetOneSided(to_box2d(vertices[(index + n - 1) % n]), to_box2d(vertices[index]),
                    to_box2d(vertices[(index + 1) % n]), to_box2d(vertices[(index + 2) % n]));
  return shape;
}

b2DistanceOutput distance_between(const b2Shape& a, const b2Transform& xf_a, const b2Shape& b,
                                  const b2Transform& xf_b, b2SimplexCache& cache) {
  b2DistanceInput input;
  input.proxyA.Set(&a, 0);
  input.proxyB.Set(&b, 0);
  input.transformA = xf_a;
  input.transformB = xf_b;
  input.useRadii = false;
  b2DistanceOutput output;
  b2Distance(&output, &cache, &input);
  // So far this is the distance to the centre of a circle.
  if (b.GetType() == b2Shape::e_circle) {
    shorten(output, core_radius(b), output.pointB, output.pointA);
  }
  if (a.GetType() == b2Shape::e_circle) {
    shorten(output, core_radius(a), output.pointA, output.pointB);
  }
  return output;
}

b2DistanceOutput distance_between(const b2Shape& a, const b2Transform& xf_a, const b2Shape& b,
                                  const b2Transform& xf_b) {
  b2SimplexCache cache;
  cache.count = 0;
  return distance_between(a, xf_a, b, xf_b, cache);
}

b2AABB expanded(b2AABB box, double by_m) {
  const float by = static_cast<float>(by_m) * kScaleF;
  box.lowerBound -= b2Vec2(by, by);
  box.upperBound += b2Vec2(by, by);
  return box;
}

}  // namespace sim
