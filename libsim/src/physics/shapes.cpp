// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "physics/shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "sim/core/assert.h"

namespace sim {
namespace {

// Moves a nearest point from the centre of a circle to its outline.
void shorten(ShapeDistance& found, float radius, b2Vec2& center, const b2Vec2& other) {
  if (found.distance <= radius) {
    center = other;
    found.distance = 0.0F;
    return;
  }
  center -= (radius / found.distance) * (center - other);
  found.distance -= radius;
}

// The corners of a shape without its skin, in W; the centre of a circle.
struct Core {
  std::array<Vec2, b2_maxPolygonVertices> points;
  std::size_t count = 0;

  Core(const b2Shape& shape, const b2Transform& xf) {
    const auto add = [&](const b2Vec2& v) {
      const Vec2 p(static_cast<double>(v.x), static_cast<double>(v.y));
      points[count++] = {c_ * p.x() - s_ * p.y() + x_, s_ * p.x() + c_ * p.y() + y_};
    };
    s_ = static_cast<double>(xf.q.s);
    c_ = static_cast<double>(xf.q.c);
    x_ = static_cast<double>(xf.p.x);
    y_ = static_cast<double>(xf.p.y);
    if (shape.GetType() == b2Shape::e_polygon) {
      const auto& polygon = static_cast<const b2PolygonShape&>(shape);
      for (int32 i = 0; i < polygon.m_count; ++i) add(polygon.m_vertices[i]);
    } else if (shape.GetType() == b2Shape::e_circle) {
      add(static_cast<const b2CircleShape&>(shape).m_p);
    } else {
      const auto& edge = static_cast<const b2EdgeShape&>(shape);
      add(edge.m_vertex1);
      add(edge.m_vertex2);
    }
  }

  // The least way . v of its corners.
  [[nodiscard]] double least_along(const Vec2& way) const {
    double least = way.dot(points[0]);
    for (std::size_t i = 1; i < count; ++i) least = std::min(least, way.dot(points[i]));
    return least;
  }

 private:
  double s_, c_, x_, y_;
};

// The nearest points of two cores so far.
struct Nearest {
  Vec2 on_sides = Vec2::Zero();
  Vec2 corner = Vec2::Zero();
  double square = std::numeric_limits<double>::infinity();
};

// Takes the corners of one core and the sides of the other into account. The point of a polygon
// that is nearest to a point outside is on a side that faces it.
void compare(const Core& corners, const Core& with_sides, Nearest& nearest) {
  const bool is_polygon = with_sides.count > 2;
  const std::size_t sides = is_polygon ? with_sides.count : with_sides.count - 1;
  for (std::size_t i = 0; i < sides; ++i) {
    const Vec2& a = with_sides.points[i];
    const Vec2 side = with_sides.points[i + 1 < with_sides.count ? i + 1 : 0] - a;
    const double per_square = 1.0 / side.squaredNorm();
    for (std::size_t k = 0; k < corners.count; ++k) {
      const Vec2& p = corners.points[k];
      const Vec2 from_a = p - a;
      if (is_polygon && side.x() * from_a.y() > side.y() * from_a.x())
        continue;  // counter-clockwise
      const double share = std::clamp(side.dot(from_a) * per_square, 0.0, 1.0);
      const Vec2 on_side = a + share * side;
      const double square = (p - on_side).squaredNorm();
      if (square < nearest.square) nearest = {on_side, p, square};
    }
  }
}

b2Vec2 in_float(const Vec2& p) { return {static_cast<float>(p.x()), static_cast<float>(p.y())}; }

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

// Each pair of a corner and a side is compared. b2Distance() takes fewer steps, but the last bits
// of its results depend on how Box2D was compiled.
ShapeDistance core_distance(const b2Shape& a, const b2Transform& xf_a, const b2Shape& b,
                            const b2Transform& xf_b) {
  const Core first(a, xf_a);
  const Core second(b, xf_b);
  Nearest of_second;
  compare(first, second, of_second);
  Nearest of_first;
  compare(second, first, of_first);
  Vec2 on_a = of_second.corner;
  Vec2 on_b = of_second.on_sides;
  if (of_first.square < of_second.square) {
    on_a = of_first.on_sides;
    on_b = of_first.corner;
  }
  if (first.count == 1 && second.count == 1) {
    on_a = first.points[0];
    on_b = second.points[0];
  }
  const Vec2 way = on_b - on_a;
  // The line between the nearest points of two convex shapes separates them, if they are apart.
  const bool apart = second.least_along(way) + first.least_along(-way) > 0.5 * way.squaredNorm();
  const float distance = apart ? static_cast<float>(way.norm()) : 0.0F;
  return {in_float(on_a), in_float(on_b), distance};
}

ShapeDistance distance_between(const b2Shape& a, const b2Transform& xf_a, const b2Shape& b,
                               const b2Transform& xf_b) {
  ShapeDistance found = core_distance(a, xf_a, b, xf_b);
  if (b.GetType() == b2Shape::e_circle) {
    shorten(found, core_radius(b), found.pointB, found.pointA);
  }
  if (a.GetType() == b2Shape::e_circle) {
    shorten(found, core_radius(a), found.pointA, found.pointB);
  }
  return found;
}

bool overlap(const b2Shape& a, const b2Transform& xf_a, const b2Shape& b, const b2Transform& xf_b) {
  constexpr float kRounding = 1e-6F;
  return core_distance(a, xf_a, b, xf_b).distance - a.m_radius - b.m_radius < kRounding;
}

b2AABB expanded(b2AABB box, double by_m) {
  const float by = static_cast<float>(by_m) * kScaleF;
  box.lowerBound -= b2Vec2(by, by);
  box.upperBound += b2Vec2(by, by);
  return box;
}

}  // namespace sim
