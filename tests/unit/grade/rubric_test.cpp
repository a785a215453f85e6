// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "grade/rubric.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "grade/figures.h"
#include "grade/report.h"
#include "sim/core/error.h"
#include "sim/simulation/simulation.h"
#include "temporary_folder.h"

namespace playpen::grade {
namespace {

using nlohmann::json;
using test_support::TemporaryFolder;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;

/// Reads the task with the world a.json, the goal (1, 1), a map and this rubric.
Task task_with(const std::string& rubric) {
  const TemporaryFolder folder;
  folder.write("a.json", "{}");
  return read_task_text(
      R"({"worlds": ["a.json"], "map": "m", "goal": {"x": 1, "y": 1}, "rubric": )" + rubric + '}',
      folder / "test.task.json");
}

GradedRun run_with(const std::function<void(Measures&)>& change) {
  GradedRun run;
  run.world = "a";
  run.seed = 1;
  run.ending = Ending::kBySelf;
  change(run.measures);
  return run;
}

TEST(Rubric, NoRubric_HundredPointsForPassedRun) {
  Task task;
  GradedRun run;
  EXPECT_EQ(maximum_points(task), 100.0);
  EXPECT_EQ(points_of(task, run).total, 100.0);
  run.faults = {"late"};
  EXPECT_EQ(points_of(task, run).total, 0.0);
}

struct LinearCase {
  double best;
  double worst;
  double value;
  double points;  ///< of 10
};

TEST(Rubric, Linear_ExactAtBoundsAndClampedBeyond) {
  const LinearCase cases[] = {
      // Less is better.
      {1.1, 2.0, 0.9, 10.0},
      {1.1, 2.0, 1.1, 10.0},
      {1.1, 2.0, 1.55, 5.0},  // the middle of 0.9
      {1.1, 2.0, 2.0, 0.0},
      {1.1, 2.0, 2.1, 0.0},
      // More is better.
      {1.0, 0.6, 1.1, 10.0},
      {1.0, 0.6, 1.0, 10.0},
      {1.0, 0.6, 0.7, 2.5},  // 0.1 of 0.4
      {1.0, 0.6, 0.6, 0.0},
      {1.0, 0.6, 0.0, 0.0},
      // Bounds on both sides of 0.
      {5.0, -5.0, 0.0, 5.0},
      {-5.0, 5.0, -2.5, 7.5},
  };
  for (const LinearCase& c : cases) {
    const RubricItem item{.figure = "score", .points = 10.0, .best = c.best, .worst = c.worst};
    const GradedRun run = run_with([&c](Measures& m) { m.score = c.value; });
    const bool is_between = c.points > 0.0 && c.points < 10.0;
    EXPECT_NEAR(points_of(item, run), c.points, is_between ? 1e-12 : 0.0)
        << c.best << ' ' << c.worst << ' ' << c.value;
  }
}

TEST(Rubric, AtMostSteps_FirstThatHoldsCounts) {
  RubricItem item{.figure = "collisions"};
  item.steps = {{0.0, 10.0}, {2.0, 5.0}, {4.0, 7.0}};
  const std::vector<double> expected{10.0, 5.0, 5.0, 7.0, 7.0, 0.0};
  for (int collisions = 0; collisions < 6; ++collisions) {
    const GradedRun run = run_with([collisions](Measures& m) { m.collisions = collisions; });
    EXPECT_EQ(points_of(item, run), expected[static_cast<std::size_t>(collisions)]) << collisions;
  }
  EXPECT_EQ(maximum_points(item), 10.0);
}

TEST(Rubric, AtLeastSteps_FirstThatHoldsCounts) {
  RubricItem item{.figure = "distance", .limits_are_least = true};
  item.steps = {{20.0, 10.0}, {12.0, 6.0}};
  const std::pair<double, double> cases[] = {
      {20.1, 10.0}, {20.0, 10.0}, {19.9, 6.0}, {12.0, 6.0}, {11.9, 0.0}};
  for (const auto& [distance_m, points] : cases) {
    const double value_m = distance_m;
    const GradedRun run = run_with([value_m](Measures& m) { m.distance_m = value_m; });
    EXPECT_EQ(points_of(item, run), points) << distance_m;
  }
}

TEST(Rubric, YesOrNo_AllPointsOrNone) {
  for (const bool value : {true, false}) {
    const GradedRun run = run_with([value](Measures& m) {
      m.reached = value;
      m.verdict = value;
    });
    EXPECT_EQ(points_of({.figure = "reached", .points = 7.0}, run), value ? 7.0 : 0.0);
    EXPECT_EQ(points_of({.figure = "verdict", .points = 7.0}, run), value ? 7.0 : 0.0);
  }
  GradedRun run;
  EXPECT_EQ(points_of({.figure = "passed", .points = 7.0}, run), 7.0);
  run.faults = {"late"};
  EXPECT_EQ(points_of({.figure = "passed", .points = 7.0}, run), 0.0);
}

TEST(Rubric, FigureWithoutValue_NoPoints) {
  const GradedRun run;
  RubricItem steps{.figure = "collisions"};
  steps.steps = {{1000.0, 5.0}};
  EXPECT_EQ(points_of(steps, run), 0.0);
  EXPECT_EQ(points_of({.figure = "path_ratio", .points = 5.0, .best = 2.0, .worst = 3.0}, run),
            0.0);
  EXPECT_EQ(points_of({.figure = "reached", .points = 5.0}, run), 0.0);
}

TEST(Rubric, EveryFigure_GivesItsOwnMeasure) {
  double value = 1.0;
  for (const Figure& figure : kFigures) {
    if (is_yes_or_no(figure)) continue;
    value += 1.0;
    GradedRun run;
    if (const auto* member = std::get_if<std::optional<double> Measures::*>(&figure.member)) {
      run.measures.*(*member) = value;
    } else {
      run.measures.*(std::get<std::optional<int> Measures::*>(figure.member)) =
          static_cast<int>(value);
    }
    EXPECT_EQ(value_of(run.measures, figure), value) << figure.name;
    EXPECT_EQ(
        points_of(
            {.figure = std::string(figure.name), .points = 1000.0, .best = 1000.0, .worst = 0.0},
            run),
        value)
        << figure.name;
  }
}

TEST(Rubric, FailedRun_LosesItemsThatNeedPassing) {
  const Task task = task_with(R"([
    {"figure": "collisions", "steps": [{"at_most": 0, "points": 10}]},
    {"figure": "sim_time", "only_if_passed": true, "points": 20, "best": 10, "worst": 20}])");
  GradedRun run = run_with([](Measures& m) {
    m.collisions = 0;
    m.sim_time_s = 5.0;
  });
  EXPECT_EQ(points_of(task, run).total, 30.0);
  run.faults = {"late"};
  EXPECT_EQ(points_of(task, run).total, 10.0);
}

TEST(Rubric, Bonus_CountsAboveMaximum) {
  const Task task = task_with(R"([
    {"figure": "passed", "points": 50},
    {"figure": "sim_time", "name": "fast", "bonus": true, "steps": [{"at_most": 30, "points": 5}]}])");
  EXPECT_EQ(maximum_points(task), 50.0);
  const RunPoints points = points_of(task, run_with([](Measures& m) { m.sim_time_s = 30.0; }));
  EXPECT_EQ(points.total, 55.0);
  ASSERT_THAT(points.items, SizeIs(2));
  EXPECT_EQ(points.items[0].name, "passed");
  EXPECT_FALSE(points.items[0].is_bonus);
  EXPECT_EQ(points.items[1].name, "fast");
  EXPECT_EQ(points.items[1].points, 5.0);
  EXPECT_EQ(points.items[1].maximum, 5.0);
  EXPECT_TRUE(points.items[1].is_bonus);
}

TEST(Rubric, Mean_OverAllRuns) {
  Grade grade;
  EXPECT_EQ(mean_points(grade), 0.0);
  grade.runs.resize(4);
  grade.runs[0].faults = {"late"};
  EXPECT_EQ(mean_points(grade), 75.0);
}

TEST(Rubric, Settings_Read) {
  const Task task = task_with(R"([
    {"figure": "path_ratio", "name": "short path", "points": 10, "best": 1.1, "worst": 2},
    {"figure": "distance", "bonus": true, "only_if_passed": true,
     "steps": [{"at_least": 5, "points": 3}, {"at_least": 2, "points": 0}]}])");
  ASSERT_THAT(task.rubric, SizeIs(2));
  const RubricItem& linear = task.rubric[0];
  EXPECT_EQ(linear.name, "short path");
  EXPECT_EQ(linear.figure, "path_ratio");
  EXPECT_EQ(linear.points, 10.0);
  EXPECT_EQ(linear.best, 1.1);
  EXPECT_EQ(linear.worst, 2.0);
  EXPECT_THAT(linear.steps, IsEmpty());
  EXPECT_FALSE(linear.is_bonus);
  EXPECT_FALSE(linear.only_if_passed);
  const RubricItem& steps = task.rubric[1];
  EXPECT_EQ(steps.name, "distance");
  EXPECT_TRUE(steps.limits_are_least);
  EXPECT_TRUE(steps.is_bonus);
  EXPECT_TRUE(steps.only_if_passed);
  ASSERT_THAT(steps.steps, SizeIs(2));
  EXPECT_EQ(steps.steps[0].limit, 5.0);
  EXPECT_EQ(steps.steps[0].points, 3.0);
  EXPECT_EQ(steps.steps[1].limit, 2.0);
  EXPECT_EQ(steps.steps[1].points, 0.0);
}

/// An invalid rubric, and its expected message.
struct BadRubric {
  const char* name;
  const char* rubric;
  const char* id;
  const char* pointer;
  const char* expected;
  const char* found;  ///< a part of the whole message
};

void PrintTo(const BadRubric& bad, std::ostream* out) { *out << bad.name; }

const BadRubric kBadRubrics[] = {
    {"no_list", R"({"figure": "passed", "points": 1})", "world/wrong-type", "/rubric", "a list",
     "an object"},
    {"empty", "[]", "world/out-of-range", "/rubric", "at least one item", "an empty list"},
    {"only_bonuses", R"([{"figure": "passed", "points": 1, "bonus": true}])", "world/out-of-range",
     "/rubric", "not a bonus", "none"},
    {"no_points", R"([{"figure": "score", "steps": [{"at_most": 1, "points": 0}]}])",
     "world/out-of-range", "/rubric", "gives points", "none"},
    {"item_no_object", R"(["passed"])", "world/wrong-type", "/rubric/0", "an object", "\"passed\""},
    {"figure_missing", R"([{"points": 1}])", "world/missing-key", "/rubric/0", "\"figure\"",
     "none"},
    {"figure_unknown", R"([{"figure": "path_ration", "points": 1}])", "world/unknown-value",
     "/rubric/0/figure", "\"path_ratio\"", "did you mean \"path_ratio\"?"},
    {"figure_number", R"([{"figure": 3, "points": 1}])", "world/wrong-type", "/rubric/0/figure",
     "\"passed\"", "found 3"},
    {"unknown_key", R"([{"figure": "passed", "points": 1, "bonsu": true}])", "world/unknown-key",
     "/rubric/0/bonsu", "bonus", "did you mean \"bonus\"?"},
    {"name_number", R"([{"figure": "passed", "points": 1, "name": 1}])", "world/wrong-type",
     "/rubric/0/name", "a text", "found 1"},
    {"bonus_text", R"([{"figure": "passed", "points": 1, "bonus": "yes"}])", "world/wrong-type",
     "/rubric/0/bonus", "true or false", "\"yes\""},
    {"only_if_passed_number", R"([{"figure": "passed", "points": 1, "only_if_passed": 1}])",
     "world/wrong-type", "/rubric/0/only_if_passed", "true or false", "found 1"},
    {"points_missing", R"([{"figure": "passed"}])", "world/missing-key", "/rubric/0", "\"points\"",
     "none"},
    {"points_zero", R"([{"figure": "passed", "points": 0}])", "world/out-of-range",
     "/rubric/0/points", "greater than 0", "found 0"},
    {"points_huge", R"([{"figure": "passed", "points": 1e7}])", "world/out-of-range",
     "/rubric/0/points", "at most 1000000", "1e7"},
    {"bounds_of_yes_or_no", R"([{"figure": "reached", "points": 1, "best": 1}])",
     "world/unknown-key", "/rubric/0/best", "points", "\"reached\" is true or false"},
    {"steps_of_yes_or_no", R"([{"figure": "passed", "points": 1, "steps": []}])",
     "world/unknown-key", "/rubric/0/steps", "points", "\"passed\" is true or false"},
    {"kind_missing", R"([{"figure": "path_ratio", "points": 10}])", "world/missing-key",
     "/rubric/0", "\"steps\", or \"best\" and \"worst\"", "\"path_ratio\" is a number"},
    {"linear_points_missing", R"([{"figure": "path_ratio", "best": 1, "worst": 2}])",
     "world/missing-key", "/rubric/0", "\"points\"", "none"},
    {"best_missing", R"([{"figure": "path_ratio", "points": 10, "worst": 2}])", "world/missing-key",
     "/rubric/0", "\"best\"", "none"},
    {"worst_missing", R"([{"figure": "path_ratio", "points": 10, "best": 2}])", "world/missing-key",
     "/rubric/0", "\"worst\"", "none"},
    {"bounds_equal", R"([{"figure": "path_ratio", "points": 10, "best": 2, "worst": 2.0}])",
     "world/out-of-range", "/rubric/0/worst", "another number than \"best\"", "use \"steps\""},
    {"best_text", R"([{"figure": "path_ratio", "points": 10, "best": "1", "worst": 2}])",
     "world/wrong-type", "/rubric/0/best", "a number", "\"1\""},
    {"steps_number", R"([{"figure": "collisions", "steps": 3}])", "world/wrong-type",
     "/rubric/0/steps", "a list", "found 3"},
    {"steps_empty", R"([{"figure": "collisions", "steps": []}])", "world/out-of-range",
     "/rubric/0/steps", "at least one step", "an empty list"},
    {"step_number", R"([{"figure": "collisions", "steps": [3]}])", "world/wrong-type",
     "/rubric/0/steps/0", "an object", "found 3"},
    {"step_limit_missing", R"([{"figure": "collisions", "steps": [{"points": 3}]}])",
     "world/missing-key", "/rubric/0/steps/0", "\"at_most\" or \"at_least\"", "none"},
    {"step_two_limits",
     R"([{"figure": "collisions", "steps": [{"at_most": 0, "at_least": 0, "points": 3}]}])",
     "world/unknown-key", "/rubric/0/steps/0/at_least", "at_most or points", "at_least"},
    {"step_points_missing", R"([{"figure": "collisions", "steps": [{"at_most": 3}]}])",
     "world/missing-key", "/rubric/0/steps/0", "\"points\"", "none"},
    {"step_points_negative",
     R"([{"figure": "collisions", "steps": [{"at_most": 3, "points": -1}]}])", "world/out-of-range",
     "/rubric/0/steps/0/points", "from 0", "-1"},
    {"step_other_limit",
     R"([{"figure": "collisions",
          "steps": [{"at_most": 0, "points": 3}, {"at_least": 3, "points": 1}]}])",
     "world/missing-key", "/rubric/0/steps/1", "\"at_most\"", "the steps of an item"},
    {"step_at_most_not_above",
     R"([{"figure": "collisions",
          "steps": [{"at_most": 2, "points": 3}, {"at_most": 2, "points": 1}]}])",
     "task/unused-step", "/rubric/0/steps/1/at_most", "more than 2", "found 2"},
    {"step_at_least_not_below",
     R"([{"figure": "distance",
          "steps": [{"at_least": 2, "points": 1}, {"at_least": 3, "points": 3}]}])",
     "task/unused-step", "/rubric/0/steps/1/at_least", "less than 2", "found 3"},
    {"points_beside_steps",
     R"([{"figure": "collisions", "points": 3, "steps": [{"at_most": 0, "points": 3}]}])",
     "world/unknown-key", "/rubric/0/points", "steps", "each step has its own points"},
};

class BadRubricTest : public testing::TestWithParam<BadRubric> {};

TEST_P(BadRubricTest, RefusedWithIdPlaceAndReason) {
  const BadRubric& bad = GetParam();
  try {
    static_cast<void>(task_with(bad.rubric));
    FAIL() << "accepted";
  } catch (const sim::ConfigError& error) {
    ASSERT_THAT(error.issues(), SizeIs(1)) << error.what();
    const sim::ConfigIssue& issue = error.issues().front();
    EXPECT_EQ(issue.id, bad.id);
    EXPECT_EQ(issue.pointer, bad.pointer);
    EXPECT_THAT(issue.expected, HasSubstr(bad.expected));
    EXPECT_THAT(issue.message(), HasSubstr(bad.found));
  }
}

INSTANTIATE_TEST_SUITE_P(Faults, BadRubricTest, testing::ValuesIn(kBadRubrics),
                         [](const testing::TestParamInfo<BadRubric>& bad) {
                           return std::string(bad.param.name);
                         });

TEST(Rubric, FigureThatTaskCannotHave_Refused) {
  const TemporaryFolder folder;
  folder.write("a.json", "{}");
  const std::pair<const char*, const char*> cases[] = {{"coverage", "task/missing-map"},
                                                       {"seen", "task/missing-map"},
                                                       {"goal_distance", "task/missing-goal"},
                                                       {"path_ratio", "task/missing-goal"}};
  for (const auto& [figure, id] : cases) {
    try {
      static_cast<void>(read_task_text(R"({"worlds": ["a.json"], "rubric": [{"figure": ")" +
                                           std::string(figure) +
                                           R"(", "points": 1, "best": 1, "worst": 0}]})",
                                       folder / "test.task.json"));
      ADD_FAILURE() << figure;
    } catch (const sim::ConfigError& error) {
      ASSERT_THAT(error.issues(), SizeIs(1)) << error.what();
      EXPECT_EQ(error.issues().front().id, id);
      EXPECT_EQ(error.issues().front().pointer, "/rubric/0/figure");
    }
  }
}

TEST(Rubric, WorldWithoutGoalOrController_Refused) {
  const sim::WorldDescription world = sim::load_world_text("{}");
  const auto issue_of = [&world](const char* figure) {
    Task task;
    task.rubric = {{.figure = figure, .points = 1.0, .best = 1.0, .worst = 0.0}};
    try {
      static_cast<void>(make_reference(task, {"a.json", {}, {}}, world));
    } catch (const sim::ConfigError& error) {
      return error.issues().front().id;
    }
    return std::string();
  };
  EXPECT_EQ(issue_of("path_ratio"), "task/missing-goal");
  EXPECT_EQ(issue_of("score"), "task/missing-controller");
  EXPECT_EQ(issue_of("verdict"), "task/missing-controller");
  EXPECT_EQ(issue_of("distance"), "");
}

/// A grade with a passed and a failed run.
Grade grade_with_rubric() {
  Grade grade;
  grade.task = task_with(R"([
    {"figure": "passed", "points": 50},
    {"figure": "sim_time", "name": "fast", "bonus": true, "points": 10, "best": 10, "worst": 50}])");
  grade.task.name = "explore";
  GradedRun run = run_with([](Measures& m) { m.sim_time_s = 20.0; });
  grade.runs.push_back(run);
  run.seed = 2;
  run.faults = {"late"};
  grade.runs.push_back(run);
  return grade;
}

TEST(RubricReport, Table_HasPointsOfRunsAndItems) {
  // (50 - 20) / (50 - 10) of 10 points are 7.5.
  EXPECT_EQ(table(grade_with_rubric()),
            "world  seed        end        points   sim  wall\n"
            "a         1  pass  by itself   57.50  20.0   0.0\n"
            "a         2  FAIL  by itself    7.50  20.0   0.0\n"
            "a seed 2: late\n"
            "explore: 1 of 2 runs passed\n"
            "  points: 7.50 to 57.50, mean 32.50 of 50\n"
            "    passed: mean 25.00 of 50\n"
            "    fast: mean 7.50 of 10 (bonus)\n"
            "  simulated time [s]: 20.0 to 20.0, mean 20.0\n");
}

TEST(RubricReport, OneRun_HasItsPoints) {
  Grade grade = grade_with_rubric();
  grade.runs.pop_back();
  EXPECT_THAT(table(grade), HasSubstr("explore: 1 of 1 runs passed\n"
                                      "  points: 57.50 of 50\n"
                                      "    passed: 50.00 of 50\n"
                                      "    fast: 7.50 of 10 (bonus)\n"));
}

TEST(RubricReport, Json_HasPointsOfRunsAndMean) {
  const json whole = json::parse(json_text(grade_with_rubric()));
  EXPECT_EQ(whole.at("summary").at("points"),
            json({{"min", 7.5}, {"mean", 32.5}, {"max", 57.5}, {"maximum", 50.0}}));
  EXPECT_EQ(whole.at("runs").at(0).at("points"), json::parse(R"({
    "total": 57.5, "maximum": 50.0,
    "items": [{"name": "passed", "points": 50.0, "maximum": 50.0, "bonus": false},
              {"name": "fast", "points": 7.5, "maximum": 10.0, "bonus": true}]})"));
  EXPECT_EQ(whole.at("runs").at(1).at("points").at("total"), 7.5);
}

TEST(RubricReport, NoRubric_NoPoints) {
  Grade grade = grade_with_rubric();
  grade.task.rubric.clear();
  EXPECT_THAT(table(grade), Not(HasSubstr("points")));
  EXPECT_THAT(json_text(grade), Not(HasSubstr("points")));
}

TEST(RubricReport, NoRuns_NoPoints) {
  Grade grade = grade_with_rubric();
  grade.runs.clear();
  EXPECT_THAT(table(grade), Not(HasSubstr("points")));
  EXPECT_FALSE(json::parse(json_text(grade)).at("summary").contains("points"));
}

TEST(RubricSchema, KnowsFiguresOfReader) {
  std::ifstream stream(std::string(PLAYPEN_SOURCE_DIR) + "/worlds/schema/task.schema.json");
  const json definitions = json::parse(stream).at("$defs");
  std::set<std::string> yes_or_no{"passed", "verdict"};
  std::set<std::string> all = yes_or_no;
  for (const Figure& figure : kFigures) {
    all.emplace(figure.name);
    if (is_yes_or_no(figure)) yes_or_no.emplace(figure.name);
  }
  EXPECT_EQ(definitions.at("rubric_item").at("properties").at("figure").at("enum"), json(all));
  EXPECT_EQ(definitions.at("yes_or_no").at("enum"), json(yes_or_no));
}

TEST(GradingPage, Examples_AreTasks) {
  const TemporaryFolder folder;
  for (const char* world :
       {"empty.json", "maze.json", "par_planning.json", "par_planning_2.json"}) {
    folder.write(world, "{}");
  }
  const std::string page =
      test_support::read_bytes(std::string(PLAYPEN_SOURCE_DIR) + "/docs/grading.md");
  const std::string fence = "```json\n";
  int tasks = 0;
  bool any_rubric = false;
  for (std::size_t at = page.find(fence); at != std::string::npos; at = page.find(fence, at)) {
    at += fence.size();
    const Task task =
        read_task_text(page.substr(at, page.find("```", at) - at), folder / "page.task.json");
    any_rubric |= !task.rubric.empty();
    ++tasks;
  }
  EXPECT_GE(tasks, 2);
  EXPECT_TRUE(any_rubric);
}

}  // namespace
}  // namespace playpen::grade
