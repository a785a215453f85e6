// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "fuzz/judgement.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>

namespace playpen::fuzz {
namespace {

using testing::HasSubstr;

constexpr const char* kIntroWorld = PLAYPEN_SOURCE_DIR "/worlds/tasks/par_intro.json";

// A run of 30 s in which the robot drove 3 m without a fault.
class JudgementTest : public testing::Test {
 protected:
  JudgementTest() {
    result.report.emplace();
    result.report->run.sim_time_s = 30.0;
    result.report->ended = playerlike::RunEnd{.by = playerlike::RunEnd::By::kDuration};
    playerlike::Report::Robot& robot = result.report->robots.emplace_back();
    robot.name = "r1";
    robot.least_clearance_m = 0.2;
    grade::Trajectory& way = result.trajectories.emplace_back();
    way.robot = "r1";
    for (int i = 0; i <= 30; ++i) {
      way.time_s.push_back(i);
      way.X_WB.emplace_back(0.4 + 0.1 * i, 0.4, 0.0);
      way.v_mps.push_back(0.1);
      way.omega_radps.push_back(0.0);
    }
    robot.final_pose = way.X_WB.back();
  }
  std::optional<Failure> failure() const { return failure_of(result, rules, base, *world); }
  void expect(Kind kind, const std::string& words) const {
    const auto found = failure();
    ASSERT_TRUE(found) << words;
    EXPECT_EQ(name_of(found->kind), name_of(kind));
    EXPECT_THAT(found->text, HasSubstr(words));
  }

  const Base base{kIntroWorld, ""};
  std::optional<Base::World> world = base.world_of({});
  RunResult result;
  Rules rules;
};

TEST_F(JudgementTest, GoodRun_NoFailure) {
  EXPECT_FALSE(failure());
  EXPECT_EQ(least_clearance_m(result, base), 0.2);
}

TEST_F(JudgementTest, Collision_UnlessAMovingThingHitsAStandingRobot) {
  result.report->collisions = {
      {.time_s = 5.5, .robot = "r1", .with = "found1", .place = {1.0, 2.0}}};
  expect(Kind::kCollision, "hits found1 at 5.50 s, (1.00, 2.00)");
  for (double& speed : result.trajectories[0].v_mps) speed = 0.0;
  expect(Kind::kCollision, "hits found1");
  Scenario scenario;
  scenario.elements = {{.center = {1.7, 0.4}, .moves = true, .speed_mps = 0.1}};
  world = base.world_of(scenario);
  EXPECT_FALSE(failure());
  result.report->collisions[0].with = "s3";
  expect(Kind::kCollision, "hits s3");
  result.report->collisions[0].robot = "r2";
  EXPECT_FALSE(failure());
}

TEST_F(JudgementTest, CrashStatusHangAndSanitizer) {
  result.end.signal = SIGSEGV;
  expect(Kind::kCrash, "signal 11");
  result.hangs = true;
  result.end.signal = SIGKILL;
  expect(Kind::kHang, "limit");
  result = {};
  result.end.status = 3;
  expect(Kind::kBadStatus, "status 3");
  result.printed = "hello\nrobot.cc:7:3: runtime error: index 9 out of bounds\nmore\n";
  expect(Kind::kSanitizer, "robot.cc:7:3: runtime error: index 9 out of bounds");
}

TEST_F(JudgementTest, BadStatus_NotAfterTheRunNorWithoutAWay) {
  result.end.status = 1;
  EXPECT_FALSE(failure());  // its duration was over
  result.report->ended->by = playerlike::RunEnd::By::kProgram;
  expect(Kind::kBadStatus, "status 1");
  result.report->ended->by = playerlike::RunEnd::By::kVerdict;
  EXPECT_FALSE(failure());
  result.report->ended->by = playerlike::RunEnd::By::kProgram;
  rules.goal = grade::Goal{.position = base.world().arena.obstacles[0].center, .yaw_rad = {}};
  EXPECT_FALSE(failure());
}

TEST_F(JudgementTest, Goal_MustBeReachedIfThereIsAWay) {
  rules.goal = grade::Goal{.position = {3.1, 3.3}, .yaw_rad = {}};
  expect(Kind::kGoal, "from its goal");
  result.report->robots[0].final_pose = {3.1, 3.35, 0.0};
  EXPECT_FALSE(failure());
  rules.goal->yaw_rad = 3.0;
  expect(Kind::kGoal, "from its goal");
  // In the middle of a block of the arena: there is no way.
  rules.goal = grade::Goal{.position = base.world().arena.obstacles[0].center, .yaw_rad = {}};
  EXPECT_FALSE(failure());
}

TEST_F(JudgementTest, StallStuckVerdictAndExpectations) {
  result.report->robots[0].stalled_time_s = 4.0;
  expect(Kind::kStall, "4.0 s");
  result.report->robots[0].stalled_time_s = 1.0;
  for (std::size_t i = 10; i <= 30; ++i) result.trajectories[0].X_WB[i] = {1.4, 0.4, 0.1};
  expect(Kind::kStuck, "from 8.0 s on");
  rules.must_move = false;
  EXPECT_FALSE(failure());
  rules.expectations = {expect::Expectation::parse("stalled_time < 0.5")};
  expect(Kind::kExpectation, "stalled_time < 0.5: r1 has 1");
  result.report->verdict = {.passed = false, .reason = "too slow", .time_s = 3.0};
  expect(Kind::kVerdict, "too slow");
}

TEST_F(JudgementTest, Kinds_OnlyThoseThatCount) {
  result.report->robots[0].stalled_time_s = 4.0;
  rules.kinds = {Kind::kCrash, Kind::kCollision};
  EXPECT_FALSE(failure());
}

}  // namespace
}  // namespace playpen::fuzz
