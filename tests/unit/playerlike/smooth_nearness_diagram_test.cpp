// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "drivers/smooth_nearness_diagram.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "ideal_robot.h"

namespace playerlike {
namespace {

using sim::Vec2;
using test::box;
using test::Drive;
using test::kPi;
using test::scan_at;
using test::Segment;

TEST(SmoothNearnessDiagram, NoGoal_StandsStill) {
  SmoothNearnessDiagram navigation({});
  EXPECT_EQ(navigation.state(), GoalState::kIdle);
  const sim::Twist twist = navigation.step(0.1, {}, scan_at({}, {}));
  EXPECT_EQ(twist.v_mps, 0.0);
  EXPECT_EQ(twist.omega_radps, 0.0);
}

TEST(SmoothNearnessDiagram, OpenSpace_DrivesStraightAtFullSpeed) {
  SmoothNearnessDiagram navigation({});
  navigation.start({{2.0, 0.0}, {}});
  const sim::Twist twist = navigation.step(0.1, {}, scan_at({}, {}));
  EXPECT_DOUBLE_EQ(twist.v_mps, 0.3);
  EXPECT_EQ(twist.omega_radps, 0.0);
  Drive drive;
  drive.run(navigation, {}, 30.0);
  EXPECT_EQ(navigation.state(), GoalState::kReached);
  EXPECT_LE((drive.X_WB.position() - Vec2(2.0, 0.0)).norm(), 0.05);
  // 1.95 m at 0.3 m/s take 6.5 s, and the slow end adds at most a second.
  EXPECT_LT(drive.time_s, 8.0);
}

TEST(SmoothNearnessDiagram, GoalBehind_TurnsOnSpot) {
  SmoothNearnessDiagram navigation({});
  navigation.start({{-1.0, 0.1}, {}});
  const sim::Twist twist = navigation.step(0.1, {}, scan_at({}, {}));
  EXPECT_EQ(twist.v_mps, 0.0);
  EXPECT_DOUBLE_EQ(twist.omega_radps, 1.5);  // the shorter turn, to the left
}

TEST(SmoothNearnessDiagram, GoalReached_TurnsToHeading) {
  SmoothNearnessDiagram navigation({});
  navigation.start({{1.0, 0.5}, -2.0});
  Drive drive;
  drive.run(navigation, {}, 30.0);
  EXPECT_EQ(navigation.state(), GoalState::kReached);
  EXPECT_NEAR(drive.X_WB.yaw_rad, -2.0, 0.1);
}

TEST(SmoothNearnessDiagram, WallBeside_DeflectsAndSlowsDown) {
  // A wall along the path, 0.15 m to the left of the centre: within 0.1 + 0.15.
  const std::vector<Segment> wall{{{-3.0, 0.15}, {5.0, 0.15}}};
  SmoothNearnessDiagram navigation({});
  navigation.start({{2.0, 0.0}, {}});
  const sim::Twist twist = navigation.step(0.1, {}, scan_at({}, wall));
  EXPECT_LT(twist.omega_radps, 0.0);
  // The greatest threat is (0.1 + 0.15 - 0.15) / 0.15 = 2/3, which leaves a third of the speed if
  // there is nothing to turn. The beam that hits the wall perpendicularly is at most half a degree
  // off.
  EXPECT_LT(twist.v_mps, 0.1 + 0.001);
  EXPECT_GT(twist.v_mps, 0.0);
}

TEST(SmoothNearnessDiagram, MirroredScans_GiveMirroredTwists) {
  const std::vector<Segment> left = box(0.5, -0.05, 0.8, 0.4);
  const std::vector<Segment> right = box(0.5, -0.4, 0.8, 0.05);
  SmoothNearnessDiagram one({});
  SmoothNearnessDiagram other({});
  one.start({{1.5, 0.0}, {}});
  other.start({{1.5, 0.0}, {}});
  const sim::Twist a = one.step(0.1, {}, scan_at({}, left));
  const sim::Twist b = other.step(0.1, {}, scan_at({}, right));
  EXPECT_LT(a.omega_radps, 0.0);  // around the nearer end, to the right
  // The sectors are slightly asymmetric: each includes only its lower bound. A sector is 0.017 rad.
  EXPECT_NEAR(a.omega_radps, -b.omega_radps, 3.0 * 0.018);
  EXPECT_NEAR(a.v_mps, b.v_mps, 0.3 * 0.018);
}

TEST(SmoothNearnessDiagram, Block_PassedWithoutContact) {
  const std::vector<Segment> block = box(0.9, -0.3, 1.1, 0.2);
  SmoothNearnessDiagram navigation({});
  navigation.start({{2.0, 0.0}, {}});
  Drive drive;
  drive.run(navigation, block, 60.0);
  EXPECT_EQ(navigation.state(), GoalState::kReached);
  EXPECT_GT(drive.least_m, 0.1);
  // "Smooth": it turns out, around and in again by about 40 degrees each, without oscillating.
  EXPECT_LT(drive.turned_rad, kPi);
}

TEST(SmoothNearnessDiagram, WideDoor_Passed) {
  // The gap is 0.3 m wide, the disc 0.2 m.
  const std::vector<Segment> walls{{{1.0, -3.0}, {1.0, 0.2}}, {{1.0, 0.5}, {1.0, 3.0}}};
  SmoothNearnessDiagram navigation({});
  navigation.start({{2.0, 0.0}, {}});
  Drive drive;
  drive.run(navigation, walls, 60.0);
  EXPECT_EQ(navigation.state(), GoalState::kReached);
  EXPECT_GT(drive.least_m, 0.1);
}

TEST(SmoothNearnessDiagram, NarrowDoor_NotTried) {
  // The gap is 0.18 m wide, in an otherwise closed room.
  std::vector<Segment> walls = box(-1.0, -1.0, 3.0, 1.0);
  walls.push_back({{1.0, -1.0}, {1.0, -0.09}});
  walls.push_back({{1.0, 0.09}, {1.0, 1.0}});
  SndSettings settings;
  settings.patience_s = 5.0;
  SmoothNearnessDiagram navigation(settings);
  navigation.start({{2.0, 0.0}, {}});
  Drive drive;
  drive.run(navigation, walls, 60.0);
  EXPECT_EQ(navigation.state(), GoalState::kBlocked);
  EXPECT_GT(drive.least_m, 0.09);
}

TEST(SmoothNearnessDiagram, ClosedRoom_GivesUpAfterTimeout) {
  const std::vector<Segment> room = box(-0.5, -0.5, 0.5, 0.5);
  SndSettings settings;
  settings.patience_s = 3.0;
  SmoothNearnessDiagram navigation(settings);
  navigation.start({{2.0, 0.0}, {}});
  Drive drive;
  drive.run(navigation, room, 60.0);
  EXPECT_EQ(navigation.state(), GoalState::kBlocked);
  // At most a metre, at 0.3 m/s and slower, and then 3 s.
  EXPECT_LT(drive.time_s, 15.0);
  EXPECT_GT(drive.least_m, 0.1);
  const sim::Twist twist = navigation.step(drive.time_s + 0.1, drive.X_WB, scan_at({}, room));
  EXPECT_EQ(twist.v_mps, 0.0);
  EXPECT_EQ(twist.omega_radps, 0.0);
}

TEST(SmoothNearnessDiagram, GoalNearWall_Reached) {
  // 0.148 m from the centre to the wall behind the goal: 5 cm between body and wall.
  const std::vector<Segment> wall{{{1.0, -3.0}, {1.0, 3.0}}};
  SmoothNearnessDiagram navigation({});
  navigation.start({{1.0 - 0.148, 0.3}, {}});
  Drive drive;
  drive.run(navigation, wall, 60.0);
  EXPECT_EQ(navigation.state(), GoalState::kReached);
  EXPECT_GT(drive.least_m, 0.1);
}

TEST(SmoothNearnessDiagram, Cancel_Idles) {
  SmoothNearnessDiagram navigation({});
  navigation.start({{2.0, 0.0}, {}});
  navigation.cancel();
  EXPECT_EQ(navigation.state(), GoalState::kIdle);
  EXPECT_EQ(navigation.step(0.1, {}, scan_at({}, {})).v_mps, 0.0);
}

TEST(SndSettings, FollowSizeAndSpeedsOfRobot) {
  // The S1R: hypot(0.087, 0.045) = 0.0979 m.
  const SndSettings s1r = snd_settings_for(0.0979, 0.5, 3.0);
  const SndSettings defaults;
  for (const sim::Field& field : sim::fields_of<SndSettings>().fields) {
    EXPECT_DOUBLE_EQ(*static_cast<const double*>(field.get(&s1r)),
                     *static_cast<const double*>(field.get(&defaults)))
        << field.name;
  }
  EXPECT_DOUBLE_EQ(snd_settings_for(0.2, 1.0, 2.0).robot_radius_m, 0.2);  // not rounded up
  const SndSettings unknown = snd_settings_for(0.0, 0.0, 0.0);
  EXPECT_DOUBLE_EQ(unknown.robot_radius_m, defaults.robot_radius_m);
  EXPECT_DOUBLE_EQ(unknown.max_speed_mps, defaults.max_speed_mps);
  EXPECT_EQ(fault_of(snd_settings_for(100.0, 100.0, 1000.0)), "");  // within the ranges
}

TEST(SndSettings, InvalidSettings_NamedWithRange) {
  EXPECT_EQ(fault_of(SndSettings{}), "");
  for (const sim::Field& field : sim::fields_of<SndSettings>().fields) {
    for (const double bad : {0.0, -1.0, 1e9, std::nan("")}) {
      SndSettings settings;
      *static_cast<double*>(field.set(&settings)) = bad;
      EXPECT_NE(fault_of(settings).find(field.name), std::string::npos)
          << field.name << " = " << bad;
    }
  }
}

}  // namespace
}  // namespace playerlike
