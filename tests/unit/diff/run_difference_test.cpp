// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "diff/run_difference.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "diff/difference_text.h"

namespace {

using playpen::diff::ComparedRun;
using playpen::diff::difference_of;
using playpen::diff::Figure;
using playpen::diff::figures_of;
using playpen::diff::RobotDifference;
using playpen::diff::RunDifference;
using playpen::diff::text_of;
using playpen::grade::Trajectory;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

// A robot that drives along y = 0 at 1 m/s, with a row each 0.1 s.
Trajectory straight(int rows, const std::string& robot = "r1") {
  Trajectory track;
  track.robot = robot;
  for (int i = 0; i < rows; ++i) {
    track.time_s.push_back(0.1 * i);
    track.X_WB.push_back({0.1 * i, 0.0, 0.0});
    track.v_mps.push_back(1.0);
    track.omega_radps.push_back(0.0);
  }
  return track;
}

ComparedRun run_of(const std::vector<const Trajectory*>& tracks) {
  ComparedRun run;
  run.report.run.world = "room";
  run.report.run.seed = 1;
  run.report.run.sim_time_s = 1.0;
  run.trajectories = tracks;
  for (const Trajectory* const track : tracks) run.report.robots.emplace_back().name = track->robot;
  return run;
}

std::string text_of_pair(const ComparedRun& first, const ComparedRun& second) {
  return text_of(difference_of(first, second), first, second);
}

TEST(RunDifference, EqualRuns_Equal) {
  const Trajectory track = straight(4);
  ComparedRun other = run_of({&track});
  other.report.run.wall_time_s = 7.0;  // these differ between any two runs
  other.report.run.world_file = "elsewhere/room.json";
  const RunDifference difference = difference_of(run_of({&track}), other);
  EXPECT_FALSE(difference.any());
  EXPECT_FALSE(difference.trajectories_differ());
  EXPECT_EQ(difference.robots.at(0).time_s.size(), 4U);
  EXPECT_THAT(text_of_pair(run_of({&track}), other),
              AllOf(HasSubstr("conditions: equal"), HasSubstr("The runs are equal: all 4 rows")));
}

TEST(RunDifference, DriftingRobot_PartsAtEachLimit) {
  const Trajectory first = straight(6);
  Trajectory second = straight(6);
  // 0, 0.5, 1, 9, 50, 200 mm to the left
  const std::vector<double> y_m = {0.0, 0.0005, 0.001, 0.009, 0.05, 0.2};
  for (std::size_t i = 0; i < y_m.size(); ++i) second.X_WB[i].y_m = y_m[i];
  const RunDifference difference = difference_of(run_of({&first}), run_of({&second}));
  ASSERT_TRUE(difference.first);
  EXPECT_EQ(difference.first->value, "y");
  EXPECT_EQ(difference.first->time_s, first.time_s[1]);
  EXPECT_EQ(difference.first->first, 0.0);
  EXPECT_EQ(difference.first->second, 0.0005);
  const RobotDifference& robot = difference.robots.at(0);
  // Exactly 1 mm is not more than 1 mm.
  ASSERT_EQ(robot.distances.size(), 3U);
  EXPECT_EQ(robot.distances[0].limit, 0.001);
  EXPECT_EQ(robot.distances[0].time_s, first.time_s[3]);
  EXPECT_EQ(robot.distances[0].first, first.X_WB[3]);
  EXPECT_EQ(robot.distances[0].second, second.X_WB[3]);
  EXPECT_EQ(robot.distances[1].time_s, first.time_s[4]);
  EXPECT_EQ(robot.distances[2].time_s, first.time_s[5]);
  EXPECT_THAT(robot.headings, IsEmpty());
  EXPECT_EQ(robot.greatest.distance_m, 0.2);
  EXPECT_EQ(robot.last.time_s, first.time_s[5]);
}

// The difference of these decimals is a little more than 1 mm in binary.
TEST(RunDifference, OneMillimetreInDecimals_NotMore) {
  const Trajectory first = straight(1);
  Trajectory second = first;
  Trajectory third = first;
  second.X_WB[0].y_m = 0.401;
  third.X_WB[0].y_m = 0.400;
  ASSERT_GT(0.401 - 0.400, 0.001);
  EXPECT_THAT(difference_of(run_of({&second}), run_of({&third})).robots.at(0).distances, IsEmpty());
}

TEST(RunDifference, Jump_ExceedsAllLimitsAtOnce) {
  const Trajectory first = straight(3);
  Trajectory second = straight(3);
  second.X_WB[1].x_m += 3.0;
  second.X_WB[1].y_m += 4.0;
  const RobotDifference robot = difference_of(run_of({&first}), run_of({&second})).robots.at(0);
  ASSERT_EQ(robot.distances.size(), 3U);
  for (const auto& parting : robot.distances) EXPECT_EQ(parting.time_s, first.time_s[1]);
  EXPECT_DOUBLE_EQ(robot.greatest.distance_m, 5.0);
  EXPECT_EQ(robot.greatest.time_s, first.time_s[1]);
  EXPECT_EQ(robot.last.distance_m, 0.0);
}

// From 179° to -179° there are 2°, not 358°.
TEST(RunDifference, Headings_ComparedAcrossHalfTurn) {
  constexpr double kDegree = 0.017453292519943295;
  Trajectory first = straight(2);
  Trajectory second = straight(2);
  first.X_WB[1].yaw_rad = 179.0 * kDegree;
  second.X_WB[1].yaw_rad = -179.0 * kDegree;
  const RunDifference difference = difference_of(run_of({&first}), run_of({&second}));
  EXPECT_EQ(difference.first.value().value, "yaw");
  const RobotDifference& robot = difference.robots.at(0);
  EXPECT_NEAR(robot.heading_deg[1], 2.0, 1e-9);
  ASSERT_EQ(robot.headings.size(), 1U);
  EXPECT_EQ(robot.headings[0].limit, 1.0);
}

TEST(RunDifference, FirstDifference_EarliestOfAllRobots) {
  const Trajectory a = straight(4, "a");
  const Trajectory b = straight(4, "b");
  Trajectory other_a = a;
  Trajectory other_b = b;
  other_a.v_mps[3] = 2.0;
  other_b.omega_radps[2] = 0.5;
  const RunDifference difference = difference_of(run_of({&a, &b}), run_of({&other_b, &other_a}));
  EXPECT_EQ(difference.first.value().robot, "b");
  EXPECT_EQ(difference.first.value().value, "omega");
  EXPECT_EQ(difference.first.value().time_s, b.time_s[2]);
  EXPECT_EQ(difference.robots.at(0).robot, "a");
  EXPECT_EQ(difference.robots.at(0).in_second, 1U);
}

TEST(RunDifference, SameRow_ValuesInOrderOfFile) {
  const Trajectory first = straight(1);
  Trajectory second = first;
  second.omega_radps[0] = 1.0;
  second.v_mps[0] = 2.0;
  EXPECT_EQ(difference_of(run_of({&first}), run_of({&second})).first.value().value, "v");
}

TEST(RunDifference, ShorterRun_ComparedUpToItsEnd) {
  const Trajectory first = straight(5);
  const Trajectory second = straight(3);
  const RunDifference difference = difference_of(run_of({&first}), run_of({&second}));
  EXPECT_TRUE(difference.trajectories_differ());
  EXPECT_EQ(difference.robots.at(0).time_s.size(), 3U);
  EXPECT_EQ(difference.robots.at(0).unmatched, 0U);
  EXPECT_EQ(difference.first.value().time_s, first.time_s[3]);
  EXPECT_EQ(difference.first.value().value, "");
  EXPECT_TRUE(difference.first.value().in_first);
  EXPECT_THAT(text_of_pair(run_of({&first}), run_of({&second})),
              AllOf(HasSubstr("a row that only run 1 has"),
                    HasSubstr("r1: compared up to 0.200 s, where run 2 ends; run 1 goes on until "
                              "0.400 s")));
}

TEST(RunDifference, MissingRow_OthersStillMatchedByTime) {
  const Trajectory first = straight(4);
  Trajectory second = straight(4);
  second.time_s.erase(second.time_s.begin() + 1);
  second.X_WB.erase(second.X_WB.begin() + 1);
  second.v_mps.pop_back();
  second.omega_radps.pop_back();
  const RobotDifference robot = difference_of(run_of({&first}), run_of({&second})).robots.at(0);
  EXPECT_EQ(robot.unmatched, 1U);
  EXPECT_THAT(robot.distance_m, ElementsAre(0.0, 0.0, 0.0));
}

TEST(RunDifference, NoCommonTime_SaidInWords) {
  const Trajectory first = straight(2);
  Trajectory second = straight(2);
  for (double& time_s : second.time_s) time_s += 0.05;
  const std::string text = text_of_pair(run_of({&first}), run_of({&second}));
  EXPECT_THAT(text, AllOf(HasSubstr("no time in common"), Not(HasSubstr("compared up to")),
                          Not(HasSubstr("trajectories part"))));
}

TEST(RunDifference, OtherRobots_Named) {
  const Trajectory a = straight(2, "a");
  const Trajectory b = straight(2, "b");
  const Trajectory c = straight(2, "c\x1b[2J");
  const RunDifference difference = difference_of(run_of({&a, &b}), run_of({&a, &c}));
  EXPECT_THAT(difference.only_first, ElementsAre("b"));
  EXPECT_EQ(difference.only_second.size(), 1U);
  EXPECT_TRUE(difference.trajectories_differ());
  EXPECT_THAT(text_of_pair(run_of({&a, &b}), run_of({&a, &c})),
              AllOf(HasSubstr("only in run 1: b\n"), HasSubstr("only in run 2: c"),
                    Not(HasSubstr("\x1b"))));
}

TEST(RunDifference, HugeNumbers_InfiniteDistance) {
  Trajectory first = straight(1);
  Trajectory second = straight(1);
  first.X_WB[0] = {1.7e308, 0.0, 1e300};
  second.X_WB[0] = {-1.7e308, 0.0, -1e300};
  const RobotDifference robot = difference_of(run_of({&first}), run_of({&second})).robots.at(0);
  EXPECT_TRUE(std::isinf(robot.greatest.distance_m));
  EXPECT_LE(robot.heading_deg[0], 180.0);
  const std::string text = text_of_pair(run_of({&first}), run_of({&second}));
  EXPECT_THAT(text, HasSubstr("greatest distance inf m"));
  EXPECT_LT(text.size(), 2000U) << "numbers have six significant digits";
}

TEST(RunDifference, Conditions_ListedWithBothValues) {
  const Trajectory track = straight(2);
  ComparedRun first = run_of({&track});
  ComparedRun second = run_of({&track});
  second.report.run.seed = 2;
  second.report.run.realism = "ideal";
  first.report.graded.emplace(playerlike::Report::Graded{}).duration_s = 30.0;
  second.report.graded.emplace(playerlike::Report::Graded{}).time = "1";
  first.world_hash = 1;
  second.world_hash = 2;
  first.report.run.world_file = "a.json";
  second.report.run.world_file = "b.json";
  const RunDifference difference = difference_of(first, second);
  std::string names;
  for (const auto& pair : difference.settings) {
    names += pair.name + "=" + pair.first + "/" + pair.second + "; ";
  }
  EXPECT_EQ(names,
            "content of the world's file=a.json/b.json; seed=1/2; realism=course/ideal; "
            "duration=30 s/unlimited; time mode=/1; ");
  EXPECT_FALSE(difference.trajectories_differ());
  EXPECT_TRUE(difference.any());
}

TEST(RunDifference, OtherMembersOfReport_Named) {
  const Trajectory track = straight(2);
  ComparedRun second = run_of({&track});
  second.report.said.push_back({0.1, "r1", "hello"});
  const RunDifference difference = difference_of(run_of({&track}), second);
  EXPECT_TRUE(difference.any());
  EXPECT_TRUE(difference.only_report_differs());
  EXPECT_THAT(text_of_pair(run_of({&track}), second),
              HasSubstr("first member of report.json that differs: /said"));
}

const Figure& figure_named(const std::vector<playpen::diff::FigureGroup>& groups,
                           const std::string& robot, const std::string& name) {
  for (const auto& group : groups) {
    for (const Figure& figure : group.figures) {
      if (group.robot == robot && figure.values.name == name) return figure;
    }
  }
  static const Figure none{{"none", "", ""}, false};
  ADD_FAILURE() << "no figure '" << name << "' of '" << robot << "'";
  return none;
}

TEST(Figures, DifferingValues_NeverLookEqual) {
  const Trajectory track = straight(2);
  ComparedRun first = run_of({&track});
  ComparedRun second = first;
  first.report.robots[0].path_length_m = 1.0;
  second.report.robots[0].path_length_m = 1.00001;
  second.report.robots[0].stalled_time_s = 1e-15;
  const auto groups = figures_of(first, second);
  const Figure& path = figure_named(groups, "r1", "path length [m]");
  EXPECT_TRUE(path.differs);
  EXPECT_EQ(path.values.first, "1.00000");
  EXPECT_EQ(path.values.second, "1.00001");
  const Figure& stalled = figure_named(groups, "r1", "stalled time [s]");
  EXPECT_EQ(stalled.values.first, "0");
  EXPECT_EQ(stalled.values.second, "1e-15");
  EXPECT_FALSE(figure_named(groups, "r1", "collisions").differs);
  EXPECT_EQ(figure_named(groups, "r1", "least clearance [m]").values.first, "-");
}

TEST(Figures, CollisionOfOneRun_TimePlaceAndPartner) {
  const Trajectory track = straight(2);
  const ComparedRun first = run_of({&track});
  ComparedRun second = first;
  second.report.collisions = {{0.5, "r2", "wall", {9.0, 9.0}}, {0.75, "r1", "border", {1.0, 2.0}}};
  const auto groups = figures_of(first, second);
  const Figure& time = figure_named(groups, "r1", "first collision [s]");
  EXPECT_EQ(time.values.first, "-");
  EXPECT_EQ(time.values.second, "0.750");
  EXPECT_TRUE(time.differs);
  EXPECT_EQ(figure_named(groups, "r1", "first collision, y [m]").values.second, "2.000");
  EXPECT_EQ(figure_named(groups, "r1", "first collision with").values.second, "border");
}

TEST(Figures, Verdicts_DifferOnlyIfBothAreGraded) {
  const Trajectory track = straight(2);
  ComparedRun first = run_of({&track});
  ComparedRun second = first;
  first.passed = false;
  first.faults = {"2 collisions, at most 0 expected"};
  EXPECT_FALSE(difference_of(first, second).any());
  second.passed = true;
  EXPECT_TRUE(figure_named(figures_of(first, second), "", "grade").differs);
  EXPECT_THAT(text_of_pair(first, second), HasSubstr("run 1 failed: 2 collisions, at most 0"));
}

TEST(Figures, GoalsAndEnds_InWords) {
  const Trajectory track = straight(2);
  ComparedRun first = run_of({&track});
  ComparedRun second = first;
  first.goals = {{0, {1.0, 0.0}, true, false}, {0, {2.0, 0.0}, false, true}};
  first.report.ended.emplace(playerlike::RunEnd{}).status = 3;
  second.report.ended.emplace(playerlike::RunEnd{}).by = playerlike::RunEnd::By::kSignal;
  second.report.ended->signal = "SIGSEGV";
  const auto groups = figures_of(first, second);
  EXPECT_EQ(figure_named(groups, "r1", "goals reached").values.first, "1 of 2");
  EXPECT_EQ(figure_named(groups, "r1", "goals reached").values.second, "-");
  EXPECT_EQ(figure_named(groups, "", "end").values.first, "program ended, status 3");
  EXPECT_EQ(figure_named(groups, "", "end").values.second, "program killed by SIGSEGV");
}

}  // namespace
