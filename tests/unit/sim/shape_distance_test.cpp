// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// The distance of two convex shapes, beside the least one of all their corners and sides.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include "outlines.h"
#include "physics/shapes.h"
#include "random_numbers.h"
#include "sim/world/outline.h"

namespace sim {
namespace {

struct Part {
  std::unique_ptr<b2Shape> shape;
  b2Transform xf;
  Polygon corners;  // as Box2D rounds them, in W
};

Part part_of(std::unique_ptr<b2Shape> shape, const std::vector<b2Vec2>& corners,
             test::Random& random) {
  Part part{std::move(shape), {}, {}};
  part.xf.Set(
      {static_cast<float>(random.uniform(-3, 3)), static_cast<float>(random.uniform(-3, 3))},
      static_cast<float>(random.uniform(-3, 3)));
  const auto in_double = [](float x) { return static_cast<double>(x); };
  const double s = in_double(part.xf.q.s);
  const double c = in_double(part.xf.q.c);
  for (const b2Vec2& v : corners) {
    part.corners.emplace_back(in_double(part.xf.p.x) + c * in_double(v.x) - s * in_double(v.y),
                              in_double(part.xf.p.y) + s * in_double(v.x) + c * in_double(v.y));
  }
  return part;
}

// A polygon of 3 to 8 corners, an edge, or a circle.
Part random_part(test::Random& random) {
  const int kind = static_cast<int>(random.uniform(0, 4));
  const double size_m = std::pow(10.0, random.uniform(-1.5, 0.0));
  if (kind == 0) {
    auto circle = std::make_unique<b2CircleShape>(circle_shape({0.1, -0.05}, size_m));
    const b2Vec2 center = circle->m_p;
    return part_of(std::move(circle), {center}, random);
  }
  if (kind == 1) {
    auto edge = std::make_unique<b2EdgeShape>();
    edge->SetTwoSided({-0.3F, static_cast<float>(size_m)}, {static_cast<float>(3 * size_m), 0.1F});
    const std::vector<b2Vec2> ends{edge->m_vertex1, edge->m_vertex2};
    return part_of(std::move(edge), ends, random);
  }
  const int count = static_cast<int>(random.uniform(3, 9));
  std::vector<Vec2> corners;
  for (int i = 0; i < count; ++i) {
    const double angle_rad = 2.0 * std::numbers::pi * (i + random.uniform(0, 0.5)) / count;
    corners.push_back(size_m * Vec2(std::cos(angle_rad), 0.6 * std::sin(angle_rad)));
  }
  auto polygon = std::make_unique<b2PolygonShape>(polygon_shape(corners));
  const std::vector<b2Vec2> vertices(polygon->m_vertices, polygon->m_vertices + polygon->m_count);
  return part_of(std::move(polygon), vertices, random);
}

double least_from_corners(const Polygon& corners, const Polygon& sides) {
  double least = test::distance_to_outline_m(corners[0], sides);
  for (const Vec2& p : corners) least = std::min(least, test::distance_to_outline_m(p, sides));
  return least;
}

double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

bool have_common_point(const Polygon& a, const Polygon& b) {
  if (a.size() > 2 && is_inside(a, b[0])) return true;
  if (b.size() > 2 && is_inside(b, a[0])) return true;
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t k = 0; k < b.size(); ++k) {
      const Vec2& p = a[i];
      const Vec2& q = b[k];
      const Vec2 pp = a[(i + 1) % a.size()] - p;
      const Vec2 qq = b[(k + 1) % b.size()] - q;
      if (cross(pp, q - p) * cross(pp, q + qq - p) < 0.0 &&
          cross(qq, p - q) * cross(qq, p + pp - q) < 0.0) {
        return true;
      }
    }
  }
  return false;
}

TEST(ShapeDistance, CoreDistance_LeastOfCornersAndSides) {
  test::Random random(8);
  int overlapping = 0;
  for (int i = 0; i < 20'000; ++i) {
    SCOPED_TRACE(i);
    const Part a = random_part(random);
    const Part b = random_part(random);
    const ShapeDistance found = core_distance(*a.shape, a.xf, *b.shape, b.xf);
    if (have_common_point(a.corners, b.corners)) {
      ++overlapping;
      ASSERT_EQ(found.distance, 0.0F);
      continue;
    }
    const double least = std::min(least_from_corners(a.corners, b.corners),
                                  least_from_corners(b.corners, a.corners));
    ASSERT_NEAR(static_cast<double>(found.distance), least, 1e-6 * (1.0 + least));
    ASSERT_NEAR(static_cast<double>((found.pointB - found.pointA).Length()), least, 2e-6);
    const Vec2 on_a(static_cast<double>(found.pointA.x), static_cast<double>(found.pointA.y));
    ASSERT_LT(test::distance_to_outline_m(on_a, a.corners), 2e-6);
  }
  EXPECT_GT(overlapping, 1000);
}

}  // namespace
}  // namespace sim
