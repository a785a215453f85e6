// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Monte Carlo localisation: its parts, against numbers derived by hand.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <vector>

#include "sim/core/random_stream.h"
#include "sim/core/state_archive.h"
#include "sim/navigation/distance_field.h"
#include "sim/navigation/likelihood_field.h"
#include "sim/navigation/monte_carlo.h"
#include "sim/navigation/odometry_motion.h"
#include "sim/navigation/particles.h"

namespace sim {
namespace {

constexpr double kPi = std::numbers::pi;

OccupancyMap empty_map(int width, int height, double cell_size_m) {
  OccupancyMap map{width, height, cell_size_m, Vec2::Zero(), {}};
  map.cells.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0.0F);
  return map;
}

float& cell(OccupancyMap& map, int column, int row) {
  return map.cells[static_cast<std::size_t>(row) * static_cast<std::size_t>(map.width) +
                   static_cast<std::size_t>(column)];
}

/// A room of 4 x 3 m without symmetry: walls of one cell, and a block in a corner.
OccupancyMap room() {
  OccupancyMap map = empty_map(80, 60, 0.05);
  for (int column = 0; column < map.width; ++column) {
    for (int row = 0; row < map.height; ++row) {
      const bool wall = column == 0 || row == 0 || column == map.width - 1 || row == map.height - 1;
      const bool block = column > 50 && row > 40;  // bottom right: x > 2.55 m, y < 0.95 m
      if (wall || block) cell(map, column, row) = 1.0F;
    }
  }
  return map;
}

/// Ranges in the room() by small steps along each beam; 72 beams round the robot.
ScanPoints scan_in(const OccupancyMap& map, const Pose& X_WB) {
  constexpr int kBeams = 72;
  std::vector<double> ranges;
  for (int i = 0; i < kBeams; ++i) {
    const double angle = X_WB.yaw_rad - kPi + i * 2.0 * kPi / kBeams;
    double range_m = 0.0;
    for (; range_m < 6.0; range_m += 0.005) {
      const double x = X_WB.x_m + range_m * std::cos(angle);
      const double y = X_WB.y_m + range_m * std::sin(angle);
      const int column = static_cast<int>(std::floor(x / map.cell_size_m));
      const int row = map.height - 1 - static_cast<int>(std::floor(y / map.cell_size_m));
      if (column < 0 || row < 0 || column >= map.width || row >= map.height) break;
      if (map.at(column, row) > 0.5F) break;
    }
    ranges.push_back(range_m);
  }
  return scan_points({}, ranges, -kPi, 2.0 * kPi / kBeams, 8.0, 60);
}

TEST(DistanceField, DistanceToNearestOccupiedCell) {
  OccupancyMap map = empty_map(9, 7, 0.5);
  cell(map, 2, 1) = 1.0F;
  cell(map, 7, 5) = 1.0F;
  const DistanceField field = distance_field(map, 100.0);
  for (int row = 0; row < map.height; ++row) {
    for (int column = 0; column < map.width; ++column) {
      const double expected =
          0.5 * std::min(std::hypot(column - 2, row - 1), std::hypot(column - 7, row - 5));
      EXPECT_NEAR(double{field.at(column, row)}, expected, 1e-6) << column << ", " << row;
    }
  }
}

TEST(DistanceField, Distance_LimitedEvenWithoutOccupiedCell) {
  OccupancyMap map = empty_map(5, 1, 1.0);
  for (const float distance : distance_field(map, 2.0).distances_m) EXPECT_EQ(distance, 2.0F);
  cell(map, 0, 0) = 1.0F;
  const DistanceField field = distance_field(map, 2.5);
  EXPECT_EQ(field.at(1, 0), 1.0F);
  EXPECT_EQ(field.at(4, 0), 2.5F);
}

TEST(ScanPoints, SpreadEvenlyWithoutMisses) {
  // Four beams, -90 to 90 degrees, from a laser 0.1 m in front of the middle. Of two used beams,
  // these are the second and the fourth; the fourth met nothing.
  const std::vector<double> ranges{1.0, 2.0, 3.0, 5.0};
  const ScanPoints scan = scan_points({0.1, 0.0, 0.0}, ranges, -0.5 * kPi, kPi / 3.0, 5.0, 2);
  ASSERT_EQ(scan.p_BQ.size(), 1U);
  EXPECT_NEAR(scan.p_BQ[0].x(), 0.1 + 2.0 * std::cos(-kPi / 6.0), 1e-12);
  EXPECT_NEAR(scan.p_BQ[0].y(), 2.0 * std::sin(-kPi / 6.0), 1e-12);
}

TEST(LikelihoodField, FollowsDistanceToSurface) {
  // A solid of 3 x 3 cells of 0.1 m; its middle cell is no surface.
  OccupancyMap map = empty_map(20, 20, 0.1);
  for (int column = 8; column <= 10; ++column) {
    for (int row = 8; row <= 10; ++row) cell(map, column, row) = 1.0F;
  }
  const LikelihoodField field(map, {0.1, 0.2});
  const auto at = [&](double column, double row) {
    // The scan has one point, at the robot itself.
    const ScanPoints scan{{Vec2::Zero()}};
    return field.mean_log_likelihood({(column + 0.5) * 0.1, (19 - row + 0.5) * 0.1, 0.3}, scan);
  };
  EXPECT_NEAR(at(8, 9), 0.0, 1e-6);  // on the surface: log 1
  // One and two cells away, one or two standard deviations: 0.8 exp(-d^2 / 2) + 0.2.
  EXPECT_NEAR(at(7, 9), std::log(0.8 * std::exp(-0.5) + 0.2), 1e-6);
  EXPECT_NEAR(at(6, 9), std::log(0.8 * std::exp(-2.0) + 0.2), 1e-6);
  EXPECT_NEAR(at(9, 9), std::log(0.8 * std::exp(-0.5) + 0.2), 1e-6);  // inside
  EXPECT_NEAR(at(0, 0), std::log(0.2), 1e-5);         // far away, but for exp(-5.3^2 / 2)
  EXPECT_NEAR(at(-3, 9), std::log(0.2), 1e-6);        // beyond the map
  EXPECT_EQ(field.mean_log_likelihood({}, {}), 0.0);  // no points
  EXPECT_EQ(field.free_cells(), 400U - 9U);
}

TEST(OdometryMotion, NoNoise_MeasuredMotion) {
  RandomStream random(1, "test");
  for (const Pose& motion : {Pose{0.3, 0.1, 0.2}, Pose{-0.2, 0.0, 0.0}, Pose{0.0, 0.0, 1.0}}) {
    const Pose drawn = OdometryMotion(motion, {0.0, 0.0, 0.0, 0.0}).sample(random);
    EXPECT_NEAR(drawn.x_m, motion.x_m, 1e-12);
    EXPECT_NEAR(drawn.y_m, motion.y_m, 1e-12);
    EXPECT_NEAR(drawn.yaw_rad, motion.yaw_rad, 1e-12);
  }
}

TEST(OdometryMotion, Noise_MatchesAlphas) {
  // 2 m straight on, or backwards: only the distance scatters, by sqrt(0.01 * 4) = 0.2 m.
  constexpr int kDraws = 20000;
  RandomStream random(1, "test");
  for (const double drive_m : {2.0, -2.0}) {
    const OdometryMotion motion({drive_m, 0.0, 0.0}, {0.5, 0.0, 0.01, 0.5});
    double sum = 0.0;
    double squares = 0.0;
    for (int i = 0; i < kDraws; ++i) {
      const Pose drawn = motion.sample(random);
      EXPECT_NEAR(drawn.y_m, 0.0, 1e-9);
      sum += drawn.x_m - drive_m;
      squares += (drawn.x_m - drive_m) * (drawn.x_m - drive_m);
    }
    // Four standard errors.
    EXPECT_NEAR(sum / kDraws, 0.0, 4.0 * 0.2 / std::sqrt(kDraws));
    EXPECT_NEAR(std::sqrt(squares / kDraws), 0.2, 4.0 * 0.2 / std::sqrt(2.0 * kDraws));
  }
}

TEST(KldSampleSize, MatchesEquation) {
  EXPECT_EQ(kld_sample_size(0, 0.05, 2.33), 1.0);
  EXPECT_EQ(kld_sample_size(1, 0.05, 2.33), 1.0);
  // k - 1 = 2: 2 / 0.1 * (1 - 1/9 + sqrt(1/9) * 3)^3 = 20 * (17/9)^3.
  EXPECT_NEAR(kld_sample_size(3, 0.05, 3.0), 20.0 * std::pow(17.0 / 9.0, 3.0), 1e-9);
}

TEST(PoseBins, Bins_CountedOnce) {
  PoseBins bins;
  EXPECT_TRUE(bins.add({0.1, 0.1, 0.0}));
  EXPECT_FALSE(bins.add({0.4, 0.4, 0.05}));
  EXPECT_TRUE(bins.add({-0.1, 0.1, 0.0}));
  EXPECT_TRUE(bins.add({0.1, 0.1, 0.2}));
  for (int i = 0; i < 1000; ++i) static_cast<void>(bins.add({0.5 * i + 10.1, 0.1, 0.0}));
  EXPECT_EQ(bins.count(), 1003U);
}

TEST(PoseHypotheses, ClustersWithMoments) {
  // Two groups; the heavier one lies across the yaw's seam.
  std::vector<Particle> particles{
      {{1.0, 1.0, kPi - 0.1}, 0.35}, {{1.2, 1.4, -kPi + 0.1}, 0.35}, {{5.0, 5.0, 0.0}, 0.3}};
  const auto found = pose_hypotheses(particles, 10);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_NEAR(found[0].weight, 0.7, 1e-12);
  EXPECT_NEAR(found[0].mean.x_m, 1.1, 1e-12);
  EXPECT_NEAR(found[0].mean.y_m, 1.2, 1e-12);
  EXPECT_NEAR(std::abs(found[0].mean.yaw_rad), kPi, 1e-9);
  EXPECT_NEAR(found[0].covariance.variance[0], 0.01, 1e-12);    // +- 0.1 m
  EXPECT_NEAR(found[0].covariance.variance[1], 0.04, 1e-12);    // +- 0.2 m
  EXPECT_NEAR(found[0].covariance.variance[2], 0.01, 1e-9);     // +- 0.1 rad
  EXPECT_NEAR(found[0].covariance.covariance[0], 0.02, 1e-12);  // x y
  EXPECT_NEAR(found[0].covariance.covariance[1], 0.02, 1e-9);   // y yaw
  EXPECT_NEAR(found[0].covariance.covariance[2], 0.01, 1e-9);   // x yaw
  EXPECT_NEAR(found[1].mean.x_m, 5.0, 1e-12);
  EXPECT_EQ(pose_hypotheses(particles, 1).size(), 1U);
  EXPECT_TRUE(pose_hypotheses({}, 10).empty());
}

TEST(PoseHypothesis, FollowsRobot) {
  PoseHypothesis hypothesis;
  hypothesis.mean = {1.0, 2.0, 0.5 * kPi};
  hypothesis.covariance.variance = {0.01, 0.02, 0.04};
  hypothesis.weight = 1.0;
  // 1 m ahead, which is along y: an error of the yaw moves x by its negative.
  const PoseHypothesis there = moved(hypothesis, {1.0, 0.0, 0.0});
  EXPECT_NEAR(there.mean.x_m, 1.0, 1e-12);
  EXPECT_NEAR(there.mean.y_m, 3.0, 1e-12);
  EXPECT_NEAR(there.covariance.variance[0], 0.01 + 0.04, 1e-12);
  EXPECT_NEAR(there.covariance.variance[1], 0.02, 1e-12);
  EXPECT_NEAR(there.covariance.covariance[2], -0.04, 1e-12);
}

TEST(PoseCovariance, SampledAndChecked) {
  const PoseCovariance covariance{{0.04, 0.09, 0.01}, {0.03, -0.01, 0.005}};
  ASSERT_TRUE(is_valid(covariance));
  EXPECT_TRUE(is_valid({}));
  EXPECT_FALSE(is_valid({{-0.1, 1.0, 1.0}, {}}));
  EXPECT_FALSE(is_valid({{1.0, 1.0, 1.0}, {1.1, 0.0, 0.0}}));
  EXPECT_FALSE(is_valid({{1.0, 1.0, 1.0}, {0.9, 0.9, -0.9}}));  // its determinant is negative
  EXPECT_FALSE(is_valid({{1.0, NAN, 1.0}, {}}));
  RandomStream random(1, "test");
  constexpr int kDraws = 40000;
  double xx = 0.0;
  double xy = 0.0;
  double ya = 0.0;
  for (int i = 0; i < kDraws; ++i) {
    const Pose pose = sample_pose({1.0, 2.0, 0.0}, covariance, random);
    xx += (pose.x_m - 1.0) * (pose.x_m - 1.0) / kDraws;
    xy += (pose.x_m - 1.0) * (pose.y_m - 2.0) / kDraws;
    ya += (pose.y_m - 2.0) * pose.yaw_rad / kDraws;
  }
  // Four standard errors: sqrt((aa bb + ab^2) / n).
  EXPECT_NEAR(xx, 0.04, 4.0 * 0.04 * std::sqrt(2.0 / kDraws));
  EXPECT_NEAR(xy, 0.03, 4.0 * std::sqrt((0.04 * 0.09 + 0.03 * 0.03) / kDraws));
  EXPECT_NEAR(ya, -0.01, 4.0 * std::sqrt((0.09 * 0.01 + 0.01 * 0.01) / kDraws));
}

TEST(PoseBins, AnyPose_HasBin) {
  PoseBins bins;
  EXPECT_TRUE(bins.add({1e308, 1e308, 0.0}));
  EXPECT_FALSE(bins.add({std::numeric_limits<double>::infinity(), 1e300, 0.0}));
  EXPECT_TRUE(bins.add({-1e308, 0.0, 0.0}));
  EXPECT_FALSE(bins.add({NAN, 0.0, 0.0})) << "the least bin";
}

TEST(ResampleLowVariance, Shares_KeptWithinOneParticle) {
  const std::vector<Particle> particles{
      {{1.0, 0.0, 0.0}, 0.55}, {{2.0, 0.0, 0.0}, 0.0}, {{3.0, 0.0, 0.0}, 0.45}};
  RandomStream random(1, "test");
  for (int run = 0; run < 50; ++run) {
    std::vector<Particle> drawn;
    resample_low_variance(particles, 10, random, drawn);
    ASSERT_EQ(drawn.size(), 10U);
    const auto first = std::count_if(drawn.begin(), drawn.end(),
                                     [](const Particle& p) { return p.pose.x_m == 1.0; });
    EXPECT_TRUE(first == 5 || first == 6) << first;
    EXPECT_EQ(drawn[0].weight, 0.1);
    EXPECT_TRUE(std::none_of(drawn.begin(), drawn.end(),
                             [](const Particle& p) { return p.pose.x_m == 2.0; }));
  }
}

MonteCarloSettings settings_of_room() {
  MonteCarloSettings settings;
  settings.max_samples = 3000;
  settings.independent_beams = 20.0;
  return settings;
}

MonteCarloLocalizer localizer_in(const OccupancyMap& map, std::uint64_t seed = 1) {
  return {settings_of_room(),
          std::make_shared<const LikelihoodField>(map, LikelihoodSettings{}),
          {seed, "test"}};
}

/// Drives a circle in the room, with scans from the true pose.
void drive(MonteCarloLocalizer& localizer, const OccupancyMap& map, Pose& X_WB, int steps) {
  const Pose motion{0.2, 0.0, 0.3};
  for (int i = 0; i < steps; ++i) {
    X_WB = X_WB * motion;
    localizer.move(motion);
    ASSERT_TRUE(localizer.wants_scan());
    localizer.update(scan_in(map, X_WB));
  }
}

double error_m(const MonteCarloLocalizer& localizer, const Pose& X_WB) {
  const PoseHypothesis best = localizer.hypotheses().front();
  return (best.mean.position() - X_WB.position()).norm();
}

TEST(MonteCarloLocalizer, UnknownAndKidnappedRobot_Found) {
  const OccupancyMap map = room();
  MonteCarloLocalizer localizer = localizer_in(map);
  EXPECT_FALSE(localizer.wants_scan());  // no particles yet
  localizer.spread();
  EXPECT_EQ(localizer.size(), 3000U);
  Pose X_WB{1.5, 1.0, 0.0};
  localizer.update(scan_in(map, X_WB));
  drive(localizer, map, X_WB, 10);
  EXPECT_LT(error_m(localizer, X_WB), 0.05);
  EXPECT_GT(localizer.hypotheses().front().weight, 0.9);
  EXPECT_LT(localizer.size(), 3000U);  // KLD-sampling

  X_WB = {2.2, 1.4, 2.0};
  drive(localizer, map, X_WB, 1);
  EXPECT_GT(localizer.reset_share(), 0.0);
  drive(localizer, map, X_WB, 25);
  EXPECT_LT(error_m(localizer, X_WB), 0.05);
}

TEST(MonteCarloLocalizer, GivenPose_TrackedByOdometryBetweenScans) {
  const OccupancyMap map = room();
  MonteCarloLocalizer localizer = localizer_in(map);
  Pose X_WB{1.5, 1.0, 0.0};
  localizer.set_pose({1.55, 0.95, 0.1}, {{0.01, 0.01, 0.01}, {}});
  EXPECT_NEAR(localizer.hypotheses().front().mean.x_m, 1.55, 0.02);
  localizer.update(scan_in(map, X_WB));
  drive(localizer, map, X_WB, 5);
  EXPECT_LT(error_m(localizer, X_WB), 0.05);
  const Pose before = localizer.hypotheses().front().mean;
  const Pose particle = localizer.particles().front().pose;
  localizer.move({0.1, 0.0, 0.0});
  EXPECT_FALSE(localizer.wants_scan());
  EXPECT_NEAR((localizer.hypotheses().front().mean.position() - before.position()).norm(), 0.1,
              1e-12);
  EXPECT_NEAR((localizer.particles().front().pose.position() - particle.position()).norm(), 0.1,
              1e-12);
}

TEST(MonteCarloLocalizer, OdometrySteps_Accumulated) {
  MonteCarloLocalizer localizer = localizer_in(room());
  localizer.set_pose({1.5, 1.0, 0.0}, {});
  // Ahead and to the left, then ahead in the new direction.
  localizer.move({0.2, 0.0, 0.5 * std::numbers::pi});
  localizer.move({0.1, 0.0, 0.0});
  const Pose mean = localizer.hypotheses().front().mean;
  EXPECT_NEAR(mean.x_m, 1.7, 1e-9);
  EXPECT_NEAR(mean.y_m, 1.1, 1e-9);
  EXPECT_NEAR(mean.yaw_rad, 0.5 * std::numbers::pi, 1e-9);
}

TEST(MonteCarloLocalizer, RepeatableAndRestorable) {
  const OccupancyMap map = room();
  const auto run = [&](bool with_restore) {
    MonteCarloLocalizer localizer = localizer_in(map, 7);
    localizer.spread();
    Pose X_WB{1.5, 1.0, 0.0};
    drive(localizer, map, X_WB, 4);
    if (with_restore) {
      StateArchive out;
      localizer.archive(out);
      const std::vector<std::uint8_t> bytes = out.take();
      localizer = localizer_in(map, 99);
      StateArchive in{std::span<const std::uint8_t>(bytes)};
      localizer.archive(in);
      EXPECT_EQ(in.left(), 0U);
    }
    drive(localizer, map, X_WB, 4);
    return localizer.hypotheses().front();
  };
  const PoseHypothesis first = run(false);
  for (const bool with_restore : {false, true}) {
    const PoseHypothesis again = run(with_restore);
    EXPECT_EQ(again.mean, first.mean);
    EXPECT_EQ(again.covariance.variance, first.covariance.variance);
    EXPECT_EQ(again.weight, first.weight);
  }
}

TEST(MonteCarloLocalizer, EmptyScans_KeepWeights) {
  MonteCarloLocalizer localizer = localizer_in(room());
  localizer.set_pose({1.0, 1.0, 0.0}, {});
  localizer.update({});
  EXPECT_EQ(localizer.updates(), 1U);
  ASSERT_EQ(localizer.hypotheses().size(), 1U);
  EXPECT_NEAR(localizer.hypotheses()[0].mean.x_m, 1.0, 1e-12);
}

}  // namespace
}  // namespace sim
