// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "par_common/path_follower.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "grids.h"
#include "par_common/planners.h"

namespace par {
namespace {

/// A unicycle that gets a command ten times a second and obeys at once.
struct Unicycle {
  Pose pose;
  double driven_m = 0.0;

  void drive(const Velocity& velocity) {
    constexpr int kSteps = 10;
    for (int i = 0; i < kSteps; ++i) {
      const double dt = 0.1 / kSteps;
      pose.yaw += 0.5 * velocity.turn_radps * dt;
      pose.x += velocity.forward_mps * std::cos(pose.yaw) * dt;
      pose.y += velocity.forward_mps * std::sin(pose.yaw) * dt;
      pose.yaw = normalize_angle(pose.yaw + 0.5 * velocity.turn_radps * dt);
      driven_m += std::fabs(velocity.forward_mps) * dt;
    }
  }
};

struct Drive {
  int updates = 0;
  double worst_m = 0.0;  // greatest distance from the path
  Unicycle robot;
};

double distance_to_way_m(const std::vector<Point>& way, const Pose& pose) {
  double least = 1e300;
  for (std::size_t i = 1; i < way.size(); ++i) {
    const Point& a = way[i - 1];
    const Point& b = way[i];
    const double length = distance_m(a, b);
    if (length == 0.0) continue;
    const double along = std::clamp(
        ((pose.x - a.x) * (b.x - a.x) + (pose.y - a.y) * (b.y - a.y)) / length, 0.0, length);
    least = std::min(least, distance_m({pose.x, pose.y}, {a.x + along / length * (b.x - a.x),
                                                          a.y + along / length * (b.y - a.y)}));
  }
  return least;
}

/// Follows a path to its end, for at most a minute.
Drive follow(PathFollower& follower, const std::vector<Point>& way, const Pose& start) {
  Drive drive;
  drive.robot.pose = start;
  follower.set_path(way);
  for (; drive.updates < 600 && !follower.done(); ++drive.updates) {
    const Velocity velocity = follower.update(drive.robot.pose);
    const FollowerParams limits;
    EXPECT_LE(std::fabs(velocity.turn_radps), limits.max_turn_radps + 1e-12);
    EXPECT_LE(velocity.forward_mps, limits.max_speed_mps);
    EXPECT_GE(velocity.forward_mps, 0.0) << "never backwards";
    drive.robot.drive(velocity);
    drive.worst_m = std::max(drive.worst_m, distance_to_way_m(way, drive.robot.pose));
  }
  return drive;
}

TEST(PathFollower, DrivesStraightToEndAndStops) {
  PathFollower follower;
  const std::vector<Point> way = {{0.0, 0.0}, {2.0, 0.0}};
  const Drive drive = follow(follower, way, {0.0, 0.0, 0.0});
  ASSERT_TRUE(follower.done());
  EXPECT_LE(distance_m({drive.robot.pose.x, drive.robot.pose.y}, way.back()), 0.02);
  EXPECT_LT(drive.worst_m, 1e-9);
  // 2 m at 0.35 m/s take 57 updates, braking some more; far less than a minute.
  EXPECT_LT(drive.updates, 120);
  const Velocity after = follower.update(drive.robot.pose);
  EXPECT_EQ(after.forward_mps, 0.0);
  EXPECT_EQ(after.turn_radps, 0.0);
}

TEST(PathFollower, PathBehind_TurnsOnSpotFirst) {
  PathFollower follower;
  follower.set_path({{0.0, 0.0}, {1.0, 0.0}});
  Unicycle robot;
  robot.pose = {0.0, 0.0, 3.0};
  int turning = 0;
  for (Velocity v = follower.update(robot.pose); v.forward_mps == 0.0;
       v = follower.update(robot.pose)) {
    EXPECT_LT(v.turn_radps, 0.0) << "from yaw 3 the short way to 0 is clockwise";
    robot.drive(v);
    ASSERT_LT(++turning, 100);
  }
  EXPECT_GT(turning, 10);  // 3 rad at 2 rad/s take 15 updates, minus the tolerance of 0.15 rad
  EXPECT_DOUBLE_EQ(robot.driven_m, 0.0);
  EXPECT_LT(std::fabs(robot.pose.yaw), 0.15);
}

TEST(PathFollower, SharpCorners_StaysNearPath) {
  PathFollower follower;
  // A right angle, a hairpin (there and back), and 45 degrees.
  const std::vector<Point> way = {{0.0, 0.0}, {0.6, 0.0}, {0.6, 0.6}, {0.6, 0.2}, {1.0, 0.6}};
  const Drive drive = follow(follower, way, {0.0, 0.0, 0.0});
  ASSERT_TRUE(follower.done());
  EXPECT_LE(distance_m({drive.robot.pose.x, drive.robot.pose.y}, way.back()), 0.02);
  // The aim is 0.08 m ahead, so a turn may begin this much before its corner. The robot overshoots
  // by up to 0.035 m, an update at full speed.
  EXPECT_LT(drive.worst_m, 0.05);
  EXPECT_GT(drive.robot.driven_m, 0.9 * path_length_m(way)) << "no short cuts";
}

TEST(PathFollower, RandomGrids_FollowsPlannedPaths) {
  std::mt19937 random(21);
  int driven = 0;
  for (int round = 0; round < 60; ++round) {
    const Mask blocked = test::random_mask(test::frame(16, 16, 0.1), 20, random);
    const Path path = theta_star(blocked, test::random_cell(blocked.frame(), random),
                                 test::random_cell(blocked.frame(), random));
    if (!path.found()) continue;
    const std::vector<Point> way = to_points(blocked.frame(), path.cells);
    PathFollower follower;
    const Drive drive =
        follow(follower, way, {way[0].x, way[0].y, 0.01 * static_cast<double>(random() % 628)});
    EXPECT_TRUE(follower.done()) << "round " << round;
    EXPECT_LE(distance_m({drive.robot.pose.x, drive.robot.pose.y}, way.back()), 0.02);
    if (way.size() > 1) {
      EXPECT_LT(drive.worst_m, 0.05) << "round " << round;
    }
    ++driven;
  }
  EXPECT_GT(driven, 20);
}

TEST(PathFollower, CrossingPath_DoesNotJump) {
  PathFollower follower;
  // An eight: the path crosses itself at (0.5, 0).
  const std::vector<Point> way = {{0.0, 0.0}, {1.0, 0.0}, {1.0, 0.5}, {0.5, 0.5}, {0.5, -0.5}};
  const Drive drive = follow(follower, way, {0.0, 0.0, 0.0});
  ASSERT_TRUE(follower.done());
  EXPECT_GT(drive.robot.driven_m, 0.9 * path_length_m(way));
}

TEST(PathFollower, Loop_DoesNotEndAtItsStart) {
  PathFollower follower;
  const std::vector<Point> way = {{0.0, 0.0}, {0.5, 0.0}, {0.5, 0.5}, {0.0, 0.5}, {0.0, 0.0}};
  const Drive drive = follow(follower, way, {0.0, 0.0, 0.0});
  ASSERT_TRUE(follower.done());
  EXPECT_GT(drive.robot.driven_m, 1.8);  // of 2 m
}

TEST(PathFollower, ReportsRemainingDistanceAndDeviation) {
  PathFollower follower;
  follower.set_path({{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}});
  EXPECT_DOUBLE_EQ(follower.remaining_m(), 2.0);
  static_cast<void>(follower.update({0.1, 0.03, 0.0}));
  EXPECT_NEAR(follower.remaining_m(), 1.9, 1e-12);
  EXPECT_NEAR(follower.cross_track_m(), 0.03, 1e-12);
  EXPECT_NEAR(follower.aim().x, 0.18, 1e-12);  // 0.08 m on
  EXPECT_FALSE(follower.done());
}

TEST(PathFollower, NoPath_Idle) {
  PathFollower follower;
  EXPECT_TRUE(follower.done());
  EXPECT_EQ(follower.update({}).forward_mps, 0.0);
  EXPECT_EQ(follower.remaining_m(), 0.0);
  follower.set_path({{1.0, 0.0}});  // a single point as goal
  EXPECT_FALSE(follower.done());
  follower.set_path({});
  EXPECT_TRUE(follower.done());
}

TEST(PathFollower, SingleAndRepeatedPoints_Reached) {
  for (const std::vector<Point>& way :
       {std::vector<Point>{{0.05, 0.02}}, std::vector<Point>{{0.0, 0.0}, {0.3, 0.0}, {0.3, 0.0}}}) {
    PathFollower follower;
    const Drive drive = follow(follower, way, {0.0, 0.0, 0.0});
    EXPECT_TRUE(follower.done());
    EXPECT_LE(distance_m({drive.robot.pose.x, drive.robot.pose.y}, way.back()), 0.02);
  }
}

TEST(PathFollower, InvalidParameters_Refused) {
  FollowerParams params;
  params.max_speed_mps = 0.0;
  EXPECT_THROW(PathFollower{params}, std::invalid_argument);
  params = FollowerParams();
  params.aligned_rad = 1.0;
  EXPECT_THROW(PathFollower{params}, std::invalid_argument);
}

}  // namespace
}  // namespace par
