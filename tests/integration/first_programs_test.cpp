// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// The first programs of README and guides: their robots see much of the world and touch nothing.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <charconv>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "par_common/distance.h"
#include "par_common/planners.h"
#include "playpen_process.h"
#include "run_files.h"
#include "sim/simulation/simulation.h"
#include "sim/world/occupancy_map.h"
#include "temporary_folder.h"

namespace {

/// Parses a field of a table, independently of the locale.
double number_of(const std::string& text) {
  double value = 0.0;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

namespace fs = std::filesystem;
using nlohmann::json;
using test_support::playpen;
using test_support::ProcessOptions;
using test_support::ProcessResult;
using test_support::read_report;
using test_support::TemporaryFolder;

using Square = std::pair<int, int>;

constexpr double kDuration_s = 120.0;

std::string file_of(const std::string& world) {
  return PLAYPEN_SOURCE_DIR "/worlds/" + world + ".json";
}

Square square_of(double x_m, double y_m, double side_m) {
  return {static_cast<int>(std::floor(x_m / side_m)), static_cast<int>(std::floor(y_m / side_m))};
}

/// Squares of the floor of which the centre of an S1R (its circle has a radius of 0.098 m) can
/// reach at least a quarter from the start.
std::set<Square> squares_to_visit(const std::string& world_name, double side_m) {
  const sim::WorldDescription world = sim::load_world(file_of(world_name));
  const sim::OccupancyMap truth = sim::true_map(world.arena, world.canvas);
  par::Mask solid({truth.width, truth.height, truth.cell_size_m, {}});
  for (std::size_t i = 0; i < truth.cells.size(); ++i) {
    solid.values()[i] = truth.cells[i] > 0.5F ? 1 : 0;
  }
  const sim::Pose& start = world.robots.at(0).pose;
  const par::Mask reachable =
      par::DistanceField(par::inflate(solid, 0.1), solid.frame().cell_of({start.x_m, start.y_m}))
          .reachable();
  std::map<Square, double> areas;
  for (std::size_t i = 0; i < reachable.values().size(); ++i) {
    if (reachable.values()[i] == 0) continue;
    const par::Point centre = reachable.frame().centre_of(reachable.frame().cell_at(i));
    areas[square_of(centre.x, centre.y, side_m)] += truth.cell_size_m * truth.cell_size_m;
  }
  std::set<Square> squares;
  for (const auto& [square, area] : areas) {
    if (area >= side_m * side_m / 4.0) squares.insert(square);
  }
  return squares;
}

class FirstPrograms : public testing::Test {
 protected:
  /// Runs two simulated minutes. Sets `visited_`, the squares that contained the first robot's
  /// centre, and `robot_`, its part of the report.
  void run(const std::string& program, const std::string& world, int seed, double side_m) {
    ProcessOptions patient;
    patient.timeout = std::chrono::seconds(900);
    const ProcessResult result =
        playpen({"run", file_of(world), "--duration", json(kDuration_s).dump(), "--seed",
                 std::to_string(seed), "--quiet", "--out", out_, "--", program},
                patient);
    ASSERT_EQ(result.status, 0) << result.err;
    robot_ = read_report(out_).at("robots").at(0);
    const std::string name = robot_.at("name").get<std::string>();
    visited_.clear();
    last_move_s_ = 0.0;
    std::ifstream rows(fs::path(out_) / "trajectory.csv");
    std::string row;
    std::getline(rows, row);
    ASSERT_EQ(row, "time,robot,x,y,yaw,v,omega,stalled");
    while (std::getline(rows, row)) {
      std::vector<std::string> fields(1);
      for (const char c : row) {
        if (c == ',') {
          fields.emplace_back();
        } else {
          fields.back() += c;
        }
      }
      if (fields.at(1) != name) continue;
      visited_.insert(square_of(number_of(fields.at(2)), number_of(fields.at(3)), side_m));
      if (number_of(fields.at(5)) > 0.05) last_move_s_ = number_of(fields.at(0));
    }
  }
  void expect_touched_nothing() const {
    EXPECT_EQ(robot_.at("collisions").get<int>(), 0);
    EXPECT_DOUBLE_EQ(robot_.at("stalled_time").get<double>(), 0.0);
    EXPECT_GT(last_move_s_, kDuration_s - 10.0) << "the robot sticks";
  }

  TemporaryFolder folder_;
  std::string out_ = folder_ / "out";
  json robot_;
  std::set<Square> visited_;
  double last_move_s_ = 0.0;
};

TEST_F(FirstPrograms, RoamArena) {
  struct Case {
    std::string world;
    std::vector<int> seeds;
    std::vector<std::string> programs;
  };
  std::vector<std::string> all = {README_PROGRAM, START_HERE_PROGRAM};
#ifdef C_PROGRAM
  all.emplace_back(C_PROGRAM);
#endif
  // The worlds of introduction and planning have no noise, so all seeds give the same result.
  const std::vector<Case> cases = {{"tasks/par_intro", {1}, all},
                                   {"tasks/par_planning", {1}, {README_PROGRAM}},
                                   {"tasks/par_planning_2", {1}, {README_PROGRAM}},
                                   {"tasks/par_exploration", {1}, all},
                                   {"tasks/par_exploration", {2, 3}, {README_PROGRAM}},
                                   {"tasks/par_exploration_2", {1}, all},
                                   {"tasks/par_exploration_2", {2, 3}, {README_PROGRAM}}};
  const double side_m = 0.2;
  for (const auto& [world, seeds, programs] : cases) {
    const std::set<Square> squares = squares_to_visit(world, side_m);
    ASSERT_GT(squares.size(), 200U) << world;
    for (const std::string& program : programs) {
      for (const int seed : seeds) {
        SCOPED_TRACE(program + " in " + world + ", seed " + std::to_string(seed));
        run(program, world, seed, side_m);
        if (HasFatalFailure()) return;
        std::size_t visited = 0;
        for (const Square& square : squares) visited += visited_.count(square);
        // Corridors are two to three squares wide; a robot that drives through all of them once
        // visits half.
        EXPECT_GT(static_cast<double>(visited) / static_cast<double>(squares.size()), 0.5);
        expect_touched_nothing();
      }
    }
  }
}

TEST_F(FirstPrograms, Wander_RunsInStageWorld) {
  for (const char* world : {"cave", "office", "examples/pioneer"}) {
    SCOPED_TRACE(world);
    run(WANDER_PROGRAM, world, 1, 0.5);
    if (HasFatalFailure()) return;
    // 120 s at 0.4 m/s are 48 m; a robot that circles in a corner visits about ten squares.
    EXPECT_GT(visited_.size(), 40U);
    expect_touched_nothing();
  }
}

}  // namespace
