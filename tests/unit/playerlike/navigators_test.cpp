// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// The methods of drivers that drive to goals: what they share, and VFH+, ND and straight driving.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "drivers/navigator.h"
#include "drivers/nearness_diagram.h"
#include "drivers/straight_drive.h"
#include "drivers/vector_field_histogram.h"
#include "ideal_robot.h"

namespace playerlike {
namespace {

using sim::Vec2;
using test::box;
using test::Drive;
using test::kPi;
using test::scan_at;
using test::Segment;

// Settings for a robot of 0.1 m in rooms of a few metres, as a user would choose them.
GoalDriverSettings settings_of(const std::string& kind) {
  if (kind == "vfh") {
    VfhSettings vfh;
    vfh.cell_size_m = 0.05;
    vfh.safety_dist_0ms_m = 0.05;
    vfh.distance_epsilon_m = 0.05;
    vfh.max_turnrate_0ms_radps = 1.5;
    return vfh;
  }
  if (kind == "nd") {
    NdSettings nd;
    nd.avoid_dist_m = 0.15;
    nd.goal_tol_m = 0.05;
    nd.max_turnrate_radps = 1.5;
    return nd;
  }
  if (kind == "goto") return GotoSettings{};
  return SndSettings{};
}

struct EachNavigator : testing::TestWithParam<const char*> {
  std::unique_ptr<Navigator> navigator = make_navigator(settings_of(GetParam()));
  Drive drive;
};
struct EachAvoidingNavigator : EachNavigator {};

const auto kNameOf = [](const auto& instance) {
  return std::string(instance.param) == "goto" ? "straight" : instance.param;
};
INSTANTIATE_TEST_SUITE_P(Kinds, EachNavigator, testing::Values("snd", "vfh", "nd", "goto"),
                         kNameOf);
INSTANTIATE_TEST_SUITE_P(Kinds, EachAvoidingNavigator, testing::Values("snd", "vfh", "nd"),
                         kNameOf);

TEST_P(EachNavigator, NoGoal_StandsStill) {
  EXPECT_EQ(navigator->state(), GoalState::kIdle);
  const sim::Twist twist = navigator->step(0.1, {}, scan_at({}, {}));
  EXPECT_EQ(twist.v_mps, 0.0);
  EXPECT_EQ(twist.omega_radps, 0.0);
}

TEST_P(EachNavigator, GoalInOpen_ReachedWithHeading) {
  navigator->start({{1.5, 0.7}, -2.0});
  drive.run(*navigator, {}, 60.0);
  EXPECT_EQ(navigator->state(), GoalState::kReached);
  EXPECT_LE((drive.X_WB.position() - Vec2(1.5, 0.7)).norm(), 0.075);  // 1.5 times the tolerance
  EXPECT_NEAR(sim::normalize_angle(drive.X_WB.yaw_rad + 2.0), 0.0, 10.0 * kPi / 180.0);
}

TEST_P(EachNavigator, GoalBehind_TurnsOnSpot) {
  navigator->start({{-1.0, 0.1}, {}});
  const sim::Twist twist = navigator->step(0.1, {}, scan_at({}, {}));
  EXPECT_EQ(twist.v_mps, 0.0);
  EXPECT_GT(twist.omega_radps, 0.5);  // the shorter turn, to the left
}

TEST_P(EachNavigator, Cancel_Idles) {
  navigator->start({{2.0, 0.0}, {}});
  navigator->cancel();
  EXPECT_EQ(navigator->state(), GoalState::kIdle);
  EXPECT_EQ(navigator->step(0.1, {}, scan_at({}, {})).v_mps, 0.0);
}

TEST_P(EachNavigator, SlowDown_KeepsLimits) {
  GoalDriverSettings settings = settings_of(GetParam());
  std::visit([](auto& own) { own.slow_down(0.12, 0.4); }, settings);
  navigator->set_settings(settings);
  navigator->start({{1.0, 1.0}, 0.0});
  double sharpest_radps = 0.0;
  while (navigator->state() == GoalState::kMoving && drive.time_s < 60.0) {
    const double before_rad = drive.X_WB.yaw_rad;
    drive.run(*navigator, {}, drive.time_s + 0.05);
    sharpest_radps = std::max(
        sharpest_radps, std::abs(sim::normalize_angle(drive.X_WB.yaw_rad - before_rad)) / 0.1);
  }
  EXPECT_EQ(navigator->state(), GoalState::kReached);
  EXPECT_LE(drive.fastest_mps, 0.12 + 1e-9);
  EXPECT_GT(drive.fastest_mps, 0.07);
  EXPECT_LE(sharpest_radps, 0.4 + 1e-6);
}

TEST_P(EachAvoidingNavigator, Block_PassedWithoutContact) {
  const std::vector<Segment> block = box(0.9, -0.3, 1.1, 0.2);
  navigator->start({{2.0, 0.0}, {}});
  drive.run(*navigator, block, 60.0);
  EXPECT_EQ(navigator->state(), GoalState::kReached);
  EXPECT_GT(drive.least_m, 0.1);
}

TEST_P(EachAvoidingNavigator, Door_Passed) {
  // The gap is 0.6 m wide, the disc 0.2 m.
  const std::vector<Segment> walls{{{1.0, -3.0}, {1.0, 0.1}}, {{1.0, 0.7}, {1.0, 3.0}}};
  navigator->start({{2.0, 0.0}, {}});
  drive.run(*navigator, walls, 60.0);
  EXPECT_EQ(navigator->state(), GoalState::kReached);
  EXPECT_GT(drive.least_m, 0.1);
}

TEST_P(EachAvoidingNavigator, ClosedRoom_BlockedWithoutCollision) {
  const std::vector<Segment> room = box(-0.6, -0.6, 0.6, 0.6);
  navigator->start({{2.0, 0.0}, {}});
  drive.run(*navigator, room, 120.0);
  EXPECT_EQ(navigator->state(), GoalState::kBlocked);
  EXPECT_GT(drive.least_m, 0.1);
  const sim::Twist twist = navigator->step(drive.time_s + 0.1, drive.X_WB, scan_at({}, room));
  EXPECT_EQ(twist.v_mps, 0.0);
  EXPECT_EQ(twist.omega_radps, 0.0);
}

TEST_P(EachAvoidingNavigator, DeadEnd_EndsWithoutCollision) {
  // A U that is open towards the robot, with the goal behind it.
  const std::vector<Segment> u{
      {{0.5, -0.5}, {1.5, -0.5}}, {{1.5, -0.5}, {1.5, 0.5}}, {{1.5, 0.5}, {0.5, 0.5}}};
  navigator->start({{2.5, 0.0}, {}});
  drive.run(*navigator, u, 300.0);
  EXPECT_NE(navigator->state(), GoalState::kMoving);
  EXPECT_GT(drive.least_m, 0.1);
}

// --- VFH+

TEST(VectorFieldHistogram, Obstacle_BlocksSectorsThatDiscWouldMeet) {
  VfhSettings settings;
  settings.free_space_cutoff_0ms = 1.0;  // every occupied cell counts
  settings.safety_dist_0ms_m = 0.1;
  VectorFieldHistogram navigation(settings);
  navigation.start({{2.5, 0.0}, {}});
  // A post of 4 cm, 1 m ahead of the body's centre.
  static_cast<void>(navigation.step(0.1, {}, scan_at({}, box(0.98, -0.02, 1.02, 0.02))));
  const std::vector<bool>& blocked = navigation.blocked_sectors();
  ASSERT_EQ(blocked.size(), 72U);
  // The nearest cell, at 1 m, is enlarged by asin(0.2) = 11.5 degrees. Cells are at most a cell's
  // diagonal, 0.07 m or 4 degrees, off. Sector 36 begins straight ahead.
  for (const std::size_t sector : {34U, 35U, 36U, 37U}) EXPECT_TRUE(blocked[sector]) << sector;
  for (const std::size_t sector : {0U, 18U, 30U, 41U, 54U, 71U}) {
    EXPECT_FALSE(blocked[sector]) << sector;
  }
}

TEST(VectorFieldHistogram, SectorsBetweenThresholds_KeepState) {
  VfhSettings settings;
  settings.free_space_cutoff_0ms = 1.0;
  VectorFieldHistogram navigation(settings);
  navigation.start({{2.5, 0.0}, {}});
  const auto ahead = [&](double time_s, const std::vector<Segment>& walls) {
    static_cast<void>(navigation.step(time_s, {}, scan_at({}, walls)));
    return static_cast<bool>(navigation.blocked_sectors()[36]);
  };
  const std::vector<Segment> post = box(0.98, -0.02, 1.02, 0.02);
  EXPECT_TRUE(ahead(0.1, post));
  settings.free_space_cutoff_0ms = 1e-3;
  settings.obs_cutoff_0ms = 1e12;  // nothing becomes blocked, only nothing at all is free
  navigation.set_settings(settings);
  EXPECT_TRUE(ahead(0.2, post));
  EXPECT_FALSE(ahead(0.3, {}));
  EXPECT_FALSE(ahead(0.4, post));
}

TEST(VectorFieldHistogram, Acceleration_LimitsSpeed) {
  VectorFieldHistogram navigation(VfhSettings{});
  navigation.start({{2.5, 0.0}, {}});
  // 0.2 m/s^2 in steps of 0.1 s.
  EXPECT_NEAR(navigation.step(0.1, {}, scan_at({}, {})).v_mps, 0.02, 1e-9);
  EXPECT_NEAR(navigation.step(0.2, {}, scan_at({}, {})).v_mps, 0.04, 1e-9);
}

// --- ND

TEST(NearnessDiagram, Situation_Classified) {
  NdSettings settings;
  settings.avoid_dist_m = 0.3;
  NearnessDiagram navigation(settings);
  using Case = NearnessDiagram::Case;
  const auto situation = [&](const std::vector<Segment>& walls) {
    navigation.start({{2.5, 0.0}, {}});
    static_cast<void>(navigation.step(0.1, {}, scan_at({}, walls)));
    return navigation.situation();
  };
  EXPECT_EQ(situation({}), Case::kHighSafetyGoalInRegion);
  EXPECT_EQ(situation({{{0.2, 0.3}, {1.5, 0.3}}}), Case::kLowSafetyOneSide);
  EXPECT_EQ(situation({{{0.2, 0.3}, {1.5, 0.3}}, {{0.2, -0.3}, {1.5, -0.3}}}),
            Case::kLowSafetyTwoSides);
  EXPECT_EQ(situation(box(1.0, -0.5, 1.2, 0.5)), Case::kHighSafetyWideRegion);
  // A door of 0.6 m in a wall: 34 degrees seen from here.
  EXPECT_EQ(situation({{{1.0, -3.0}, {1.0, 0.1}}, {{1.0, 0.7}, {1.0, 3.0}}}),
            Case::kHighSafetyNarrowRegion);
}

TEST(NearnessDiagram, StuckRobot_BlockedAfterTimeout) {
  NearnessDiagram navigation(NdSettings{});
  navigation.start({{2.5, 0.0}, {}});
  double time_s = 0.0;
  while (navigation.state() == GoalState::kMoving && time_s < 10.0) {
    time_s += 0.1;
    static_cast<void>(navigation.step(time_s, {}, scan_at({}, {})));
  }
  EXPECT_EQ(navigation.state(), GoalState::kBlocked);
  EXPECT_NEAR(time_s, 2.1, 0.11);  // translate_stuck_time is 2 s
}

// --- goto

TEST(StraightDrive, TurnsThenDrives) {
  StraightDrive navigation(GotoSettings{});
  navigation.start({{0.0, 1.0}, {}});
  const sim::Twist first = navigation.step(0.1, {}, {});
  EXPECT_EQ(first.v_mps, 0.0);
  EXPECT_DOUBLE_EQ(first.omega_radps, kPi / 4.0);  // 45 degrees/s
  const sim::Twist aligned = navigation.step(0.2, {0.0, 0.0, 0.5 * kPi}, {});
  EXPECT_NEAR(aligned.v_mps, 0.35, 1e-9);  // 0.7 m/s from 2 m on, half of it at 1 m
}

}  // namespace
}  // namespace playerlike
