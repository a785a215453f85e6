// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "grade/evaluation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "grade/map_score.h"
#include "sim/core/base64.h"
#include "sim/core/error.h"
#include "sim/core/number_text.h"
#include "sim/io/map_file.h"
#include "sim/simulation/simulation.h"
#include "sim/simulation/world_hash.h"
#include "temporary_folder.h"

namespace playpen::grade {
namespace {

using nlohmann::json;
using playerlike::JobEnd;
using test_support::TemporaryFolder;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;
using testing::UnorderedElementsAre;

/// A room of 2 m x 2 m with a robot at the centre of its left half.
sim::WorldDescription room(const std::string& obstacles = "") {
  return sim::load_world_text(R"({"arena": {"size": [2, 2], "obstacles": [)" + obstacles + R"(]},
    "simulation": {"duration": 60},
    "robots": [{"name": "a", "pose": {"x": 0.5, "y": 1}},
               {"name": "b", "pose": {"x": 1.5, "y": 1.5}}]})");
}

Task task_with_goal(double x, double y) {
  Task task;
  task.name = "test";
  task.file = "test.task.json";
  task.goal = Goal{{x, y}, std::nullopt};
  return task;
}

TEST(MakeReference, FirstRobotUnlessNamed) {
  Task task;
  EXPECT_EQ(make_reference(task, {"w/room.json", {}, {}}, room()).robot, "a");
  task.robot = "b";
  const Reference reference = make_reference(task, {"w/room.json", {}, {}}, room());
  EXPECT_EQ(reference.robot, "b");
  EXPECT_EQ(reference.world, "room");
  EXPECT_EQ(reference.start, sim::Vec2(1.5, 1.5));
  EXPECT_EQ(reference.duration_s, 60.0);
  EXPECT_TRUE(reference.truth.cells.empty()) << "nobody asks for a map";
  task.duration_s = 7.0;
  EXPECT_EQ(make_reference(task, {"", {}, {}}, room()).duration_s, 7.0);
}

TEST(MakeReference, EmptyRoom_ShortestPathIsStraight) {
  const Reference reference = make_reference(task_with_goal(1.5, 1.0), {}, room());
  ASSERT_TRUE(reference.shortest_path_m);
  EXPECT_NEAR(*reference.shortest_path_m, 1.0, 1e-4);  // ends are rounded to 1/1024 of 2 cm
}

TEST(MakeReference, ShortestPath_KeepsInscribedRadius) {
  // A wall in the middle, from the bottom up to y = 1.4. The axle's centre stays 0.081 m away (half
  // of the robot's width), so the path follows an arc around the wall's corners (0.95, 1.4) and
  // (1.05, 1.4).
  const Reference reference =
      make_reference(task_with_goal(1.5, 1.0), {},
                     room(R"({"name": "w", "center": [1, 0.7], "size": [0.1, 1.4]})"));
  const double radius = 0.081;
  const double to_corner = std::hypot(0.45, 0.4);
  const double tangent = std::sqrt(to_corner * to_corner - radius * radius);
  // The angle from the tangent's direction to the horizontal.
  const double turn = std::atan2(0.4, 0.45) + std::asin(radius / to_corner);
  const double exact = 2.0 * (tangent + radius * turn) + 0.1;
  ASSERT_TRUE(reference.shortest_path_m);
  // The round corner consists of cells of 2 cm, and the wall's sides lie inside cells.
  EXPECT_NEAR(*reference.shortest_path_m, exact, 0.05);
}

TEST(MakeReference, GoalOfWorld_OverridesThatOfTask) {
  const TaskWorld world{"", {}, Goal{{0.5, 1.7}, std::nullopt}};
  const Reference reference = make_reference(task_with_goal(1.5, 1.0), world, room());
  EXPECT_NEAR(reference.shortest_path_m.value_or(0.0), 0.7, 1e-4);
}

TEST(MakeReference, ConflictingSettings_Refused) {
  const auto id_of = [](const Task& task, const sim::WorldDescription& world) {
    try {
      static_cast<void>(make_reference(task, {"room.json", {}, {}}, world));
    } catch (const sim::ConfigError& error) {
      return error.issues().front().id;
    }
    return std::string();
  };
  Task unknown_robot;
  unknown_robot.robot = "c";
  EXPECT_EQ(id_of(unknown_robot, room()), "task/unknown-robot");
  EXPECT_EQ(id_of({}, sim::load_world_text(R"({"robots": []})")), "task/unknown-robot");
  Task no_goal;
  no_goal.thresholds.must_reach = true;
  EXPECT_EQ(id_of(no_goal, room()), "task/missing-goal");
  EXPECT_EQ(id_of(task_with_goal(3.0, 1.0), room()), "task/unreachable-goal");
  // A wall from side to side; then one with a gap of 0.15 m, too narrow for a width of 0.162 m.
  for (const char* wall : {R"({"name": "w", "center": [1, 1], "size": [0.1, 2]})",
                           R"({"name": "w", "center": [1, 0.925], "size": [0.1, 1.85]})"}) {
    EXPECT_EQ(id_of(task_with_goal(1.5, 1.0), room(wall)), "task/unreachable-goal") << wall;
  }
  EXPECT_EQ(id_of(task_with_goal(1.5, 1.0),
                  room(R"({"name": "w", "center": [1, 0.85], "size": [0.1, 1.7]})")),
            "");
}

TEST(MakeReference, PointsAndVerdicts_NeedController) {
  const auto issues_of = [](const Task& task, const std::string& controller) {
    const auto world =
        sim::load_world_text(R"({"arena": {"size": [2, 2]}, "robots": [{}])" + controller + "}");
    try {
      static_cast<void>(make_reference(task, {"room.json", {}, {}}, world));
    } catch (const sim::ConfigError& error) {
      return error.issues().front().message();
    }
    return std::string();
  };
  Task passes;
  passes.thresholds.must_pass = true;
  Task scores;
  scores.thresholds.min_score = 1.0;
  EXPECT_THAT(issues_of(passes, ""), AllOf(HasSubstr("controller"), HasSubstr("none in \"room\""),
                                           HasSubstr("must_pass")));
  EXPECT_THAT(issues_of(scores, ""), HasSubstr("min_score"));
  for (const Task& task : {passes, scores}) {
    EXPECT_EQ(issues_of(task, R"(, "controller": {"timers": [{"name": "end", "at": 5}]})"), "");
  }
}

/// "seen" of a report's robot that has seen the cells of the room for which is_seen(centre) is
/// true.
json seen_floor(const std::function<bool(const sim::Vec2&)>& is_seen) {
  constexpr int kCells = 100;  // of 2 cm, along each side
  std::vector<std::uint8_t> bits((kCells * kCells + 7) / 8, 0);
  for (int i = 0; i < kCells * kCells; ++i) {
    const sim::Vec2 centre(0.02 * (i % kCells + 0.5), 0.02 * (i / kCells + 0.5));
    if (!is_seen(centre)) continue;
    bits[static_cast<std::size_t>(i / 8)] |= static_cast<std::uint8_t>(0x80 >> (i % 8));
  }
  return {{"cell_size", 0.02}, {"x", 0.0},         {"y", 0.0},
          {"width", kCells},   {"height", kCells}, {"cells", sim::to_base64(bits)}};
}

/// Runs in a separate folder, on the room with a goal at (1.5, 1).
class EvaluateTest : public testing::Test {
 protected:
  void write_report(const json& changes = json::object(), double sim_time_s = 20.0,
                    const json& of_controller = json::object()) const {
    json robot = {{"name", "a"},
                  {"path_length", 1.25},
                  {"collisions", 2},
                  {"least_clearance", 0.0},
                  {"stalled_time", 0.5},
                  {"final_pose", {{"x", 1.45}, {"y", 1.0}, {"yaw", 3.0}}},
                  {"seen", seen_floor([](const sim::Vec2&) { return true; })}};
    robot.update(changes);
    json other = robot;
    other["name"] = "b";
    other["path_length"] = 99.0;
    json report = {{"run", {{"sim_time", sim_time_s}, {"steps", steps_}}},
                   {"robots", {other, robot}},
                   {"ended", {{"by", "program"}}}};
    report.update(of_controller);
    folder_.write("report.json", playerlike::signed_report(report.dump(), signed_as_));
  }

  [[nodiscard]] GradedRun evaluated(const JobEnd& end = {JobEnd::Kind::kEnded, {}, 1.5}) const {
    GradedRun run;
    run.world = "room";
    run.seed = 3;
    run.asked = asked_;
    evaluate(task_, make_reference(task_, {}, room()), end, folder_.path(), completed_, run);
    return run;
  }

  TemporaryFolder folder_;
  Task task_ = task_with_goal(1.5, 1.0);
  playerlike::Grading asked_ = playerlike::grading_of("the run's nonce", {}, room());
  playerlike::Grading signed_as_ = asked_;
  int steps_ = 2000;
  bool completed_ = false;
};

TEST_F(EvaluateTest, ReportOfOtherRun_Refused) {
  const auto fault_with = [this](const auto& edit) {
    signed_as_ = asked_;
    edit();
    write_report();
    const GradedRun run = evaluated();
    EXPECT_EQ(run.measures.path_length_m.has_value(), run.passed());
    return run.passed() ? "" : run.faults.front();
  };
  EXPECT_EQ(fault_with([] {}), "");
  EXPECT_THAT(fault_with([this] { signed_as_.nonce = "another"; }), HasSubstr("of another run"));
  EXPECT_THAT(fault_with([this] { signed_as_.nonce = ""; }), HasSubstr("not signed"));
  EXPECT_THAT(fault_with([this] {
                signed_as_.world += 1;
                signed_as_.world_name = "easy";
              }),
              HasSubstr("ran the world \"easy\""));
  EXPECT_THAT(fault_with([this] { signed_as_.seed = 9; }), HasSubstr("seed 9, not with 1"));
  EXPECT_THAT(fault_with([this] { signed_as_.duration_s = 0.5; }),
              HasSubstr("a duration of 0.5 s, not of 60 s"));
  EXPECT_THAT(fault_with([this] { signed_as_.duration_s.reset(); }),
              HasSubstr("no limit, not of 60 s"));
  EXPECT_THAT(fault_with([this] { signed_as_.time = "2"; }),
              HasSubstr("the time 2, not with lockstep"));
  EXPECT_THAT(fault_with([this] { signed_as_.realism = "ideal"; }),
              HasSubstr("the realism ideal, not with course"));
  EXPECT_THAT(fault_with([this] { steps_ = 0; }), HasSubstr("never stepped"));
  EXPECT_THAT(fault_with([this] {
                steps_ = 2000;
                signed_as_.rules.may_use = playerlike::MayUse{{"a", "b"}, {}, {"map"}};
              }),
              HasSubstr("other rules than those of the task"));
}

TEST_F(EvaluateTest, EditedReport_Refused) {
  constexpr const char* kCollisions = "\"collisions\": 2";
  for (const char* edited : {"\"collisions\": 0", "\"praise\": 1, \"collisions\": 2"}) {
    write_report();
    std::string text = test_support::read_bytes(folder_ / "report.json");
    const std::size_t at = text.find(kCollisions);
    ASSERT_NE(at, std::string::npos);
    text.replace(at, std::strlen(kCollisions), edited);
    folder_.write("report.json", text);
    EXPECT_THAT(evaluated().faults, ElementsAre("report.json was changed after the run had ended"))
        << edited;
  }
}

TEST_F(EvaluateTest, PointsAndVerdict_FromController) {
  task_.thresholds.must_pass = true;
  task_.thresholds.min_score = 3.0;
  const auto room_with_controller = [] {
    sim::WorldDescription world = room();
    world.controller.timers.emplace_back();
    return world;
  };
  const auto graded = [&](const json& of_controller, double sim_time_s) {
    write_report(json::object(), sim_time_s, of_controller);
    GradedRun run;
    run.asked = asked_;
    evaluate(task_, make_reference(task_, {}, room_with_controller()),
             {JobEnd::Kind::kEnded, {}, 1.5}, folder_.path(), false, run);
    return run;
  };
  const json scores = {{"a", 4.0}, {"b", 99.0}};
  const GradedRun passed =
      graded({{"scores", scores},
              {"verdict", {{"passed", true}, {"reason", "at the goal"}, {"time", 20.0}}}},
             20.0);
  EXPECT_THAT(passed.faults, IsEmpty());
  EXPECT_EQ(passed.ending, Ending::kVerdict);
  EXPECT_EQ(name_of(passed.ending), "verdict");
  EXPECT_EQ(passed.measures.score, 4.0);
  EXPECT_EQ(passed.measures.verdict, true);
  EXPECT_EQ(passed.measures.verdict_reason, "at the goal");

  task_.thresholds.must_end = true;
  const GradedRun failed =
      graded({{"scores", {{"a", -1.0}}},
              {"verdict", {{"passed", false}, {"reason", "no points are left"}, {"time", 60.0}}}},
             60.0);
  EXPECT_THAT(failed.faults,
              ElementsAre("verdict: failed: no points are left", "score -1, at least 3 needed"));
  EXPECT_EQ(failed.ending, Ending::kVerdict) << "also at the end of the simulated time";

  const GradedRun neither = graded({{"scores", scores}, {"verdict", nullptr}}, 60.0);
  EXPECT_THAT(neither.faults,
              ElementsAre("the simulated time was over before the program ended",
                          "no verdict: the world's controller did not end the run"));
  EXPECT_EQ(neither.ending, Ending::kTimeOver);

  const GradedRun broken = graded({{"scores", json::object()}, {"verdict", nullptr}}, 20.0);
  EXPECT_THAT(broken.faults, ElementsAre(HasSubstr("the report is not as expected")));
}

// The path is 1 m long; the goal is reached 0.1 m before its end.
TEST_F(EvaluateTest, ImpossiblyShortPath_Refused) {
  write_report({{"path_length", 0.9}});
  EXPECT_TRUE(evaluated().passed());
  write_report({{"path_length", 0.01}});
  EXPECT_THAT(evaluated().faults, ElementsAre(HasSubstr("path of 0.01 m, which is shorter than any "
                                                        "way to the goal (1.00 m)")));
}

TEST(WorldHash, DistinguishesWorldsButNotSeedsAndFiles) {
  const std::uint64_t plain = sim::world_hash(room());
  sim::WorldDescription same = room();
  same.file = "other.json";
  same.simulation.seed = 77;
  same.simulation.duration_ns.reset();
  same.canvas.view_mode = sim::ViewMode::kFullScreen;
  EXPECT_EQ(sim::world_hash(same), plain);
  const auto hash_with = [](const auto& edit) {
    sim::WorldDescription world = room();
    edit(world);
    return sim::world_hash(world);
  };
  const std::vector<std::uint64_t> others = {
      plain,
      hash_with([](auto& w) { w.name = "b"; }),
      hash_with([](auto& w) { w.arena.size.x() = 2.1; }),
      hash_with([](auto& w) { w.arena.obstacles.emplace_back(); }),
      hash_with([](auto& w) { w.robots[0].pose.x_m = 0.51; }),
      hash_with([](auto& w) { w.robots[1].pose.x_m = 0.51; }),
      hash_with([](auto& w) { w.robots.pop_back(); }),
      hash_with([](auto& w) { w.robots[0].devices.pop_back(); }),
      hash_with([](auto& w) { w.simulation.objects_locked = true; }),
      hash_with([](auto& w) { w.simulation.step_ns *= 2; }),
      hash_with([](auto& w) { w.simulation.realism = sim::Realism::kIdeal; }),
      hash_with([](auto& w) { w.simulation.realism = sim::Realism::kReal; }),
      hash_with([](auto& w) {
        w.simulation.realism = sim::Realism::kReal;
        w.robots[0].devices[0].given = {"noise"};
      }),
      hash_with([](auto& w) {
        w.arena.walls = {{{{0, 0}, {1, 0}, {0, 1}}}};
      }),
      sim::world_hash(
          sim::load_world_text(R"({"robots": [{"devices": {"laser": {"noise": 0.01}}}]})")),
      sim::world_hash(
          sim::load_world_text(R"({"robots": [{"devices": {"laser": {"noise": 0.02}}}]})")),
  };
  EXPECT_EQ(std::set(others.begin(), others.end()).size(), others.size());
}

TEST_F(EvaluateTest, Figures_FromJudgedRobot) {
  write_report();
  const GradedRun run = evaluated();
  EXPECT_TRUE(run.passed()) << "no thresholds, no faults";
  EXPECT_EQ(run.ending, Ending::kBySelf);
  EXPECT_EQ(run.wall_time_s, 1.5);
  const Measures& m = run.measures;
  EXPECT_EQ(m.path_length_m, 1.25);
  EXPECT_EQ(m.collisions, 2);
  EXPECT_EQ(m.least_clearance_m, 0.0);
  EXPECT_EQ(m.stalled_time_s, 0.5);
  EXPECT_EQ(m.sim_time_s, 20.0);
  EXPECT_EQ(m.reached, true);
  EXPECT_NEAR(m.goal_distance_m.value_or(-1.0), 0.05, 1e-12);
  EXPECT_NEAR(m.shortest_path_m.value_or(-1.0), 1.0, 1e-4);
  EXPECT_NEAR(m.path_ratio.value_or(-1.0), 1.25, 1e-3);
  EXPECT_FALSE(m.coverage);
  EXPECT_FALSE(m.correctness);
}

TEST_F(EvaluateTest, Goal_ReachedWithinTolerances) {
  write_report();
  task_.goal->tolerance_m = 0.04;
  EXPECT_EQ(evaluated().measures.reached, false);
  EXPECT_FALSE(evaluated().measures.path_ratio) << "a way that leads elsewhere may be short";
  task_.goal->tolerance_m = 0.06;
  EXPECT_EQ(evaluated().measures.reached, true);
  // The robot's heading is 3 rad; -3.1 rad is 0.18 rad farther.
  task_.goal->yaw_rad = -3.1;
  task_.goal->yaw_tolerance_rad = 0.15;
  EXPECT_EQ(evaluated().measures.reached, false);
  task_.goal->yaw_tolerance_rad = 0.2;
  EXPECT_EQ(evaluated().measures.reached, true);
}

TEST_F(EvaluateTest, DistinguishesEndings) {
  write_report();
  EXPECT_EQ(evaluated().ending, Ending::kBySelf);
  write_report(json::object(), 60.0);
  EXPECT_EQ(evaluated().ending, Ending::kTimeOver);
  EXPECT_TRUE(evaluated().passed());

  const GradedRun bad = evaluated({JobEnd::Kind::kEnded, {.status = 3, .signal = {}}, 0.0});
  EXPECT_EQ(bad.ending, Ending::kBadStatus);
  EXPECT_EQ(bad.status, 3);
  EXPECT_THAT(bad.faults, ElementsAre("the program ended with status 3"));
  const GradedRun crashed =
      evaluated({JobEnd::Kind::kEnded, {.status = 0, .signal = SIGSEGV}, 0.0});
  EXPECT_EQ(crashed.ending, Ending::kSignal);
  EXPECT_EQ(crashed.signal, SIGSEGV);
  EXPECT_THAT(crashed.faults, ElementsAre(HasSubstr("signal 11")));
  task_.timeout_s = 2.5;
  // It does not help that the program then ended well on SIGTERM.
  const GradedRun late = evaluated({JobEnd::Kind::kTimedOut, {}, 2.6});
  EXPECT_EQ(late.ending, Ending::kTimedOut);
  EXPECT_THAT(late.faults, ElementsAre("timeout: still running after 2.5 s"));
  EXPECT_EQ(evaluated({JobEnd::Kind::kInterrupted, {}, 1.0}).ending, Ending::kInterrupted);
  const GradedRun not_run = evaluated({JobEnd::Kind::kNotStarted, {}, 0.0});
  EXPECT_EQ(not_run.ending, Ending::kNotRun);
  EXPECT_FALSE(not_run.passed());
  EXPECT_FALSE(not_run.measures.path_length_m) << "the report is not this run's";
}

TEST_F(EvaluateTest, MissingOrBrokenReport_IsFault) {
  task_.thresholds.max_collisions = 0;
  EXPECT_THAT(evaluated().faults, ElementsAre(HasSubstr("never connected")));
  for (const char* text : {"", "{", "{\"graded\": 7}", "{\"graded\": {\"nonce\": 1}}"}) {
    folder_.write("report.json", text);
    EXPECT_THAT(evaluated().faults, ElementsAre(HasSubstr("not as expected"))) << text;
  }
  for (const char* text : {"[]", "7", "{\"run\": {}}", "{\"run\": 7, \"robots\": 8}"}) {
    folder_.write("report.json", text);
    EXPECT_THAT(evaluated().faults, ElementsAre(HasSubstr("not signed"))) << text;
  }
  write_report({{"name", "c"}});
  EXPECT_THAT(evaluated().faults, ElementsAre("the report has no robot a",
                                              "collisions not measured, at most 0 allowed"));
  write_report({{"least_clearance", nullptr}});  // nothing solid anywhere
  EXPECT_FALSE(evaluated().measures.least_clearance_m);
  // A program that crashed gets no additional message about the report.
  folder_.write("report.json", "");
  EXPECT_THAT(evaluated({JobEnd::Kind::kEnded, {.status = 0, .signal = SIGABRT}, 0.0}).faults,
              SizeIs(1));
}

TEST_F(EvaluateTest, Map_ScoredOnNamedLayer) {
  write_report();
  task_.map_layer = "occupancy";
  task_.thresholds.min_coverage = 0.98;
  EXPECT_THAT(evaluated().faults,
              UnorderedElementsAre("no map: there is no layers/occupancy.yaml",
                                   "coverage not measured, at least 0.98 needed"));
  folder_.write("layers/occupancy.yaml", "nonsense");
  EXPECT_THAT(evaluated().faults, testing::Contains(HasSubstr("the map can't be read")));

  // The true map, with its lower half unknown.
  sim::OccupancyMap map = make_truth(room().arena);
  sim::io::write_map(map, folder_ / "layers/occupancy");
  const GradedRun good = evaluated();
  EXPECT_THAT(good.faults, IsEmpty());
  EXPECT_EQ(good.measures.coverage, 1.0);
  EXPECT_EQ(good.measures.correctness, 1.0);
  for (std::size_t i = map.cells.size() / 2; i < map.cells.size(); ++i) map.cells[i] = 0.5F;
  sim::io::write_map(map, folder_ / "layers/occupancy");
  const GradedRun half = evaluated();
  EXPECT_EQ(half.measures.coverage, 0.5);
  EXPECT_EQ(half.measures.correctness, 1.0);
  EXPECT_THAT(half.faults, ElementsAre("coverage 0.500, at least 0.98 needed"));
}

// A block divides the room into halves.
TEST_F(EvaluateTest, Map_ScoredByBlocksAtEnd) {
  const auto divided = [](const char* state) {
    return room(
        R"({"name": "d", "center": [1, 1], "size": [0.1, 2], "type": "dynamic", "state": ")" +
        std::string(state) + "\"}");
  };
  task_ = Task();
  task_.map_layer = "occupancy";
  const auto measured = [&](const char* at_start, const char* at_end, const json& events) {
    write_report(json::object(), 20.0, {{"events", events}, {"blocks", {{"d", at_end}}}});
    GradedRun run;
    run.asked = asked_;
    evaluate(task_, make_reference(task_, {}, divided(at_start)), {JobEnd::Kind::kEnded, {}, 1.5},
             folder_.path(), false, run);
    return run.measures;
  };
  const json sank = {{{"kind", "retracted"}, {"what", "d"}}};
  folder_.write("layers/occupancy.yaml", "");  // makes the folder
  // The map shows the left half, the block, and nothing of the right half.
  sim::OccupancyMap map = make_truth(divided("extended").arena);
  for (int row = 0; row < map.height; ++row) {
    for (int column = map.width / 2 + 3; column < map.width; ++column) {
      map.cells[static_cast<std::size_t>(row * map.width + column)] = 0.5F;
    }
  }
  sim::io::write_map(map, folder_ / "layers/occupancy");
  const Measures closed = measured("extended", "extended", json::array());
  EXPECT_EQ(closed.coverage, 1.0) << "the right half was never within reach";
  EXPECT_EQ(closed.correctness, 1.0);
  for (const Measures& m :
       {measured("extended", "extended", sank), measured("retracted", "rising", json::array())}) {
    EXPECT_NEAR(m.coverage.value_or(0.0), 0.5, 0.01) << "the block was open for a while";
    EXPECT_EQ(m.correctness, 1.0);
  }
  const Measures open = measured("extended", "waiting", json::array());
  EXPECT_LT(open.coverage.value_or(1.0), 0.49) << "the place of the block is free at the end";
  EXPECT_LT(open.correctness.value_or(1.0), 1.0);

  write_report(json::object(), 20.0, {{"blocks", {{"d", "extended"}}}});
  GradedRun run;
  run.asked = asked_;
  evaluate(task_, make_reference(task_, {}, divided("extended")), {JobEnd::Kind::kEnded, {}, 1.5},
           folder_.path(), false, run);
  EXPECT_THAT(run.faults, ElementsAre(HasSubstr("the report is not as expected")));
}

TEST_F(EvaluateTest, UnseenFloor_DoesNotCount) {
  task_.map_layer = "occupancy";
  task_.thresholds.min_coverage = 0.98;
  folder_.write("layers/occupancy.yaml", "");  // makes the folder
  sim::io::write_map(make_truth(room().arena), folder_ / "layers/occupancy");
  // The robot has seen the left half.
  write_report({{"seen", seen_floor([](const sim::Vec2& p) { return p.x() < 1.0; })}});
  const GradedRun half = evaluated();
  EXPECT_NEAR(half.measures.coverage.value_or(0.0), 0.5, 1e-9);
  EXPECT_NEAR(half.measures.seen.value_or(0.0), 0.5, 1e-9);
  EXPECT_EQ(half.measures.drawn, 1.0);
  // 100 x 100 cells of floor, half of them unseen, and a border of two cells around them.
  EXPECT_NEAR(half.measures.correctness.value_or(0.0), 1.0 - 5000.0 / (104.0 * 104.0), 1e-9);
  EXPECT_THAT(half.faults,
              ElementsAre("coverage 0.500, at least 0.98 needed: the map shows 1.000 of the floor, "
                          "but the robot's own sensors have seen only 0.500 of it"));
  write_report(
      {{"seen",
        {{"cell_size", 0.0}, {"x", 0.0}, {"y", 0.0}, {"width", 0}, {"height", 0}, {"cells", ""}}}});
  EXPECT_FALSE(evaluated().passed());
}

TEST_F(EvaluateTest, FirstCollision_HasTimeAndPlace) {
  task_.thresholds.max_collisions = 0;
  const json of_b = {{"time", 1.0}, {"robot", "b"}, {"with", "a"}, {"x", 0.0}, {"y", 0.0}};
  const json of_a = {
      {"time", 10.61}, {"robot", "a"}, {"with", "border"}, {"x", 1.1619}, {"y", 3.72}};
  json later = of_a;
  later["time"] = 12.0;
  write_report(json::object(), 20.0, {{"collisions", {of_b, of_a, later}}});
  EXPECT_THAT(evaluated().faults,
              ElementsAre("collisions 2, at most 0 allowed: first hit border at (1.16, 3.72) after "
                          "10.6 s"));
  // A report lists the newest ones only.
  write_report(json::object(), 20.0, {{"collisions", {later}}});
  EXPECT_THAT(evaluated().faults, ElementsAre("collisions 2, at most 0 allowed"));
}

TEST_F(EvaluateTest, FirstCollision_SightIfRunFails) {
  // Robot a drives along y = 1 with 0.2 m/s from x = 0.5 on. Its front, 0.087 m before its centre,
  // is at the border, x = 2, after 7.065 s. It was 1.393 m away at the first scan, after 0.1 s.
  std::string rows = "time,robot,x,y,yaw,v,omega,stalled\n";
  for (int i = 0; i < 80; ++i) {
    const std::string time = sim::fixed_text(0.1 * i, 3);
    const std::string x = sim::fixed_text(0.5 + 0.02 * i, 6);
    rows += time + ",a," + x + ",1,0,0.2,0,0\n" + time + ",b,1.5,1.5,0,0,0,0\n";
  }
  folder_.write("trajectory.csv", rows);
  const json hit = {{"time", 7.07}, {"robot", "a"}, {"with", "border"}, {"x", 2.0}, {"y", 1.0}};
  write_report({{"collisions", 1}}, 20.0, {{"collisions", {hit}}});
  const GradedRun passed = evaluated();
  ASSERT_TRUE(passed.passed() && passed.measures.first_collision);
  EXPECT_FALSE(passed.measures.first_collision->sight) << "it explains only failures";
  task_.thresholds.max_collisions = 0;
  const GradedRun failed = evaluated();
  EXPECT_THAT(failed.faults,
              ElementsAre("collisions 1, at most 0 allowed: first hit border at (2.00, 1.00) after "
                          "7.1 s; the laser had shown it for 7.0 s, at first 1.39 m ahead"));
  folder_.write("trajectory.csv", "nonsense");
  EXPECT_THAT(evaluated().faults, ElementsAre(testing::EndsWith("after 7.1 s")));
}

TEST_F(EvaluateTest, RefusedCommands_ExplainFailure) {
  const json refused = {{"refused", {{{"time", 0.1}, {"what", "the map of the world"}}}}};
  write_report({{"commanded", {{"first", 0.1}}}}, 20.0, refused);
  const GradedRun passed = evaluated();
  EXPECT_TRUE(passed.passed());
  EXPECT_THAT(passed.measures.commanded, ElementsAre("b", "a"));
  task_.thresholds.min_distance_m = 1.0;
  EXPECT_THAT(evaluated().faults,
              ElementsAre("distance driven (movements on the spot excluded) not measured, at "
                          "least 1 m needed",
                          "the program asked for the map of the world, which the task does not let "
                          "it use; the first time after 0.10 s"));
}

TEST_F(EvaluateTest, FailedRun_KeepsKnownFigures) {
  completed_ = true;
  task_.thresholds.min_path_length_m = 12.0;  // it might have come to that
  write_report();
  const GradedRun crashed = evaluated({JobEnd::Kind::kEnded, {.status = 0, .signal = SIGSEGV}, 1});
  EXPECT_EQ(crashed.measures.path_length_m, 1.25);
  EXPECT_THAT(crashed.faults, ElementsAre("the program was ended by signal 11 (Segmentation fault) "
                                          "after 20.00 s of simulated time"));
  EXPECT_THAT(evaluated({JobEnd::Kind::kTimedOut, {.status = 0, .signal = SIGKILL}, 1}).faults,
              ElementsAre("timeout: still running after 120 s; it was ended after 20.00 s of "
                          "simulated time"));
  EXPECT_THAT(
      evaluated().faults,
      ElementsAre("the program exited during the run (by _exit?) after 20.00 s of simulated time"));
  task_.thresholds.max_collisions = 1;
  EXPECT_THAT(evaluated().faults, testing::Contains("collisions 2, at most 1 allowed"));
}

TEST(MakeReference, UnknownNamesInMayUse_Refused) {
  const auto message_for = [](const playerlike::MayUse& may_use) {
    Task task;
    task.may_use = may_use;
    try {
      const Reference reference = make_reference(task, {"room.json", {}, {}}, room());
      return testing::PrintToString(rules_of(task, reference).may_use->robots);
    } catch (const sim::ConfigError& error) {
      return error.issues().front().message();
    }
  };
  EXPECT_EQ(message_for({{}, {{"laser", "motion"}}, {}}), "{ \"a\" }") << "the judged robot";
  EXPECT_THAT(message_for({{"a", "c"}, {}, {}}), HasSubstr("c, which is not there"));
  EXPECT_THAT(message_for({{}, {{"lasr"}}, {}}),
              AllOf(HasSubstr("lasr, which is none of them"), HasSubstr("laser, motion")));
}

TEST_F(EvaluateTest, MapWithoutThreshold_MayBeMissing) {
  write_report();
  task_.map_layer = "occupancy";
  EXPECT_TRUE(evaluated().passed());
}

TEST(FaultsOf, OnlyThresholds_AreJudged) {
  EXPECT_THAT(faults_of({}, {}, Ending::kTimeOver), IsEmpty());
  Measures terrible;
  terrible.reached = false;
  terrible.goal_distance_m = 9.0;
  terrible.collisions = 100;
  EXPECT_THAT(faults_of({}, terrible, Ending::kTimeOver), IsEmpty());
}

TEST(FaultsOf, Thresholds_IncludeTheirLimit) {
  Measures m;
  m.coverage = 0.9;
  m.correctness = 0.8;
  m.collisions = 2;
  m.least_clearance_m = 0.05;
  m.path_length_m = 10.0;
  m.path_ratio = 1.5;
  m.sim_time_s = 100.0;
  m.stalled_time_s = 3.0;
  m.score = -5.0;
  m.verdict = true;

  Thresholds at;
  at.min_coverage = 0.9;
  at.min_correctness = 0.8;
  at.max_collisions = 2;
  at.min_clearance_m = 0.05;
  at.min_path_length_m = 10.0;
  at.max_path_length_m = 10.0;
  at.max_path_ratio = 1.5;
  at.max_sim_time_s = 100.0;
  at.max_stalled_time_s = 3.0;
  at.min_score = -5.0;
  at.must_pass = true;
  EXPECT_THAT(faults_of(at, m, Ending::kBySelf), IsEmpty());

  Thresholds t;
  t.min_coverage = 0.95;
  EXPECT_THAT(faults_of(t, m, Ending::kBySelf),
              ElementsAre("coverage 0.900, at least 0.95 needed"));
  t = {};
  t.min_correctness = 0.81;
  EXPECT_THAT(faults_of(t, m, Ending::kBySelf),
              ElementsAre("map correctness 0.800, at least 0.81 needed"));
  t = {};
  t.max_collisions = 1;
  EXPECT_THAT(faults_of(t, m, Ending::kBySelf), ElementsAre("collisions 2, at most 1 allowed"));
  t = {};
  t.min_clearance_m = 0.06;
  EXPECT_THAT(faults_of(t, m, Ending::kBySelf),
              ElementsAre("least clearance 0.050 m, at least 0.06 m needed"));
  t = {};
  t.min_path_length_m = 12.0;
  EXPECT_THAT(faults_of(t, m, Ending::kBySelf), ElementsAre("path 10.00 m, at least 12 m needed"));
  t = {};
  t.max_path_length_m = 8.0;
  EXPECT_THAT(faults_of(t, m, Ending::kBySelf), ElementsAre("path 10.00 m, at most 8 m allowed"));
  t = {};
  t.max_path_ratio = 1.2;
  EXPECT_THAT(faults_of(t, m, Ending::kBySelf),
              ElementsAre("path ratio 1.50, at most 1.2 allowed"));
  t = {};
  t.max_sim_time_s = 99.0;
  EXPECT_THAT(faults_of(t, m, Ending::kBySelf),
              ElementsAre("simulated time 100.0 s, at most 99 s allowed"));
  t = {};
  t.max_stalled_time_s = 0.0;
  EXPECT_THAT(faults_of(t, m, Ending::kBySelf),
              ElementsAre("stalled time 3.00 s, at most 0 s allowed"));
  t = {};
  t.min_score = 7.5;
  EXPECT_THAT(faults_of(t, m, Ending::kVerdict), ElementsAre("score -5, at least 7.5 needed"));
  t = {};
  t.must_pass = true;
  m.verdict = false;
  EXPECT_THAT(faults_of(t, m, Ending::kVerdict), ElementsAre("verdict: failed"));
}

TEST(FaultsOf, GoalAndEnd_NamedInWords) {
  Thresholds t;
  t.must_reach = true;
  t.must_end = true;
  Measures m;
  m.reached = false;
  m.goal_distance_m = 0.416;
  EXPECT_THAT(faults_of(t, m, Ending::kTimeOver),
              ElementsAre("the simulated time was over before the program ended",
                          "goal not reached: 0.42 m away from it at the end"));
  m.reached = true;
  EXPECT_THAT(faults_of(t, m, Ending::kBySelf), IsEmpty());
  m.reached.reset();
  EXPECT_THAT(faults_of(t, m, Ending::kBySelf), ElementsAre("goal not known to be reached"));
}

TEST(FaultsOf, Numbers_DifferFromLimitInText) {
  Thresholds t;
  t.min_coverage = 0.98;
  Measures m;
  m.coverage = 0.97996;
  EXPECT_THAT(faults_of(t, m, Ending::kBySelf),
              ElementsAre("coverage 0.97996, at least 0.98 needed"));
}

}  // namespace
}  // namespace playpen::grade
