// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// The planning task's programs under `playpen run`.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "playpen_process.h"
#include "run_files.h"
#include "run_process.h"
#include "temporary_folder.h"

namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test_support::playpen;
using test_support::ProcessResult;
using test_support::read_bytes;
using test_support::read_report;
using test_support::TemporaryFolder;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

const std::vector<std::string> kWorlds = {PLAYPEN_SOURCE_DIR "/worlds/tasks/par_planning.json",
                                          PLAYPEN_SOURCE_DIR "/worlds/tasks/par_planning_2.json"};
const std::vector<std::string> kSolutions = {DIJKSTRA_PROGRAM, THETA_PROGRAM};

class ParPlanning : public testing::Test {
 protected:
  [[nodiscard]] ProcessResult run(const std::string& world, const std::vector<std::string>& program,
                                  const std::vector<std::string>& options = {}) const {
    std::vector<std::string> call = {"run", world, "--out", out_};
    call.insert(call.end(), options.begin(), options.end());
    call.emplace_back("--");
    call.insert(call.end(), program.begin(), program.end());
    return playpen(call);
  }
  [[nodiscard]] json robot() const { return read_report(out_).at("robots").at(0); }
  [[nodiscard]] std::string output(const std::string& name) const {
    return read_bytes(fs::path(out_) / name);
  }
  /// Distance of the robot from a point at the end [m].
  [[nodiscard]] double distance_m(double x, double y) const {
    const json pose = robot().at("final_pose");
    return std::hypot(pose.at("x").get<double>() - x, pose.at("y").get<double>() - y);
  }

  TemporaryFolder folder_;
  std::string out_ = folder_ / "out";
};

TEST_F(ParPlanning, Solutions_ReachGoalWithoutCollision) {
  for (const std::string& world : kWorlds) {
    for (const std::string& program : kSolutions) {
      const ProcessResult result = run(world, {program});
      ASSERT_EQ(result.status, 0) << result.err;
      EXPECT_THAT(result.err, AllOf(HasSubstr("Reached the goal"), Not(HasSubstr("ERROR"))));
      EXPECT_EQ(robot().at("collisions").get<int>(), 0) << program;
      EXPECT_DOUBLE_EQ(robot().at("stalled_time").get<double>(), 0.0) << program;
      // The goal is 0.01 m too near to an obstacle, and the arrival tolerance is 0.02 m.
      EXPECT_LT(distance_m(3.1, 3.3), 0.05) << program;
      // Obstacles are inflated by 0.13 m, the S1R's circle has a radius of 0.098 m, cells are 0.02
      // m.
      EXPECT_GT(robot().at("least_clearance").get<double>(), 0.01) << program;
      for (const char* layer : {"map", "inflated", "path", "smoothed", "goal"}) {
        EXPECT_THAT(output("layers/" + std::string(layer) + ".png"), HasSubstr("PNG")) << layer;
      }
    }
  }
}

TEST_F(ParPlanning, Goals_AreOptions) {
  const ProcessResult result = run(kWorlds[0], {THETA_PROGRAM, "--goal-x=0.5", "--goal-y=3.4"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_LT(distance_m(0.5, 3.4), 0.04);  // the cell's centre, and the tolerance
  EXPECT_EQ(robot().at("collisions").get<int>(), 0);
}

TEST_F(ParPlanning, Repeatable) {
  for (const std::string& program : kSolutions) {
    ASSERT_EQ(run(kWorlds[1], {program}).status, 0);
    const std::vector<std::string> names = {"scene.png", "canvas.png", "trajectory.csv"};
    std::vector<std::string> files;
    for (const std::string& name : names) files.push_back(output(name));
    const json first = robot();
    ASSERT_EQ(run(kWorlds[1], {program}).status, 0);
    EXPECT_EQ(robot(), first);
    for (std::size_t i = 0; i < names.size(); ++i) {
      // Not EXPECT_EQ, because pictures do not print well.
      EXPECT_TRUE(files[i] == output(names[i])) << names[i] << " differs between two equal runs";
    }
  }
}

TEST_F(ParPlanning, NoPath_Reported) {
  for (const std::string& program : kSolutions) {
    // Goals outside the map and in a closed room.
    const ProcessResult outside = run(kWorlds[0], {program, "--goal-x", "5"});
    EXPECT_EQ(outside.status, 1);
    EXPECT_THAT(outside.err, AllOf(HasSubstr("There is no way"), HasSubstr("(5, 3.3) m")));
    const std::string closed = folder_.write("closed.json", R"({
      "arena": {"size": [2.0, 2.0],
                "obstacles": [{"center": [1.0, 1.0], "size": [0.2, 2.0], "type": "static"}]},
      "robots": [{"pose": {"x": 0.4, "y": 1.0}}]})");
    const ProcessResult walled = run(closed, {program, "--goal-x=1.6", "--goal-y=1.0"});
    EXPECT_EQ(walled.status, 1);
    EXPECT_THAT(walled.err, HasSubstr("There is no way"));
    EXPECT_DOUBLE_EQ(robot().at("path_length").get<double>(), 0.0);
  }
}

TEST_F(ParPlanning, MapOfWorldSize_Driven) {
  const ProcessResult result = run(
      kWorlds[0], {DIJKSTRA_PROGRAM, "--map", PLAYPEN_SOURCE_DIR "/worlds/maps/par_planning.txt"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_LT(distance_m(3.1, 3.3), 0.05);
}

TEST_F(ParPlanning, MapOfOtherSize_OnlyPlanned) {
  const std::string map = PLAYPEN_SOURCE_DIR "/worlds/maps/two_rooms.txt";
  for (const std::string& program : kSolutions) {
    const ProcessResult result =
        run(kWorlds[0], {program, "--map", map, "--inflation", "0.02", "--goal-x=0.6"});
    ASSERT_EQ(result.status, 0) << result.err;
    // 172 / 32 = 5.4 and 186 / 24 = 7.75: 5 pixels fit.
    EXPECT_THAT(result.err, AllOf(HasSubstr("32 x 24"), HasSubstr("5 pixels a cell"),
                                  HasSubstr("stays where it is")));
    EXPECT_DOUBLE_EQ(robot().at("path_length").get<double>(), 0.0);
  }
  std::string large = "200\n";
  for (int row = 0; row < 200; ++row) large += std::string(1000, '.') + "\n";
  const ProcessResult shrunk =
      run(kWorlds[0], {THETA_PROGRAM, "--map", folder_.write("large.txt", large)});
  ASSERT_EQ(shrunk.status, 0) << shrunk.err;
  EXPECT_THAT(shrunk.err, HasSubstr("6 cells a pixel"));  // 1000 / 172 = 5.8
}

TEST_F(ParPlanning, InvalidMap_RefusedWithFileAndLine) {
  const std::string map = folder_.write("bad.txt", "3\n...\n.x.\n...\n");
  const ProcessResult result = run(kWorlds[0], {THETA_PROGRAM, "--map", map});
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.err, HasSubstr("bad.txt:3: expected . or # in column 2, found \"x\""));
  const ProcessResult none = run(kWorlds[0], {THETA_PROGRAM, "--map", folder_ / "none.txt"});
  EXPECT_EQ(none.status, 1);
  EXPECT_THAT(none.err, AllOf(HasSubstr("none.txt"), HasSubstr("cannot be read")));
}

TEST_F(ParPlanning, Goal_MarkedAtItsPlace) {
  std::string first_mark;
  for (const char* program : {TEMPLATE_PROGRAM, DIJKSTRA_PROGRAM}) {
    std::vector<std::string> marks;
    for (const char* goal : {"--goal-x=0.5", "--goal-x=0.56", "--goal-x=9"}) {
      static_cast<void>(run(kWorlds[0], {program, goal, "--goal-y=3.4"}, {"--duration", "0.3"}));
      marks.push_back(output("layers/goal.png"));
    }
    EXPECT_FALSE(marks[0] == marks[1]) << program;
    EXPECT_FALSE(marks[0] == marks[2]) << program << ": the last goal is off the canvas";
    EXPECT_FALSE(marks[1] == marks[2]) << program;
    if (first_mark.empty()) first_mark = marks[0];
    EXPECT_TRUE(marks[0] == first_mark) << program;
  }
}

TEST_F(ParPlanning, Template_StandsStillAndExits) {
  for (const std::string& world : kWorlds) {
    const ProcessResult result = run(world, {TEMPLATE_PROGRAM}, {"--duration", "5"});
    ASSERT_EQ(result.status, 0) << result.err;
    EXPECT_DOUBLE_EQ(robot().at("path_length").get<double>(), 0.0);
    EXPECT_THAT(result.err, Not(HasSubstr("ERROR")));
  }
  const ProcessResult map =
      run(kWorlds[0], {TEMPLATE_PROGRAM, "--map", "none.txt"}, {"--duration", "1"});
  EXPECT_EQ(map.status, 0) << map.err;
}

}  // namespace
