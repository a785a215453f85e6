// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Outlines of obstacles, and ranges to circles against the formula for quadratic equations.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "circle_range.h"
#include "outlines.h"
#include "random_numbers.h"
#include "sim/scan/cone.h"
#include "sim/scan/scan_kernel.h"
#include "sim/world/outline.h"

namespace sim {
namespace {

using test::circle_range_m;
using test::kNotch;
using test::Random;

constexpr double kPi = std::numbers::pi;

TEST(Outline, NearestPointOfSegment_BesideItOrAtEnd) {
  const Vec2 a(1, 1);
  const Vec2 b(4, 5);  // 5 m from a; the normal is (-4, 3) / 5
  const Vec2 beside = a + 0.4 * (b - a) + Vec2(-1.6, 1.2);
  EXPECT_NEAR((nearest_on_segment(beside, a, b) - Vec2(2.2, 2.6)).norm(), 0.0, 1e-12);
  EXPECT_NEAR(nearest_share(beside, a, b), 0.4, 1e-12);
  EXPECT_NEAR(distance_to_segment_m(beside, a, b), 2.0, 1e-12);
  EXPECT_EQ(nearest_on_segment({0, 0}, a, b), a);
  EXPECT_EQ(nearest_on_segment({5, 8}, a, b), b);
  EXPECT_DOUBLE_EQ(distance_to_segment_m({7, 9}, a, b), 5.0);
  EXPECT_EQ(nearest_on_segment({3, 4}, a, a), a) << "both ends are equal";
  EXPECT_DOUBLE_EQ(distance_to_segment_m({4, 5}, a, a), 5.0);
}

TEST(Outline, Area_Signed) {
  EXPECT_DOUBLE_EQ(area_m2({{0, 0}, {2, 0}, {2, 1}}), 1.0);
  EXPECT_DOUBLE_EQ(area_m2({{2, 1}, {2, 0}, {0, 0}}), -1.0);
  EXPECT_NEAR(area_m2(kNotch), 1.4 * 1.2 - 1.0, 1e-12);
}

TEST(Outline, CrossingSides_Found) {
  EXPECT_EQ(crossing_sides(kNotch), std::nullopt);
  EXPECT_EQ(crossing_sides({{0, 0}, {1, 1}, {1, 0}, {0, 1}}), std::pair(0UL, 2UL)) << "a bow tie";
  EXPECT_TRUE(crossing_sides({{0, 0}, {2, 0}, {2, 2}, {1, 0}, {0, 2}})) << "a vertex on a side";
  EXPECT_TRUE(crossing_sides({{0, 0}, {2, 0}, {1, 0}, {1, 1}})) << "it folds back";
}

TEST(Outline, Triangles_CoverArea) {
  for (const Polygon& outline :
       {kNotch, Polygon{{0, 0}, {1, 0}, {2, 0}, {2, 2}, {1, 1}, {0, 2}},
        Polygon{{0, 0}, {0.5, 0}, {1, 0}, {1, 0.5}, {1, 1}, {0.5, 1}, {0, 1}, {0, 0.5}}}) {
    double sum_m2 = 0.0;
    for (const Polygon& triangle : triangles_of(outline)) {
      ASSERT_EQ(triangle.size(), 3U);
      EXPECT_GT(area_m2(triangle), 0.0);
      sum_m2 += area_m2(triangle);
    }
    EXPECT_NEAR(sum_m2, area_m2(outline), 1e-12);
  }
}

TEST(Outline, Notch_IsOutside) {
  EXPECT_TRUE(is_inside(kNotch, {0.1, 0.6}));
  EXPECT_FALSE(is_inside(kNotch, {0.7, 0.6})) << "within the notch";
  EXPECT_TRUE(is_inside(kNotch, {0.7, 0.1}));
  EXPECT_FALSE(is_inside(kNotch, {-0.1, 0.1}));
}

TEST(Outline, AnyOrder_MadeCounterClockwise) {
  ObstacleDescription o;
  make_polygon(o, {{0, 0}, {0, 1}, {2, 0}});
  EXPECT_GT(area_m2(o.outline), 0.0);
  EXPECT_EQ(o.size, Vec2(2, 1));
}

TEST(Outline, Circle_WithinTolerance) {
  ObstacleDescription o;
  o.center = {3, 4};
  make_circle(o, 0.5);
  const Polygon outline = outline_of(o, 1e-3);
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec2 middle = 0.5 * (outline[i] + outline[(i + 1) % outline.size()]);
    EXPECT_NEAR((outline[i] - o.center).norm(), 0.5, 1e-12);
    EXPECT_GE((middle - o.center).norm(), 0.5 - 1e-3);
  }
}

TEST(CircleScan, Ranges_MatchFormula) {
  Random random(1);
  for (const scan::ScanGeometry& geometry :
       {scan::ScanGeometry{682, 0.36 * kPi / 180.0, 5.0},
        scan::ScanGeometry{721, kPi / 360.0, 30.0}, scan::ScanGeometry{1, 0.0, 5.0},
        scan::ScanGeometry{7, 0.5, 60.0}}) {
    int met = 0;
    for (int i = 0; i < 200; ++i) {
      const double radius_m = std::pow(10.0, random.uniform(-3.0, 1.0));
      const double distance_m = radius_m + std::pow(10.0, random.uniform(-4.0, 1.4));
      const double bearing_rad = random.uniform(-kPi, kPi);
      const double yaw_rad = random.uniform(-4.0, 4.0);
      const Vec2 center = distance_m * Vec2(std::cos(bearing_rad), std::sin(bearing_rad));
      scan::EdgeBuffer edges;
      edges.add(scan::Circle{center.x(), center.y(), radius_m});
      scan::ScanKernel kernel(geometry);
      std::vector<double> ranges(static_cast<std::size_t>(geometry.beam_count));
      kernel.scan(edges, yaw_rad, ranges);
      for (int beam = 0; beam < geometry.beam_count; ++beam) {
        const double angle_rad = yaw_rad + geometry.angle_rad(beam);
        const double expected_m =
            circle_range_m({0, 0}, angle_rad, center, radius_m, geometry.range_max_m);
        // A beam that grazes the circle meets it or not by the last bit of its angle.
        const double aside_m =
            std::abs(std::cos(angle_rad) * center.y() - std::sin(angle_rad) * center.x());
        if (std::abs(aside_m - radius_m) < 1e-9) continue;
        if (expected_m < geometry.range_max_m) ++met;
        ASSERT_NEAR(ranges[static_cast<std::size_t>(beam)], expected_m, 1e-6)
            << "beam " << beam << " of " << geometry.beam_count << ", circle of " << radius_m
            << " m at " << distance_m << " m";
      }
    }
    EXPECT_GT(met, geometry.beam_count == 1 ? 5 : 300);
  }
}

TEST(CircleScan, InstructionSetsAndParts_SameRanges) {
  Random random(2);
  const scan::ScanGeometry geometry{682, 0.36 * kPi / 180.0, 5.0};
  const auto scan_with = [&](scan::InstructionSet set, const scan::EdgeBuffer& edges) {
    scan::ScanKernel kernel(geometry, set);
    std::vector<double> ranges(682);
    kernel.scan(edges, 0.3, ranges);
    return ranges;
  };
  for (int i = 0; i < 50; ++i) {
    scan::EdgeBuffer edges;
    scan::EdgeBuffer circles;
    scan::EdgeBuffer both;
    for (int k = 0; k < 20; ++k) {
      const double bearing_rad = random.uniform(-kPi, kPi);
      const double distance_m = random.uniform(0.5, 6.0);
      const Vec2 p = distance_m * Vec2(std::cos(bearing_rad), std::sin(bearing_rad));
      const scan::Circle circle{p.x(), p.y(), random.uniform(0.01, 0.45)};
      circles.add(circle);
      both.add(circle);
      const auto x = static_cast<float>(-p.y());
      const auto y = static_cast<float>(p.x());
      edges.add(x + 0.1F, y, x, y + 0.2F);
      both.add(x + 0.1F, y, x, y + 0.2F);
    }
    const std::vector<double> ranges = scan_with(scan::InstructionSet::kScalar, both);
    for (const auto set : {scan::InstructionSet::kSse2, scan::InstructionSet::kAvx2}) {
      if (!scan::ScanKernel::available(set)) continue;
      EXPECT_EQ(scan_with(set, both), ranges);
    }
    scan::ScanKernel kernel(geometry);
    std::vector<double> in_parts(682);
    kernel.begin(0.3);
    kernel.add(circles);
    kernel.add(edges);
    kernel.finish(in_parts);
    EXPECT_EQ(in_parts, ranges);
  }
}

TEST(CircleScan, InsideSolid_ReadsZero) {
  scan::EdgeBuffer edges;
  edges.add(scan::Circle{0.1, 0.0, 0.5});
  edges.inside = true;
  scan::ScanKernel kernel({5, 0.1, 5.0});
  std::vector<double> ranges(5);
  kernel.scan(edges, 0.0, ranges);
  EXPECT_THAT(ranges, testing::Each(0.0));
}

TEST(CircleCone, LeastRange_MatchesThousandRays) {
  Random random(3);
  for (int i = 0; i < 500; ++i) {
    const scan::Cone cone{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-4, 4),
                          random.uniform(0.0, kPi)};
    const double radius_m = random.uniform(0.01, 1.0);
    const double bearing_rad = random.uniform(-kPi, kPi);
    const double distance_m = radius_m + random.uniform(0.01, 4.0);
    const Vec2 apex(cone.x_m, cone.y_m);
    const Vec2 center = apex + distance_m * Vec2(std::cos(bearing_rad), std::sin(bearing_rad));
    const std::vector<scan::Circle> circles{{center.x(), center.y(), radius_m}};
    double rays_m = 3.0;
    constexpr int kRays = 1000;
    for (int k = 0; k <= kRays; ++k) {
      const double angle_rad =
          cone.yaw_rad + cone.field_of_view_rad * (static_cast<double>(k) / kRays - 0.5);
      rays_m = std::min(rays_m, circle_range_m(apex, angle_rad, center, radius_m, 3.0));
    }
    const double least_m = scan::least_range_in_cone_m(circles, cone, 3.0);
    // The rays are at most 3.2 mrad apart. A side of the cone may graze the circle.
    EXPECT_LE(least_m, rays_m + 1e-9);
    if (least_m < 3.0 && rays_m < 3.0) {
      EXPECT_NEAR(least_m, rays_m, 0.05);
    }
    const double off_rad = std::abs(normalize_angle(bearing_rad - cone.yaw_rad));
    if (off_rad <= 0.5 * cone.field_of_view_rad) {
      EXPECT_NEAR(least_m, std::min(3.0, distance_m - radius_m), 1e-12);
    }
  }
}

}  // namespace
}  // namespace sim
