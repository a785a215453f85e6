// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "expect/expectation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

namespace playpen::expect {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::ThrowsMessage;

// Two robots: r1 hit a wall and reached its goal, r2 did neither.
playerlike::Report report() {
  playerlike::Report report;
  report.run.sim_time_s = 12.5;
  for (const char* const name : {"r1", "r2"}) report.robots.emplace_back().name = name;
  report.robots[0].collisions = 2;
  report.robots[0].path_length_m = 3.25;
  report.robots[0].least_clearance_m = 0.0;
  report.robots[1].path_length_m = 1.0;
  report.collisions = {{.time_s = 1.5, .robot = "r1", .with = "s2", .place = {0.94, 1.71}}};
  report.goals = {{.time_s = 0.0, .robot = "r1", .place = {1, 1}, .reached_s = 9.0},
                  {.time_s = 0.0, .robot = "r2", .place = {2, 2}, .reached_s = {}}};
  return report;
}

std::vector<std::string> faults(const std::string& text, const playerlike::Report& of = report()) {
  return Expectation::parse(text).faults_of(of);
}

TEST(Expectation, EachRobotMustMeetIt) {
  EXPECT_THAT(faults("path_length >= 1"), IsEmpty());
  EXPECT_THAT(faults("path_length > 1"), ElementsAre("r2 has 1"));
  EXPECT_THAT(faults("path_length < 1"), ElementsAre("r1 has 3.25", "r2 has 1"));
}

TEST(Expectation, RobotNamed_OnlyThatOne) {
  EXPECT_THAT(faults("r1.path_length > 1"), IsEmpty());
  EXPECT_THAT(faults("r2.path_length > 1"), ElementsAre("r2 has 1"));
  EXPECT_THAT(faults("r1.final_pose.x == 0"), IsEmpty());
  EXPECT_THAT(faults("r9.collisions == 0"), ElementsAre("the run has no robot r9"));
}

TEST(Expectation, Collisions_FirstOneIsNamed) {
  EXPECT_THAT(faults("collisions == 0"),
              ElementsAre("r1 has 2; the first with s2 at 1.50 s, x 0.94, y 1.71"));
  EXPECT_THAT(faults("collisions<=2"), IsEmpty());
  EXPECT_THAT(faults("r1.collisions != 2"), testing::SizeIs(1));
}

TEST(Expectation, GoalsScoreVerdictAndTime) {
  EXPECT_THAT(faults("reached == yes"), ElementsAre("r2 has no"));
  EXPECT_THAT(faults("sim_time <= 12.5"), IsEmpty());
  EXPECT_THAT(faults("sim_time < 12.5"), ElementsAre("the run has 12.5"));
  EXPECT_THAT(faults("passed == yes"), ElementsAre("the run has no value of it"));
  playerlike::Report judged = report();
  judged.scores = {{{.robot = "r1", .points = 3.0}, {.robot = "r2", .points = -1.0}}};
  judged.verdict = {.passed = false, .reason = "too slow", .time_s = 12.0};
  EXPECT_THAT(faults("score >= 0", judged), ElementsAre("r2 has -1"));
  EXPECT_THAT(faults("passed == yes", judged), ElementsAre("the run has no: too slow"));
}

TEST(Expectation, FigureWithoutValue_MeetsNothing) {
  EXPECT_THAT(faults("least_clearance >= 0"), ElementsAre("r2 has no value of it"));
  EXPECT_THAT(faults("least_clearance != 7"), ElementsAre("r2 has no value of it"));
}

TEST(Expectation, Text_IsWithoutNeedlessBlanks) {
  EXPECT_EQ(Expectation::parse("  r1.path_length>=  10 ").text(), "r1.path_length >= 10");
  EXPECT_EQ(Expectation::parse("passed==no").text(), "passed == no");
}

TEST(Expectation, WrongForm_ErrorSaysWhatWasExpected) {
  const auto error_of = [](const std::string& text) {
    return [text] { static_cast<void>(Expectation::parse(text)); };
  };
  const std::pair<const char*, const char*> cases[] = {
      {"", "expected FIGURE OPERATOR VALUE"},
      {"collisions", "expected FIGURE OPERATOR VALUE"},
      {"collisions = 0", "found 'collisions = 0'"},
      {"collisions == ", "compared with a number, found ''"},
      {"collisions == none", "compared with a number, found 'none'"},
      {"collisions == 1e999", "compared with a number"},
      {"collisions == yes", "compared with a number"},
      {"passed == 1", "compared with yes or no, found '1'"},
      {"collision == 0", "no figure 'collision'; expected [ROBOT.] and one of path_length"},
      {"wall_time < 1", "no figure 'wall_time'"},
      {"r1.sim_time < 1", "figure of the run, not of a robot"},
      {"r1.r2.collisions == 0", "no figure 'r2.collisions'"},
      {"== 0", "no figure ''"}};
  for (const auto& [text, words] : cases) {
    EXPECT_THAT(error_of(text), ThrowsMessage<std::invalid_argument>(HasSubstr(words))) << text;
  }
}

TEST(Expectation, RobotOfNoWorld_Error) {
  sim::WorldDescription world;
  world.robots.emplace_back().name = "r1";
  Expectation::parse("r1.collisions == 0").require_robot_of(world);
  Expectation::parse("collisions == 0").require_robot_of(world);
  EXPECT_THAT([&] { Expectation::parse("r2.collisions == 0").require_robot_of(world); },
              ThrowsMessage<std::invalid_argument>(AllOf(HasSubstr("'r2'"), HasSubstr("r1"))));
}

TEST(Expectation, AllFiguresOfRobots_HaveNamesOfTheReport) {
  for (const char* const name : {"collisions", "least_clearance", "stalled_time", "final_pose.yaw",
                                 "visited_area", "commanded.commands", "reached", "score"}) {
    EXPECT_TRUE(std::ranges::any_of(figures(), [&](const Figure& f) {
      return f.name == name && f.of_robot;
    })) << name;
  }
}

}  // namespace
}  // namespace playpen::expect
