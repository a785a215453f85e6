// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// With all three namespaces, as in half of the existing programs.
#include <gtest/gtest.h>

#include "libCCMorse/CCMorse.h"

using namespace std;
using namespace PlayerCc;
using namespace CCMorse;

// Defined in utility_own_functions.cpp: calls these names in a program that defines them itself.
double normalize_in_a_program_with_its_own(double angle_rad);
double limit_in_a_program_with_its_own(double value);

namespace {

TEST(Utility, DegreesAndRadians_Converted) {
  EXPECT_DOUBLE_EQ(dtor(180.0), M_PI);
  EXPECT_DOUBLE_EQ(rtod(M_PI / 2.0), 90.0);
  EXPECT_DOUBLE_EQ(DTOR(90), M_PI / 2.0);
  EXPECT_DOUBLE_EQ(RTOD(M_PI), 180.0);
  EXPECT_DOUBLE_EQ(PI, M_PI);
}

TEST(Utility, Angles_WrappedToHalfTurn) {
  EXPECT_DOUBLE_EQ(normalize(0.5), 0.5);
  EXPECT_NEAR(normalize(2.0 * M_PI + 0.5), 0.5, 1e-15);  // one rounding of 2 pi + 0.5
  EXPECT_NEAR(normalize(-3.0 * M_PI + 0.1), -M_PI + 0.1, 1e-14);
  EXPECT_NEAR(NORMALIZE(2.0 * M_PI + 0.5), 0.5, 1e-14);  // by sine and cosine of a large angle
  EXPECT_LE(abs(normalize(1e6)), M_PI);
}

TEST(Utility, Limit_KeepsValuesInRange) {
  EXPECT_EQ(limit(5, 0, 3), 3);
  EXPECT_EQ(limit(-5, 0, 3), 0);
  EXPECT_EQ(limit(2, 0, 3), 2);
  EXPECT_DOUBLE_EQ(limit(0.7, -0.5, 0.5), 0.5);
}

TEST(Utility, MinAndMax_UnambiguousBesideStandard) {
  EXPECT_EQ(min(1, 2), 1);
  EXPECT_EQ(max(1.5, 0.5), 1.5);
  EXPECT_EQ(PlayerCc::min(3, 2), 2);
  EXPECT_EQ(PlayerCc::max(3.0, 2.0), 3.0);
  EXPECT_EQ(MIN(3, 2), 2);
  EXPECT_EQ(MAX(3, 2), 3);
}

TEST(Utility, ProgramFunctions_Preferred) {
  EXPECT_DOUBLE_EQ(normalize_in_a_program_with_its_own(1.0), 42.0);
  EXPECT_DOUBLE_EQ(limit_in_a_program_with_its_own(1.0), 43.0);
}

TEST(Utility, Constants_MatchPlayer) {
  EXPECT_EQ(PLAYER_PORTNUM, 6665);
  EXPECT_EQ(PLAYER_HOSTNAME, "localhost");
  EXPECT_EQ(PLAYER_LASER_CODE, 6);
  EXPECT_EQ(PLAYER_POSITION2D_CODE, 4);
  EXPECT_EQ(PLAYER_DATAMODE_PULL, 2);
  EXPECT_EQ(TRUE, 1);
  uint unsigned_number = 7;
  EXPECT_EQ(unsigned_number, 7U);
}

TEST(Utility, Structs_HaveTagsAndAggregateInitialisation) {
  struct player_pose2d pose = {1.0, 2.0, 3.0};
  player_point_2d point = {4.0, 5.0};
  player_color_t colour = {255, 1, 2, 3};
  EXPECT_EQ(pose.pa, 3.0);
  EXPECT_EQ(point.py, 5.0);
  EXPECT_EQ(colour.alpha, 255);
  EXPECT_EQ(colour.blue, 3);
}

}  // namespace
