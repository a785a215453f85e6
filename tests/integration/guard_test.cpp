// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// The guard of the exploration task's solutions, which makes the last check of every command.
#include "guard.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace {

/// Points 5 mm apart along a straight wall, from one point to another, in the robot's frame [m].
std::vector<par::Point> wall(double x0, double y0, double x1, double y1) {
  const double length = par::distance_m({x0, y0}, {x1, y1});
  std::vector<par::Point> points;
  for (double along = 0.0; along <= length; along += 0.005) {
    const double share = along / length;
    points.push_back({x0 + share * (x1 - x0), y0 + share * (y1 - y0)});
  }
  return points;
}

std::vector<par::Point> both(std::vector<par::Point> a, const std::vector<par::Point>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

// The S1R's outline extends 0.087 m ahead and 0.081 m to the sides.
TEST(Guard, Clearance_MeasuredFromOutline) {
  EXPECT_NEAR(clearance({{0.187, 0.0}}), 0.1, 1e-12);
  EXPECT_NEAR(clearance({{0.0, -0.131}, {1.0, 1.0}}), 0.05, 1e-12);
  EXPECT_NEAR(clearance({{0.0, 0.0}}), -0.081, 1e-12);
  EXPECT_EQ(clearance({}), std::numeric_limits<double>::infinity());
}

TEST(Guard, FreeSpace_PassesCommand) {
  const par::Velocity command = CGuard().check({0.4, 1.0}, {wall(1.0, -1.0, 1.0, 1.0), {}});
  EXPECT_DOUBLE_EQ(command.forward_mps, 0.4);
  EXPECT_DOUBLE_EQ(command.turn_radps, 1.0);
}

TEST(Guard, ZeroCommand_StaysZero) {
  const par::Velocity command = CGuard().check({0.0, 0.0}, {wall(0.09, -0.1, 0.09, 0.1), {}});
  EXPECT_EQ(command.forward_mps, 0.0);
  EXPECT_EQ(command.turn_radps, 0.0);
}

TEST(Guard, WallAhead_SlowsDownAndKeepsMargin) {
  CGuard guard;
  double x = 0.0;  // the wall is at 1 m
  double before = 1.0;
  for (int i = 0; i < 200; ++i) {
    const double distance = 1.0 - x;
    const par::Velocity command =
        guard.check({0.5, 0.0}, {wall(distance, -1.0, distance, 1.0), {}});
    if (command.turn_radps != 0.0) break;  // at its margin it turns to drive along the wall
    EXPECT_LE(command.forward_mps, before + 1e-9);
    before = command.forward_mps;
    x += 0.1 * command.forward_mps;
    ASSERT_GE(1.0 - x - 0.087, 0.02 - 1e-9);
  }
  EXPECT_GT(x, 0.8);
}

TEST(Guard, WallBesideCorners_PreventsTurn) {
  // The wall is 5 mm beside it; the corners extend to 0.098 m, which is 17 mm more than the side.
  const std::vector<par::Point> beside = wall(-0.5, 0.086, 0.5, 0.086);
  const par::Velocity command = CGuard().check({0.0, 2.0}, {beside, {}});
  EXPECT_NE(command.forward_mps, 0.0) << "the way out is a gentle curve";
  EXPECT_LT(command.turn_radps * command.forward_mps, 0.0) << "away from the wall on its left";
}

TEST(Guard, NarrowDeadEnd_BacksOut) {
  // 13 mm of room on both sides and 5 mm ahead.
  const std::vector<par::Point> end =
      both(wall(0.092, -0.094, 0.092, 0.094),
           both(wall(-0.5, 0.094, 0.092, 0.094), wall(-0.5, -0.094, 0.092, -0.094)));
  const par::Velocity command = CGuard().check({0.3, 0.0}, {end, {}});
  EXPECT_LT(command.forward_mps, 0.0);
}

TEST(Guard, PrefersSeenSpaceToUnseen) {
  // It wants to turn, but the space behind it is unknown: it first drives ahead.
  const std::vector<par::Point> behind = wall(-0.095, -0.1, -0.095, 0.1);
  const par::Velocity blind = CGuard().check({0.0, 2.0}, {{}, behind});
  EXPECT_GT(blind.forward_mps, 0.0);
  // With a wall ahead, turning is the only way out.
  const par::Velocity turning = CGuard().check({0.0, 2.0}, {wall(0.145, -0.3, 0.145, 0.3), behind});
  EXPECT_NE(turning.turn_radps, 0.0);
}

}  // namespace
