// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "course/likeness.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

namespace playpen::course {
namespace {

// A robot that drives at a constant speed and turns: a meander whose heading is
// sin(bend * distance), so that it is turned by 4 rad in each period and drives on and on.
struct Meander {
  double speed_mps = 0.3;
  double bend_per_m = 2.0;
  double swing_rad = 1.0;
  double duration_s = 60.0;
  double stop_s = 1e9;  // stands still from then on
};

Drive drive(const Meander& m) {
  Drive result;
  sim::Pose X_WB{0.0, 0.0, 0.0};
  const int rows = static_cast<int>(std::lround(m.duration_s / 0.1));
  for (int k = 0; k <= rows; ++k) {
    const double time_s = 0.1 * k;
    result.time_s.push_back(time_s);
    result.X_WB.push_back(X_WB);
    if (time_s >= m.stop_s) continue;
    const double step_m = 0.1 * m.speed_mps;
    X_WB.yaw_rad = m.swing_rad * std::sin(m.bend_per_m * m.speed_mps * time_s);
    X_WB.x_m += step_m * std::cos(X_WB.yaw_rad);
    X_WB.y_m += step_m * std::sin(X_WB.yaw_rad);
  }
  return result;
}

// The same drive in each of some worlds.
ProgramDrives everywhere(const Meander& meander, std::size_t runs = 5) {
  return ProgramDrives(runs, drive(meander));
}

std::vector<std::string> worlds(std::size_t count = 5) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < count; ++i) names.push_back("world" + std::to_string(i));
  return names;
}

TEST(Likeness, EqualDrives_AreAlikeAndNeverPart) {
  const auto found = find_alike(worlds(), {everywhere({}), everywhere({})}, {});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].first, 0U);
  EXPECT_EQ(found[0].second, 1U);
  EXPECT_EQ(found[0].runs, 5U);
  EXPECT_EQ(found[0].worlds, 5U);
  EXPECT_EQ(found[0].alike, 5U);
  EXPECT_EQ(found[0].parted_s, std::nullopt);
  EXPECT_EQ(found[0].distance_m, 0.0);
  // 60 s at 0.3 m/s are 18 m. Straight moves of 0.25 m cut the curves: up to 6 % are missing.
  EXPECT_NEAR(found[0].shared_m, 17.5, 0.55);
  // The heading swings by 4 rad in each period of pi m: 18 / pi periods have 22.9 rad, of which
  // turns smaller than 0.2 rad at the turning points are missing, at most 0.4 rad a period.
  EXPECT_NEAR(found[0].likeness, std::sqrt(17.5 * 21.8), 1.0);
}

TEST(Likeness, SpeedChangedInTheThirdDigit_IsAlikeUntilTheRobotsPart) {
  const auto found = find_alike(worlds(), {everywhere({}), everywhere({.speed_mps = 0.303})}, {});
  ASSERT_EQ(found.size(), 1U);
  // After t seconds the second robot is 0.003 t further on its curve: 0.15 m at 50 s. Where the
  // curve bends, the straight distance is shorter.
  ASSERT_TRUE(found[0].parted_s.has_value());
  EXPECT_GE(*found[0].parted_s, 50.0);
  EXPECT_LT(*found[0].parted_s, 58.0);
  EXPECT_GT(found[0].distance_m, 0.05);
  EXPECT_LT(found[0].distance_m, 0.15);
}

// A robot that drives straight for a while and then turns on the spot by an angle of its own.
struct Bouncer {
  double speed_mps = 0.3;
  double turn_radps = 1.5;
  int legs = 6;  // until it turns to the other side than the original would
};

Drive bounces(const Bouncer& b) {
  constexpr int kStraight = 20;  // samples of 0.1 s
  constexpr int kTurn = 10;
  Drive result;
  sim::Pose X_WB{0.0, 0.0, 0.0};
  for (int k = 0; k <= 600; ++k) {
    result.time_s.push_back(0.1 * k);
    result.X_WB.push_back(X_WB);
    const int leg = k / (kStraight + kTurn);
    if (k % (kStraight + kTurn) < kStraight) {
      X_WB.x_m += 0.1 * b.speed_mps * std::cos(X_WB.yaw_rad);
      X_WB.y_m += 0.1 * b.speed_mps * std::sin(X_WB.yaw_rad);
    } else {
      X_WB.yaw_rad += (leg < b.legs ? 0.1 : -0.1) * b.turn_radps;
    }
  }
  return result;
}

ProgramDrives bounces_everywhere(const Bouncer& bouncer) {
  return ProgramDrives(5, bounces(bouncer));
}

// Both robots drive 2 legs together, 1.2 m with a turn of 1.5 rad between, and part in the third or
// when it is over: the likeness is at least sqrt(1 m * 1.4 rad) = 1.2, and at most
// sqrt(1.8 m * 3.1 rad) = 2.4.
LikenessLimits limits_for_two_legs() { return {.least_driven_m = 1.0, .least_likeness = 2.5}; }

bool are_alike(const Bouncer& one, const Bouncer& other) {
  return !find_alike(worlds(), {bounces_everywhere(one), bounces_everywhere(other)}, {},
                     limits_for_two_legs())
              .empty();
}

TEST(Likeness, BothSpeedsChangedInTheThirdDigit_LessIsEnough) {
  const Bouncer original{.legs = 9};
  EXPECT_TRUE(are_alike(original, {.speed_mps = 0.303, .turn_radps = 1.51, .legs = 1}));
  // One equal speed may be a common choice, and so may two.
  EXPECT_FALSE(are_alike(original, {.speed_mps = 0.303, .legs = 1}));
  EXPECT_FALSE(are_alike(original, {.turn_radps = 1.51, .legs = 1}));
  EXPECT_FALSE(are_alike(original, {.legs = 1}));
}

TEST(Likeness, OtherTurnRate_MoreIsNeeded) {
  const ProgramDrives original = bounces_everywhere({.legs = 99});
  const ProgramDrives other = bounces_everywhere({.turn_radps = 1.6, .legs = 99});
  const auto equal = find_alike(worlds(), {original, original}, {});
  ASSERT_EQ(equal.size(), 1U);
  EXPECT_EQ(equal[0].threshold, 4.5);
  // The headings differ by 0.1 rad after each turn: the robots part in the third or fourth leg.
  const auto changed = find_alike(worlds(), {original, other}, {}, {.least_likeness = 0.5});
  ASSERT_EQ(changed.size(), 1U);
  EXPECT_EQ(changed[0].threshold, 1.0);
}

TEST(Likeness, OtherSpeed_IsNotAlike) {
  EXPECT_TRUE(find_alike(worlds(), {everywhere({}), everywhere({.speed_mps = 0.35})}, {}).empty());
}

TEST(Likeness, OtherWay_IsNotAlike) {
  EXPECT_TRUE(find_alike(worlds(), {everywhere({}), everywhere({.bend_per_m = 1.5})}, {}).empty());
}

TEST(Likeness, DriveOfABaseline_IsNotCompared) {
  EXPECT_TRUE(find_alike(worlds(), {everywhere({}), everywhere({})}, {everywhere({})}).empty());
  EXPECT_EQ(find_alike(worlds(), {everywhere({}), everywhere({})}, {everywhere({.speed_mps = 0.2})})
                .size(),
            1U);
}

TEST(Likeness, BaselineForHalfTheRun_OnlyTheRestCounts) {
  // The baseline stops after 30 s, and both others part from it after 0.15 m: of 18 m, 9 m remain.
  const auto found =
      find_alike(worlds(), {everywhere({}), everywhere({})}, {everywhere({.stop_s = 30.0})});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(found[0].shared_m, 8.7, 0.5);
}

TEST(Likeness, StraightLine_SaysNothing) {
  const Meander straight{.swing_rad = 0.0};
  EXPECT_TRUE(find_alike(worlds(), {everywhere(straight), everywhere(straight)}, {}).empty());
}

TEST(Likeness, TremblingStraightLine_SaysNothing) {
  // The heading trembles by less than 0.2 rad to both sides in all.
  const Meander trembling{.bend_per_m = 30.0, .swing_rad = 0.09};
  EXPECT_TRUE(find_alike(worlds(), {everywhere(trembling), everywhere(trembling)}, {}).empty());
}

TEST(Likeness, RobotsThatStandStill_SayNothing) {
  const Meander still{.stop_s = 5.0};
  EXPECT_TRUE(find_alike(worlds(), {everywhere(still), everywhere(still)}, {}).empty());
}

TEST(Likeness, RunsWithoutMovement_AreLeftOut) {
  ProgramDrives drives = everywhere({});
  drives[1] = drive({.stop_s = 5.0});
  drives[2] = drive({.stop_s = 0.0});
  const auto found = find_alike(worlds(), {drives, drives}, {});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].runs, 3U);
}

TEST(Likeness, OneStandsStill_IsComparedAndNotAlike) {
  ProgramDrives other = everywhere({});
  other[0] = drive({.stop_s = 0.0});
  const auto found = find_alike(worlds(), {everywhere({}), other}, {});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].runs, 5U);
  EXPECT_EQ(found[0].alike, 4U);
}

TEST(Likeness, MissingRun_IsLeftOut) {
  ProgramDrives other = everywhere({});
  other[3] = {};
  const auto found = find_alike(worlds(), {everywhere({}), other}, {});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].runs, 4U);
  EXPECT_EQ(found[0].worlds, 4U);
}

TEST(Likeness, NoRunAtAll_SaysNothing) {
  const ProgramDrives none(5);
  EXPECT_TRUE(find_alike(worlds(), {none, none, everywhere({})}, {none}).empty());
  EXPECT_TRUE(find_alike({}, {{}, {}}, {}).empty());
  EXPECT_TRUE(find_alike(worlds(), {}, {}).empty());
}

TEST(Likeness, RepeatedRunsOfAWorld_CountOnce) {
  const std::vector<std::string> same = {"a", "a", "a", "b", "b"};
  const auto found = find_alike(same, {everywhere({}), everywhere({})}, {});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].runs, 2U);
  EXPECT_EQ(found[0].worlds, 2U);
}

TEST(Likeness, FewWorlds_NeedMore) {
  const LikenessLimits limits;
  EXPECT_EQ(limits.least_in(10), 4.5);
  EXPECT_EQ(limits.least_in(5), 4.5);
  EXPECT_DOUBLE_EQ(limits.least_in(3), 7.5);
  EXPECT_EQ(limits.least_in(1), 12.0);
  // 12 s: 3.6 m and 4.6 rad together, likeness 4: too little in one world and in five. 24 s: twice
  // as much, likeness 8: enough in five worlds only.
  const auto pairs = [](double stop_s, std::size_t count) {
    const ProgramDrives drives = everywhere({.stop_s = stop_s}, count);
    return find_alike(worlds(count), {drives, drives}, {}).size();
  };
  EXPECT_EQ(pairs(12.0, 5), 0U);
  EXPECT_EQ(pairs(24.0, 5), 1U);
  EXPECT_EQ(pairs(24.0, 1), 0U);
}

TEST(Likeness, SeveralPairs_MostAlikeFirst) {
  const auto found =
      find_alike(worlds(), {everywhere({.speed_mps = 0.303}), everywhere({}), everywhere({})}, {});
  ASSERT_EQ(found.size(), 3U);
  EXPECT_EQ(found[0].first, 1U);
  EXPECT_EQ(found[0].second, 2U);
  EXPECT_EQ(found[1].second, 1U);
  EXPECT_EQ(found[2].second, 2U);
}

TEST(Likeness, OtherNumbersOfRuns_AreRefused) {
  EXPECT_THROW((void)find_alike(worlds(), {everywhere({}, 4)}, {}), std::invalid_argument);
  EXPECT_THROW((void)find_alike(worlds(), {everywhere({})}, {everywhere({}, 6)}),
               std::invalid_argument);
}

TEST(Likeness, OtherPeriodOfRows_IsInterpolated) {
  Drive coarse;
  const Drive fine = drive({});
  for (std::size_t k = 0; k < fine.time_s.size(); k += 2) {
    coarse.time_s.push_back(fine.time_s[k]);
    coarse.X_WB.push_back(fine.X_WB[k]);
  }
  const auto found = find_alike(worlds(), {everywhere({}), ProgramDrives(5, coarse)}, {});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].parted_s, std::nullopt);
  EXPECT_LT(found[0].distance_m, 0.001);  // 6 cm of an arc of 0.5 m radius: 0.9 mm off its chord
}

}  // namespace
}  // namespace playpen::course
