// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// The programs of the exploration task on its worlds, compared with the true map.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "nightly.h"
#include "playpen_process.h"
#include "run_files.h"
#include "sim/io/map_file.h"
#include "sim/simulation/simulation.h"
#include "sim/world/occupancy_map.h"
#include "temporary_folder.h"

namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test_support::cases;
using test_support::expect_equal_files;
using test_support::Files;
using test_support::files_of_run;
using test_support::playpen;
using test_support::ProcessResult;
using test_support::read_report;
using test_support::TemporaryFolder;
using testing::HasSubstr;
using testing::Not;

// The file of a task's world, by its name; a file name stays unchanged.
std::string world_file(const std::string& name) {
  if (name.ends_with(".json")) return name;
  return std::string(PLAYPEN_SOURCE_DIR "/worlds/tasks/") + name + ".json";
}

/// Agreement between a map and the arena.
struct Quality {
  /// share of the cells reachable from the start (4 neighbours) that the map calls free
  double coverage = 0.0;
  /// share of the known cells that are right; occupied beside solid counts as right
  double correctness = 0.0;
};

Quality judge(const sim::OccupancyMap& map, const std::string& world_name) {
  const sim::WorldDescription world = sim::load_world(world_file(world_name));
  const sim::OccupancyMap truth = sim::true_map(world.arena, world.canvas);
  EXPECT_EQ(map.width, truth.width);
  EXPECT_EQ(map.height, truth.height);
  const auto solid = [&](int column, int row) {
    return column < 0 || row < 0 || column >= truth.width || row >= truth.height ||
           truth.at(column, row) > 0.5F;
  };
  const auto index = [&](int column, int row) {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(truth.width) +
           static_cast<std::size_t>(column);
  };
  // map_server's thresholds for reading a map.
  const auto is_free = [&](int column, int row) { return map.at(column, row) < 0.2F; };
  const auto is_occupied = [&](int column, int row) { return map.at(column, row) > 0.65F; };

  const sim::Pose& start = world.robots.at(0).pose;
  struct Place {
    int column;
    int row;
  };
  std::vector<Place> open = {{static_cast<int>(start.x_m / truth.cell_size_m),
                              truth.height - 1 - static_cast<int>(start.y_m / truth.cell_size_m)}};
  std::vector<char> reached(truth.cells.size(), 0);
  int reachable = 0;
  int covered = 0;
  while (!open.empty()) {
    const auto [column, row] = open.back();
    open.pop_back();
    if (solid(column, row) || reached[index(column, row)] != 0) continue;
    reached[index(column, row)] = 1;
    ++reachable;
    covered += is_free(column, row) ? 1 : 0;
    open.insert(open.end(),
                {{column + 1, row}, {column - 1, row}, {column, row + 1}, {column, row - 1}});
  }

  int known = 0;
  int right = 0;
  for (int row = 0; row < map.height; ++row) {
    for (int column = 0; column < map.width; ++column) {
      if (is_free(column, row)) {
        ++known;
        right += solid(column, row) ? 0 : 1;
      } else if (is_occupied(column, row)) {
        ++known;
        bool near_solid = false;
        for (int dy = -1; dy <= 1; ++dy) {
          for (int dx = -1; dx <= 1; ++dx) near_solid |= solid(column + dx, row + dy);
        }
        right += near_solid ? 1 : 0;
      }
    }
  }
  return {static_cast<double>(covered) / std::max(1, reachable),
          static_cast<double>(right) / std::max(1, known)};
}

class Exploration : public testing::Test {
 protected:
  /// `playpen run WORLD OPTIONS --out FOLDER -- PROGRAM`.
  ProcessResult run(const std::string& world, const std::vector<std::string>& options,
                    const std::vector<std::string>& program, const std::string& folder = "out") {
    out_ = folder_ / folder;
    std::vector<std::string> call = {"run", world};
    call.insert(call.end(), options.begin(), options.end());
    call.insert(call.end(), {"--out", out_, "--"});
    call.insert(call.end(), program.begin(), program.end());
    return playpen(call);
  }
  [[nodiscard]] json report() const { return read_report(out_); }
  [[nodiscard]] json robot() const { return report().at("robots").at(0); }
  [[nodiscard]] Quality quality(const std::string& world) const {
    return judge(sim::io::read_map(out_ + "/layers/occupancy.yaml"), world);
  }
  void expect_explored(const ProcessResult& result, const std::string& world) const {
    ASSERT_EQ(result.status, 0) << result.err;
    EXPECT_THAT(result.out, HasSubstr("Explored: no frontier is left"));
    EXPECT_EQ(robot().at("collisions").get<int>(), 0);
    // The task's threshold. Solutions reach 99.8 and 99.7 %, far above it.
    EXPECT_GE(quality(world).coverage, 0.98);
    EXPECT_GE(quality(world).correctness, 0.97);
    // The world's time limit; a run should take a fourth of it.
    EXPECT_LT(report().at("run").at("sim_time").get<double>(), 300.0);
  }

  TemporaryFolder folder_;
  std::string out_;
};

struct Case {
  const char* program;
  const char* world;
};

class ExplorationOf : public Exploration, public testing::WithParamInterface<Case> {};

TEST_P(ExplorationOf, CompleteAndRepeatable) {
  const auto [program, world] = GetParam();
  expect_explored(run(world_file(world), {}, {program}, "first"), world);
  const Files first = files_of_run(out_);
  for (const char* name :
       {"scene.png", "canvas.png", "trajectory.csv", "layers/occupancy.pgm", "layers/inflated.png",
        "layers/frontiers.png", "layers/path.png", "layers/trail.png", "layers/scan.png"}) {
    EXPECT_EQ(first.count(name), 1U) << name;
  }

  ASSERT_EQ(run(world_file(world), {}, {program}, "second").status, 0);
  expect_equal_files(files_of_run(out_), first, "the second of two equal runs");
}

INSTANTIATE_TEST_SUITE_P(
    EachSolutionInEachWorld, ExplorationOf,
    testing::ValuesIn(cases<std::vector<Case>>({{NEAREST_PROGRAM, "par_exploration_2"},
                                                {GAIN_PROGRAM, "par_exploration"}},
                                               {{NEAREST_PROGRAM, "par_exploration"},
                                                {NEAREST_PROGRAM, "par_exploration_2"},
                                                {GAIN_PROGRAM, "par_exploration"},
                                                {GAIN_PROGRAM, "par_exploration_2"}})));

TEST_F(Exploration, OtherSeeds_Complete) {
  for (const std::string& seed : cases<std::vector<std::string>>({"2"}, {"2", "3", "4", "5"})) {
    SCOPED_TRACE(seed);
    expect_explored(run(world_file("par_exploration"), {"--seed", seed}, {NEAREST_PROGRAM}),
                    "par_exploration");
    expect_explored(run(world_file("par_exploration_2"), {"--seed", seed}, {GAIN_PROGRAM}),
                    "par_exploration_2");
  }
}

// The robot starts at the open end of a dead end and looks out of it. It sees the closed end only
// briefly, and nothing on its path brings it back there.
TEST_F(Exploration, BrieflySeenArea_IsExploredAgain) {
  const std::string file = folder_.write("glance.json", R"({
    "arena": {"preset": "syrotek", "extended": ["d1", "d2", "d3", "d4", "d7"]},
    "simulation": {"duration": 300}, "canvas": {"size": [172, 186]},
    "robots": [{"pose": {"x": 0.5, "y": 0.4, "yaw_deg": 90},
                "devices": {"laser": {"noise": 0.005}, "odometry": {"noise": 0.005}}}]
  })");
  for (const char* program : {NEAREST_PROGRAM, GAIN_PROGRAM}) {
    SCOPED_TRACE(program);
    expect_explored(run(file, {}, {program}), file);
    EXPECT_GE(quality(file).coverage, 0.99);
  }
}

TEST_F(Exploration, StartNearWalls_TouchesNothing) {
  struct Start {
    double x, y, yaw_deg;
  };
  // The S1R's outline extends 0.087 m ahead and back and 0.081 m to the sides, 0.098 m at most. In
  // the first two cases there are 5 mm in front of or behind it, in the third 10 mm beside it: it
  // cannot turn on the spot. In the others it stands in a corner, 5 and 11 mm from the walls, and
  // in a dock.
  for (const Start& start :
       {Start{0.5, 3.628, 90.0}, Start{0.5, 3.628, -90.0}, Start{1.379, 1.5, 90.0},
        Start{3.328, 0.092, 0.0}, Start{0.15, 0.27, 180.0}}) {
    SCOPED_TRACE(testing::Message() << start.x << ' ' << start.y << ' ' << start.yaw_deg);
    const json pose = {{"x", start.x}, {"y", start.y}, {"yaw_deg", start.yaw_deg}};
    json world = json::parse(R"({
      "arena": {"preset": "syrotek"}, "simulation": {"duration": 20},
      "canvas": {"size": [172, 186]}, "robots": [{"devices": {"laser": {"noise": 0.005}}}]
    })");
    world["robots"][0]["pose"] = pose;
    const std::string file = folder_.write("start.json", world.dump());
    const ProcessResult result = run(file, {}, {NEAREST_PROGRAM});
    ASSERT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(robot().at("collisions").get<int>(), 0);
    EXPECT_GT(robot().at("path_length").get<double>(), 1.0) << "it did not get out of there";
  }
}

// A cage that leaves the robot 15 mm on each side: every cell is too close to its walls.
TEST_F(Exploration, EnclosedRobot_ExploresNothing) {
  const std::string file = folder_.write("cage.json", R"({
    "arena": {"size": [3, 3], "obstacles": [
      {"center": [1.5, 1.612], "size": [0.3, 0.02]}, {"center": [1.5, 1.388], "size": [0.3, 0.02]},
      {"center": [1.612, 1.5], "size": [0.02, 0.3]}, {"center": [1.388, 1.5], "size": [0.02, 0.3]}]},
    "simulation": {"duration": 20}, "canvas": {"size": [172, 186]},
    "robots": [{"pose": {"x": 1.5, "y": 1.5}}]
  })");
  const ProcessResult result = run(file, {}, {NEAREST_PROGRAM});
  EXPECT_THAT(result.out, HasSubstr("Not finished: the map has no free cell near the robot"));
  EXPECT_THAT(result.out, Not(HasSubstr("Explored")));
}

TEST_F(Exploration, ExactOdometry_NeedsNoLocalisation) {
  // Without noise the odometry is exact, so the map is as good; the start pose gives its position.
  const std::string file = folder_.write("exact.json", R"({
    "arena": {"preset": "syrotek", "extended": ["d2", "d6"]}, "simulation": {"duration": 300},
    "canvas": {"size": [172, 186]}, "robots": [{"pose": {"x": 0.5, "y": 0.4, "yaw_deg": 90}}]
  })");
  expect_explored(run(file, {}, {GAIN_PROGRAM, "--position2d-index", "1"}), "par_exploration");
}

TEST_F(Exploration, DriftingOdometry_TouchesNothing) {
  const ProcessResult result = run(world_file("par_exploration_2"), {"--duration", "120"},
                                   {NEAREST_PROGRAM, "--position2d-index", "1"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(robot().at("collisions").get<int>(), 0);
}

TEST_F(Exploration, TimeLimit_EndsExploration) {
  const ProcessResult result =
      run(world_file("par_exploration"), {}, {NEAREST_PROGRAM, "--time-limit", "5"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("the time limit is over"));
  // includes the first Reads
  EXPECT_NEAR(report().at("run").at("sim_time").get<double>(), 5.3, 0.31);
}

TEST_F(Exploration, End_WritesPicturesOfPath) {
  // The program ends before the run does, so an exit handler writes the last pictures.
  const ProcessResult result = run(world_file("par_exploration"), {"--snapshot-every", "2"},
                                   {NEAREST_PROGRAM, "--time-limit", "5"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_TRUE(fs::exists(fs::path(out_) / "report.json"));
  EXPECT_TRUE(fs::exists(fs::path(out_) / "scene.png"));
}

TEST_F(Exploration, EndOfRun_ExitsWithoutError) {
  const ProcessResult result =
      run(world_file("par_exploration"), {"--duration", "5"}, {GAIN_PROGRAM});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("the run is over"));
  EXPECT_THAT(result.err, Not(HasSubstr("ERROR")));
}

TEST_F(Exploration, InvalidSettings_Refused) {
  EXPECT_EQ(run(world_file("par_exploration"), {}, {GAIN_PROGRAM, "--lambda", "-1"}).status, 1);
  EXPECT_EQ(run(world_file("par_exploration"), {}, {GAIN_PROGRAM, "--gain-range", "0"}).status, 1);
  EXPECT_EQ(run(world_file("par_exploration"), {}, {NEAREST_PROGRAM, "--time-limit", "-1"}).status,
            1);
}

TEST_F(Exploration, Template_StandsStillWithEmptyMap) {
  const ProcessResult result =
      run(world_file("par_exploration"), {"--duration", "10"}, {TEMPLATE_PROGRAM});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.err, Not(HasSubstr("ERROR")));
  EXPECT_DOUBLE_EQ(robot().at("path_length").get<double>(), 0.0);
  EXPECT_DOUBLE_EQ(quality("par_exploration").coverage, 0.0);
}

}  // namespace
