// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "physics/shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

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
    const double s = static_cast<double>(xf.q.s);
    const double c = static_cast<double>(xf.q.c);
    const double x = static_cast<double>(xf.p.x);
    const double y = static_cast<double>(xf.p.y);
    const auto add = [&](const b2Vec2& v) {
      const Vec2 p(static_cast<double>(v.x), static_cast<double>(v.y));
      points[count++] = {c * p.x() - s * p.y() + x, s * p.x() + c * p.y() + y};
    };
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

  // The corner that is farthest in a direction: that of a convex shape is found uphill from any
  // other.
  [[nodiscard]] std::size_t farthest(const Vec2& way, std::size_t from) const {
    double most = way.dot(points[from]);
    const auto climb = [&](auto neighbour) {
      const std::size_t start = from;
      for (std::size_t i = neighbour(from);; i = neighbour(i)) {
        const double along = way.dot(points[i]);
        if (!(along > most)) return from != start;
        most = along;
        from = i;
      }
    };
    if (!climb([&](std::size_t i) { return i + 1 < count ? i + 1 : 0; })) {
      climb([&](std::size_t i) { return i > 0 ? i - 1 : count - 1; });
    }
    return from;
  }
};

// A corner of the Minkowski difference of two cores, which are all vectors from a point of the
// first to a point of the second.
struct Difference {
  std::size_t a;  // corner of the first core
  std::size_t b;  // of the second
  Vec2 way;       // from the one to the other
};

// A corner or a side of the difference, and its vector that is nearest to zero.
struct Feature {
  Difference first;
  Difference second;
  double share;  // of the second end in the nearest vector; 0: this is a corner
  Vec2 nearest;
};

Feature side(const Difference& first, const Difference& second) {
  const Vec2 along = second.way - first.way;
  const double share = -first.way.dot(along);
  const double square = along.squaredNorm();
  if (share <= 0.0) return {first, first, 0.0, first.way};
  if (share >= square) return {second, second, 0.0, second.way};
  return {first, second, share / square, first.way + (share / square) * along};
}

double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

// Whether zero is within the triangle of three vectors.
bool encloses_zero(const Vec2& a, const Vec2& b, const Vec2& c) {
  const double ab = cross(a, b);
  const double bc = cross(b, c);
  const double ca = cross(c, a);
  return (ab >= 0.0 && bc >= 0.0 && ca >= 0.0) || (ab <= 0.0 && bc <= 0.0 && ca <= 0.0);
}

// Finds the vector of the difference of two cores that is nearest to zero, by the method of
// Gilbert, Johnson and Keerthi (IEEE J. Robotics and Automation 4(2), 1988); none if the cores
// overlap.
std::optional<Feature> nearest_feature(const Core& a, const Core& b) {
  constexpr double kRounding = 1e-12;
  constexpr int kMostSteps = 4 * b2_maxPolygonVertices;  // rounding lets no loop go on for ever
  const Difference start{0, 0, b.points[0] - a.points[0]};
  Feature found{start, start, 0.0, start.way};
  for (int step = 0; step < kMostSteps; ++step) {
    const Vec2 v = found.nearest;
    const double square = v.squaredNorm();
    if (square < kRounding * kRounding) return std::nullopt;
    const std::size_t on_a = a.farthest(v, found.second.a);
    const std::size_t on_b = b.farthest(-v, found.second.b);
    const Difference next{on_a, on_b, b.points[on_b] - a.points[on_a]};
    if (v.dot(v - next.way) <= kRounding * square) return found;
    if (found.share == 0.0) {
      found = side(found.first, next);
      continue;
    }
    if (encloses_zero(found.first.way, found.second.way, next.way)) return std::nullopt;
    const Feature one = side(found.first, next);
    const Feature other = side(found.second, next);
    found = one.nearest.squaredNorm() < other.nearest.squaredNorm() ? one : other;
  }
  return found;
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

// b2Distance() takes such steps, too, but the last bits of its results depend on how Box2D was
// compiled.
ShapeDistance core_distance(const b2Shape& a, const b2Transform& xf_a, const b2Shape& b,
                            const b2Transform& xf_b) {
  const Core first(a, xf_a);
  const Core second(b, xf_b);
  const std::optional<Feature> found = nearest_feature(first, second);
  if (!found) return {{0.0F, 0.0F}, {0.0F, 0.0F}, 0.0F};
  const Vec2& corner = first.points[found->first.a];
  const Vec2 on_a = corner + found->share * (first.points[found->second.a] - corner);
  return {in_float(on_a), in_float(on_a + found->nearest),
          static_cast<float>(found->nearest.norm())};
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
