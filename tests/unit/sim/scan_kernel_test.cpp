// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/scan/scan_kernel.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "allocation_count.h"
#include "random_numbers.h"
#include "reference_scan.h"

namespace sim::scan {
namespace {

using test::Random;

using playpen::test::allocation_count;
using playpen::test::reference_scan;
using playpen::test::ReferenceBeam;
using ::testing::Each;
using ::testing::Lt;
using ::testing::Not;

constexpr double kPi = std::numbers::pi;

/// The kernel's error bound: at most ten roundings of 6e-8.
constexpr double kRelativeError = 1e-6;

/// The laser of SyRoTek.
constexpr ScanGeometry kHokuyo{682, 0.39589 * kPi / 180.0, 5.0};

/// A full turn: beam 0 and the last beam both point straight back.
ScanGeometry whole_turn(int beam_count) {
  return {beam_count, 2.0 * kPi / static_cast<double>(beam_count - 1), 5.0};
}

std::vector<InstructionSet> instruction_sets() {
  std::vector<InstructionSet> sets;
  for (const InstructionSet set :
       {InstructionSet::kScalar, InstructionSet::kSse2, InstructionSet::kAvx2}) {
    if (ScanKernel::available(set)) sets.push_back(set);
  }
  return sets;
}

/// Also expects that a scan in single precision has the same ranges, rounded.
std::vector<double> scan(const ScanGeometry& geometry, const EdgeBuffer& edges, double yaw_rad,
                         InstructionSet set) {
  ScanKernel kernel(geometry, set);
  std::vector<double> ranges_m(static_cast<std::size_t>(geometry.beam_count), -1.0);
  kernel.scan(edges, yaw_rad, ranges_m);
  std::vector<float> single_m(ranges_m.size(), -1.0F);
  kernel.begin(yaw_rad);
  kernel.add(edges);
  kernel.finish(single_m);
  EXPECT_EQ(single_m, std::vector<float>(ranges_m.begin(), ranges_m.end()));
  return ranges_m;
}

/// Every implementation must give the same bits, so a test of the default one covers all.
std::vector<double> scan(const ScanGeometry& geometry, const EdgeBuffer& edges, double yaw_rad) {
  const std::vector<double> ranges_m = scan(geometry, edges, yaw_rad, InstructionSet::kScalar);
  for (const InstructionSet set : instruction_sets()) {
    EXPECT_EQ(scan(geometry, edges, yaw_rad, set), ranges_m)
        << "instruction set " << static_cast<int>(set);
  }
  return ranges_m;
}

/// Adds a closed outline; corners counter-clockwise around the solid.
void add_outline(EdgeBuffer& edges, const std::vector<std::array<float, 2>>& corners) {
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const auto& from = corners[i];
    const auto& to = corners[(i + 1) % corners.size()];
    edges.add(from[0], from[1], to[0], to[1]);
  }
}

/// Convex solids around the sensor; none contains it, some are beyond 5 m.
EdgeBuffer random_scene(Random& random, int solid_count) {
  EdgeBuffer edges;
  for (int i = 0; i < solid_count; ++i) {
    const double radius_m = random.uniform(0.02, 0.4);
    const double distance_m = radius_m + std::pow(random.uniform(0.0, 1.0), 2.0) * 6.0 + 1e-4;
    const double bearing_rad = random.uniform(-kPi, kPi);
    const int corner_count = static_cast<int>(random.uniform(3.0, 9.99));
    const double turn_rad = random.uniform(-kPi, kPi);
    std::vector<std::array<float, 2>> corners;
    for (int k = 0; k < corner_count; ++k) {
      const double angle_rad = turn_rad + 2.0 * kPi * k / corner_count;
      corners.push_back(
          {static_cast<float>(distance_m * std::cos(bearing_rad) + radius_m * std::cos(angle_rad)),
           static_cast<float>(distance_m * std::sin(bearing_rad) +
                              radius_m * std::sin(angle_rad))});
    }
    add_outline(edges, corners);
  }
  return edges;
}

/// Compares every beam with the reference, except beams that point at a corner: there, one bit of
/// rounding decides which of two answers is right. 1e-9 rad is far less than the allowed 1e-5 rad.
/// Returns the number of beams that hit something.
int expect_like_reference(const ScanGeometry& geometry, const EdgeBuffer& edges, double yaw_rad) {
  const std::vector<double> ranges_m = scan(geometry, edges, yaw_rad);
  const std::vector<ReferenceBeam> reference = reference_scan(edges.edges(), geometry, yaw_rad);
  int met_count = 0;
  for (std::size_t i = 0; i < ranges_m.size(); ++i) {
    const double expected_m = reference[i].range_m;
    if (reference[i].corner_off_rad < 1e-9) continue;
    if (expected_m < geometry.range_max_m) ++met_count;
    EXPECT_NEAR(ranges_m[i], expected_m, kRelativeError * expected_m)
        << "beam " << i << ", yaw " << yaw_rad << ", nearest corner off by "
        << reference[i].corner_off_rad << " rad";
  }
  return met_count;
}

TEST(ScanKernelTest, WallAhead_DistanceOverCosine) {
  EdgeBuffer edges;
  edges.add(1.0F, 10.0F, 1.0F, -10.0F);  // directed downwards: its left, the solid, is x > 1
  const std::vector<double> ranges_m = scan(kHokuyo, edges, 0.0);
  for (int i = 0; i < kHokuyo.beam_count; ++i) {
    const double cosine = std::cos(kHokuyo.angle_rad(i));
    const double expected_m = cosine > 0.2 ? 1.0 / cosine : 5.0;  // 1 / 0.2 = 5 = range_max
    EXPECT_NEAR(ranges_m[static_cast<std::size_t>(i)], expected_m, kRelativeError * expected_m)
        << i;
  }
}

TEST(ScanKernelTest, BeamZero_RightmostAndTurnsWithSensor) {
  const ScanGeometry geometry{3, 0.5 * kPi, 5.0};  // right, ahead, left
  EdgeBuffer edges;
  edges.add(1.0F, 1.0F, 1.0F, -1.0F);  // a wall in the east, 1 m away
  edges.add(-1.0F, 2.0F, 1.0F, 2.0F);  // 2 m to the north: its left is y > 2
  const double tolerance_m = 2.0 * kRelativeError;
  const std::vector<double> east = scan(geometry, edges, 0.0);
  EXPECT_EQ(east[0], 5.0);
  EXPECT_NEAR(east[1], 1.0, tolerance_m);
  EXPECT_NEAR(east[2], 2.0, tolerance_m);
  const std::vector<double> north = scan(geometry, edges, 0.5 * kPi);
  EXPECT_NEAR(north[0], 1.0, tolerance_m);
  EXPECT_NEAR(north[1], 2.0, tolerance_m);
  EXPECT_EQ(north[2], 5.0);
}

TEST(ScanKernelTest, SeveralEdges_NearestCounts) {
  const ScanGeometry geometry{1, 0.1, 5.0};
  EdgeBuffer edges;
  for (const float x : {3.0F, 2.0F, 4.0F}) edges.add(x, 1.0F, x, -1.0F);
  EXPECT_NEAR(scan(geometry, edges, 0.0)[0], 2.0, 2.0 * kRelativeError);
}

TEST(ScanKernelTest, BackEdgeOnAndEmptyEdges_Ignored) {
  EdgeBuffer edges;
  edges.add(1.0F, -1.0F, 1.0F, 1.0F);   // the solid is on the sensor's side
  edges.add(1.0F, 0.0F, 2.0F, 0.0F);    // in line with the sensor
  edges.add(-1.0F, 0.0F, 1.0F, 0.0F);   // through the sensor
  edges.add(1.0F, 0.25F, 1.0F, 0.25F);  // zero length
  edges.add(0.0F, 0.0F, 0.0F, 0.0F);    // zero length, at the sensor
  edges.add(0.0F, 0.0F, 1.0F, -1.0F);   // begins at the sensor
  EXPECT_THAT(scan(whole_turn(721), edges, 0.0), Each(5.0));
  EXPECT_THAT(scan(whole_turn(720), edges, 0.3), Each(5.0));
}

TEST(ScanKernelTest, NothingInRange_ReadsRangeMaxExactly) {
  const ScanGeometry geometry{682, 0.005, 4.095};
  EdgeBuffer edges;
  EXPECT_THAT(scan(geometry, edges, 1.0), Each(4.095));
  edges.add(4.1F, 1.0F, 4.1F, -1.0F);
  EXPECT_THAT(scan(geometry, edges, 0.0), Each(4.095));
}

TEST(ScanKernelTest, InsideSolid_ReadsZeroEverywhere) {
  EdgeBuffer edges;
  edges.add(1.0F, 1.0F, 1.0F, -1.0F);
  edges.inside = true;
  EXPECT_THAT(scan(kHokuyo, edges, 0.0), Each(0.0));
  edges.clear();
  EXPECT_THAT(scan(kHokuyo, edges, 0.0), Each(5.0));
}

TEST(ScanKernelTest, WholeTurn_EdgeBehindSeenAtBothEnds) {
  EdgeBuffer edges;
  edges.add(-1.0F, -1.0F, -1.0F, 1.0F);           // directed upwards: its left is x < -1
  const ScanGeometry geometry = whole_turn(361);  // beams 1 degree apart
  const std::vector<double> ranges_m = scan(geometry, edges, 0.0);
  for (int i = 0; i <= 360; ++i) {
    const int off_deg = std::min(i, 360 - i);  // angle from straight back
    if (off_deg == 45) continue;               // at the ends of the edge
    const double expected_m = off_deg < 45 ? 1.0 / std::cos(off_deg * kPi / 180.0) : 5.0;
    EXPECT_NEAR(ranges_m[static_cast<std::size_t>(i)], expected_m, kRelativeError * expected_m);
  }
}

TEST(ScanKernelTest, SingleBeam_NeedsNoResolution) {
  EdgeBuffer edges;
  edges.add(1.5F, 0.01F, 1.5F, -0.01F);
  EXPECT_NEAR(scan({1, 0.0, 5.0}, edges, 0.0)[0], 1.5, 1.5 * kRelativeError);
  EXPECT_EQ(scan({1, 0.0, 5.0}, edges, 0.5)[0], 5.0);
}

TEST(ScanKernelTest, GrazedWall_Exact) {
  for (const float gap_m : {0.1F, 1e-3F, 1e-6F}) {
    for (const double yaw_rad : {0.0, 0.01, 1.0, 3.1}) {
      EdgeBuffer edges;
      edges.add(-9.0F, gap_m, 9.0F, gap_m);
      edges.add(2.0F, -gap_m, -3.0F, -gap_m);
      EXPECT_GT(expect_like_reference(kHokuyo, edges, yaw_rad), 300);
      EXPECT_GT(expect_like_reference(whole_turn(9), edges, yaw_rad), 5);
    }
  }
}

TEST(ScanKernelTest, BeamThroughCorner_MeetsEitherEdge) {
  const ScanGeometry geometry{9, 0.25, 5.0};  // beam 4 points ahead, with no rounding
  EdgeBuffer left;
  left.add(1.0F, 1.0F, 1.0F, 0.0F);
  EXPECT_NEAR(scan(geometry, left, 0.0)[4], 1.0, kRelativeError);
  EdgeBuffer right;
  right.add(1.0F, 0.0F, 1.0F, -1.0F);
  EXPECT_NEAR(scan(geometry, right, 0.0)[4], 1.0, kRelativeError);
}

TEST(ScanKernelTest, CornerBeyondSinglePrecision_SideExact) {
  // Corners 2 m away whose angle equals that of a beam except for the rounding to floats, about
  // 1e-7 rad: less than the error of an angle computed in floats. The edges are to the left or
  // right.
  Random random(5);
  int met_count = 0;
  for (int i = 0; i < 1000; ++i) {
    const double yaw_rad = random.uniform(-kPi, kPi);
    const double corner_rad = kHokuyo.angle_rad(static_cast<int>(random.uniform(0, 682))) + yaw_rad;
    // closer than the next beam
    const double other_rad = corner_rad + (i % 2 == 0 ? 0.004 : -0.004);
    const float x = static_cast<float>(2.0 * std::cos(corner_rad));
    const float y = static_cast<float>(2.0 * std::sin(corner_rad));
    const float other_x = static_cast<float>(2.0 * std::cos(other_rad));
    const float other_y = static_cast<float>(2.0 * std::sin(other_rad));
    EdgeBuffer edges;
    if (i % 2 == 0) {
      edges.add(other_x, other_y, x, y);
    } else {
      edges.add(x, y, other_x, other_y);
    }
    met_count += expect_like_reference(kHokuyo, edges, yaw_rad);
  }
  EXPECT_GT(met_count, 300);  // about half of the corners face the sensor
  EXPECT_LT(met_count, 700);
}

TEST(ScanKernelTest, SharedCorners_Opaque) {
  // Rings of short edges around the sensor, with the solid outside. Some corners are on beams:
  // exactly, or within the rounding of a float. No beam may pass through.
  Random random(20261121);
  for (const int beam_count : {4, 91, 361, 682, 4097}) {
    const ScanGeometry geometry = whole_turn(beam_count);
    for (int ring = 0; ring < 40; ++ring) {
      const double yaw_rad = ring % 2 == 0 ? 0.0 : random.uniform(-kPi, kPi);
      const int corner_count = 3 + static_cast<int>(random.uniform(0.0, 400.0));
      std::vector<double> angles_rad{0.0, 0.5 * kPi, kPi, -0.5 * kPi, 0.25 * kPi};
      for (int i = 0; i < corner_count; ++i) {
        const int beam = static_cast<int>(random.uniform(0.0, beam_count));
        angles_rad.push_back(random.uniform(-kPi, kPi));
        angles_rad.push_back(std::remainder(geometry.angle_rad(beam) + yaw_rad, 2.0 * kPi));
      }
      std::sort(angles_rad.begin(), angles_rad.end(),
                std::greater<>());  // clockwise: solid outside
      std::vector<std::array<float, 2>> corners;
      for (const double angle_rad : angles_rad) {
        // Close to a circle, so that every edge faces the sensor or has almost no length.
        corners.push_back({static_cast<float>(2.0 * std::cos(angle_rad)),
                           static_cast<float>(2.0 * std::sin(angle_rad))});
      }
      EdgeBuffer edges;
      add_outline(edges, corners);
      ASSERT_THAT(scan(geometry, edges, yaw_rad), Each(Lt(2.0 + 1e-5)))
          << beam_count << " beams, ring " << ring;
    }
  }
}

struct NamedGeometry {
  std::string name;
  ScanGeometry geometry;
};

class ScanKernelGeometryTest : public ::testing::TestWithParam<NamedGeometry> {};

TEST_P(ScanKernelGeometryTest, RandomScenes_MatchReference) {
  const ScanGeometry& geometry = GetParam().geometry;
  const int scenes = std::clamp(40000 / geometry.beam_count, 4, 400);
  Random random(7);
  int met_count = 0;
  for (int i = 0; i < scenes; ++i) {
    const EdgeBuffer edges = random_scene(random, 1 + i * 11 % 45);
    met_count += expect_like_reference(geometry, edges, random.uniform(-kPi, kPi));
  }
  EXPECT_GT(met_count, scenes * geometry.beam_count / 10);
}

INSTANTIATE_TEST_SUITE_P(
    All, ScanKernelGeometryTest,
    ::testing::Values(NamedGeometry{"Hokuyo", kHokuyo},
                      NamedGeometry{"WholeTurnOfOddCount", whole_turn(361)},
                      NamedGeometry{"WholeTurnOfEvenCount", whole_turn(720)},
                      NamedGeometry{"AlmostAWholeTurn", {360, 2.0 * kPi / 360.0, 5.0}},
                      NamedGeometry{"OneBeam", {1, 0.0, 5.0}}, NamedGeometry{"Two", {2, 1.0, 5.0}},
                      NamedGeometry{"FourAroundTheTurn", {4, 0.5 * kPi, 5.0}},
                      NamedGeometry{"Sonars", {7, 0.5, 2.0}},
                      NamedGeometry{"NarrowAndFine", {500, 1e-4, 5.0}},
                      NamedGeometry{"FinerThanSinglePrecision", {500, 1e-8, 5.0}},
                      NamedGeometry{"ManyBeams", {8192, 2.0 * kPi / 8191.0, 5.0}},
                      NamedGeometry{"ShortRange", {181, kPi / 180.0, 0.4}},
                      NamedGeometry{"LongRange", {541, 0.0087, 60.0}}),
    [](const auto& test) { return test.param.name; });

TEST(ScanKernelTest, Copies_GiveSameScan) {
  Random random(11);
  const EdgeBuffer edges = random_scene(random, 30);
  ScanKernel original(kHokuyo);
  ScanKernel copy = original;
  std::vector<double> first(682);
  std::vector<double> second(682);
  original.scan(edges, 0.7, first);
  copy.scan(edges, 0.7, second);
  EXPECT_EQ(first, second);
  EXPECT_THAT(first, Not(Each(5.0)));
}

TEST(ScanKernelTest, NonFiniteValues_Harmless) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinity = std::numeric_limits<float>::infinity();
  EdgeBuffer edges;
  for (const float bad : {nan, infinity, -infinity, 1e38F, -1e38F}) {
    edges.add(bad, 1.0F, 1.0F, -1.0F);
    edges.add(1.0F, bad, 1.0F, -1.0F);
    edges.add(1.0F, 1.0F, bad, bad);
  }
  for (const double range_m : scan(kHokuyo, edges, 0.4)) {
    EXPECT_GE(range_m, 0.0);
    EXPECT_LE(range_m, 5.0);
  }
}

/// A convex solid and the disc that contains it.
struct DiscedSolid {
  EdgeBuffer edges;
  std::array<float, 3> disc;
};

std::vector<DiscedSolid> random_solids(Random& random, int count) {
  std::vector<DiscedSolid> solids(static_cast<std::size_t>(count));
  for (DiscedSolid& solid : solids) {
    const double radius_m = random.uniform(0.05, 0.4);
    const double distance_m = radius_m + random.uniform(0.01, 6.0);
    const double bearing_rad = random.uniform(-kPi, kPi);
    const std::array<double, 2> x{distance_m * std::cos(bearing_rad),
                                  distance_m * std::sin(bearing_rad)};
    const int corner_count = static_cast<int>(random.uniform(3.0, 9.99));
    std::vector<std::array<float, 2>> corners;
    for (int k = 0; k < corner_count; ++k) {
      const double angle_rad = bearing_rad + 2.0 * kPi * k / corner_count;
      corners.push_back({static_cast<float>(x[0] + radius_m * std::cos(angle_rad)),
                         static_cast<float>(x[1] + radius_m * std::sin(angle_rad))});
    }
    add_outline(solid.edges, corners);
    solid.disc = {static_cast<float>(x[0]), static_cast<float>(x[1]), static_cast<float>(radius_m)};
  }
  return solids;
}

void add_all(EdgeBuffer& to, const EdgeBuffer& from) {
  for (const Edge& e : from.edges()) to.add(e.x0_m, e.y0_m, e.x1_m, e.y1_m);
}

TEST(ScanKernelTest, HiddenPartsLeftOut_SameBits) {
  Random random(5);
  std::size_t listed = 0;
  std::size_t all = 0;
  for (const ScanGeometry& geometry :
       {kHokuyo, whole_turn(720), ScanGeometry{181, kPi / 180.0, 8.0}, ScanGeometry{1, 0.0, 5.0},
        ScanGeometry{8, kPi / 4.0, 3.0}}) {
    for (int round = 0; round < 60; ++round) {
      const std::vector<DiscedSolid> solids = random_solids(random, 1 + 3 * round);
      EdgeBuffer whole;
      for (const DiscedSolid& solid : solids) add_all(whole, solid.edges);
      const double yaw_rad = random.uniform(-kPi, kPi);
      // The sensor's position in W does not matter, except for rounding to single precision.
      const float at_x = static_cast<float>(random.uniform(-50.0, 50.0));
      const float at_y = static_cast<float>(random.uniform(-50.0, 50.0));
      DiscBuffer discs;
      discs.add(at_x, at_y, 0.3F);  // of the sensor's own robot
      for (const DiscedSolid& solid : solids) {
        discs.add(at_x + solid.disc[0], at_y + solid.disc[1], solid.disc[2]);
      }
      if (round % 3 != 0) discs.group();
      const std::vector<double> expected = scan(geometry, whole, yaw_rad);
      for (const InstructionSet set : instruction_sets()) {
        ScanKernel kernel(geometry, set);
        kernel.begin(yaw_rad);
        kernel.locate(discs, at_x, at_y);
        const auto near = kernel.near();
        EXPECT_TRUE(std::find(near.begin(), near.end(), 0) != near.end())
            << "what the sensor is within is always listed";
        const auto add = [&](std::span<const std::int32_t> some) {
          EdgeBuffer edges;
          for (const std::int32_t disc : some) {
            if (disc == 0) continue;
            add_all(edges, solids[static_cast<std::size_t>(disc - 1)].edges);
            if (set == InstructionSet::kScalar) ++listed;
          }
          kernel.add(edges);
        };
        add(near);
        add(kernel.visible());
        std::vector<double> ranges_m(static_cast<std::size_t>(geometry.beam_count));
        kernel.finish(ranges_m);
        EXPECT_EQ(ranges_m, expected) << "instruction set " << static_cast<int>(set);
      }
      all += solids.size();
    }
  }
  EXPECT_LT(listed, all / 2) << "much is out of view or hidden";
  EXPECT_GT(listed, all / 50);
}

TEST(ScanKernelTest, HiddenOrOutOfViewDiscs_NotListed) {
  // Rows of eight robots: within reach before a wall, behind the wall, beside it, behind the
  // sensor, far away.
  DiscBuffer discs;
  for (const auto& [x, y] :
       {std::pair{2.0F, 0.0F}, {5.0F, 0.0F}, {3.5F, 3.0F}, {-3.0F, 0.0F}, {40.0F, 0.0F}}) {
    for (int i = 0; i < 8; ++i) discs.add(x, y + 0.05F * static_cast<float>(i), 0.1F);
  }
  discs.group();
  EXPECT_EQ(discs.group_count(), 5U);
  EdgeBuffer wall;
  wall.add(3.0F, 2.0F, 3.0F, -2.0F);
  for (const InstructionSet set : instruction_sets()) {
    ScanKernel kernel({181, kPi / 180.0, 8.0}, set);
    kernel.begin(0.0);
    kernel.add(wall);
    kernel.locate(discs, 0.0F, 0.0F);
    std::vector<std::int32_t> listed(kernel.near().begin(), kernel.near().end());
    const auto visible = kernel.visible();
    listed.insert(listed.end(), visible.begin(), visible.end());
    std::sort(listed.begin(), listed.end());
    EXPECT_THAT(listed,
                testing::ElementsAre(0, 1, 2, 3, 4, 5, 6, 7, 16, 17, 18, 19, 20, 21, 22, 23));
  }
}

TEST(ScanKernelTest, NonFiniteDiscs_Listed) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  DiscBuffer discs;
  discs.add(nan, 0.0F, 0.1F);
  discs.add(0.0F, 0.0F, 0.1F);
  discs.add(1.0F, 0.0F, nan);
  discs.group();
  for (const InstructionSet set : instruction_sets()) {
    ScanKernel kernel(kHokuyo, set);
    kernel.begin(0.3);
    kernel.locate(discs, 0.0F, 0.0F);
    EXPECT_EQ(kernel.near().size(), 3U);
    EXPECT_EQ(kernel.visible().size(), 0U) << "they are listed already";
  }
}

TEST(ScanKernelTest, SteadyState_NoAllocation) {
  Random random(3);
  const EdgeBuffer scene = random_scene(random, 40);
  ScanKernel kernel(kHokuyo);
  EdgeBuffer edges;
  std::vector<double> ranges_m(682);
  const auto fill_and_scan = [&](double yaw_rad) {
    edges.clear();
    for (const Edge& edge : scene.edges()) {
      edges.add(edge.x0_m, edge.y0_m, edge.x1_m, edge.y1_m);
    }
    kernel.scan(edges, yaw_rad, ranges_m);
  };
  const std::size_t before_first = allocation_count();
  fill_and_scan(0.0);
  const std::size_t after_first = allocation_count();
  ASSERT_GT(after_first, before_first);  // shows that the counter counts
  for (int i = 1; i < 100; ++i) fill_and_scan(0.1 * i);
  EXPECT_EQ(allocation_count(), after_first);
}

TEST(EdgeBufferTest, BulkAppend_UnusedRoomReturned) {
  EdgeBuffer edges;
  edges.add(1.0F, 2.0F, 3.0F, 4.0F);
  Edge* const room = edges.append(1000);
  for (int i = 0; i < 1000; ++i) room[i] = {static_cast<float>(i), 0.0F, 0.0F, 0.0F};
  EXPECT_EQ(edges.size(), 1001U);
  edges.truncate(11);
  ASSERT_EQ(edges.edges().size(), 11U);
  EXPECT_EQ(edges.edges()[0].y1_m, 4.0F);
  EXPECT_EQ(edges.edges()[10].x0_m, 9.0F);
  edges.truncate(20);  // more than there are: no effect
  EXPECT_EQ(edges.size(), 11U);
  edges.inside = true;
  edges.clear();
  EXPECT_EQ(edges.size(), 0U);
  EXPECT_FALSE(edges.inside);
}

}  // namespace
}  // namespace sim::scan
