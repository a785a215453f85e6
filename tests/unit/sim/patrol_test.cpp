// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/devices/patrol.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <string>
#include <utility>
#include <vector>

#include "sim/core/error.h"
#include "sim/simulation/simulation.h"

namespace sim {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// A robot at (1, 1) that patrols.
WorldDescription patrol_world(const std::string& ways, int seed = 1) {
  return load_world_text(R"({"arena": {"size": [4, 4]}, "simulation": {"seed": )" +
                         std::to_string(seed) + R"(},
    "robots": [{"name": "r1", "pose": {"x": 1, "y": 1}, "devices": {
      "laser": null, "patrol": {"speed": 0.4, "ways": )" +
                         ways + "}}}]}");
}

void run(Simulation& simulation, double duration_s) {
  const SimTime end_ns = simulation.now_ns() + from_seconds(duration_s);
  while (simulation.now_ns() < end_ns) simulation.step();
}

TEST(PatrolMap, EqualEnds_OneJunction) {
  const PatrolMap map({{{0, 0}, {1, 0}}, {{1, 0}, {1, 1}}, {{0, 0}, {1, 1}}});
  ASSERT_EQ(map.junctions.size(), 3U);
  EXPECT_THAT(map.junctions[0].next, ElementsAre(1, 2));
  EXPECT_THAT(map.junctions[1].next, ElementsAre(0, 2));
  EXPECT_THAT(map.junctions[2].next, ElementsAre(1, 0));
  EXPECT_EQ(map.nearest({0.9, 0.8}), 2U);
}

// From the dead end at (1, 1) the only way leads to (3, 1), and back again.
TEST(Patrol, DeadEnd_TurnsBack) {
  Simulation simulation(patrol_world("[[1, 1, 3, 1]]"));
  run(simulation, 5.0);  // 2 m at 0.4 m/s
  EXPECT_NEAR(simulation.body(0).X_WB.x_m, 2.95, 0.1);
  EXPECT_NEAR(simulation.body(0).X_WB.y_m, 1.0, 0.01);
  run(simulation, 8.0);
  EXPECT_LT(simulation.body(0).X_WB.x_m, 1.5);
}

/// The corners of a square in the order of the visits.
std::vector<std::pair<int, int>> corners_visited(int seed) {
  Simulation simulation(
      patrol_world("[[1, 1, 2, 1], [2, 1, 2, 2], [2, 2, 1, 2], [1, 2, 1, 1]]", seed));
  std::vector<std::pair<int, int>> visited;
  for (int i = 0; i < 2500; ++i) {
    simulation.step();
    for (const int x : {1, 2}) {
      for (const int y : {1, 2}) {
        const bool is_there = (simulation.body(0).X_WB.position() - Vec2(x, y)).norm() < 0.06;
        if (is_there && (visited.empty() || visited.back() != std::pair(x, y))) {
          visited.emplace_back(x, y);
        }
      }
    }
  }
  return visited;
}

TEST(Patrol, Loop_DirectionFromSeed) {
  std::set<std::pair<int, int>> second;
  for (int seed = 1; seed <= 6; ++seed) {
    const std::vector<std::pair<int, int>> visited = corners_visited(seed);
    ASSERT_GE(visited.size(), 6U);
    second.insert(visited[1]);
    for (std::size_t i = 2; i < visited.size(); ++i) EXPECT_NE(visited[i], visited[i - 2]) << i;
    EXPECT_EQ(visited, corners_visited(seed)) << "the same seed";
  }
  EXPECT_EQ(second.size(), 2U);
}

TEST(Patrol, FirstCommand_EndsPatrol) {
  Simulation simulation(patrol_world("[[1, 1, 3, 1]]"));
  run(simulation, 1.0);
  const int motion = simulation.find_device(0, "motion").value();
  EXPECT_FALSE(simulation.apply({0, motion}, TwistCommand{}));
  run(simulation, 0.5);
  const double x_m = simulation.body(0).X_WB.x_m;
  run(simulation, 2.0);
  EXPECT_EQ(simulation.body(0).X_WB.x_m, x_m);
}

TEST(Patrol, NoWays_StandsStill) {
  Simulation simulation(patrol_world("[]"));
  run(simulation, 1.0);
  EXPECT_EQ(simulation.body(0).X_WB.x_m, 1.0);
}

TEST(Patrol, SavedState_Continues) {
  Simulation simulation(patrol_world("[[1, 1, 2, 1], [2, 1, 2, 2], [2, 2, 1, 2], [1, 2, 1, 1]]"));
  run(simulation, 4.0);
  Simulation copy = simulation.fork();
  run(simulation, 20.0);
  run(copy, 20.0);
  EXPECT_EQ(copy.state_hash(), simulation.state_hash());
}

TEST(Patrol, InvalidWays_Refused) {
  for (const char* ways :
       {"[[1, 1, 2]]", "[[1, 1, 1, 1]]", "[[1, 1, 2, \"a\"]]", "[7]", "[[1, 1, 2, 1e9]]"}) {
    try {
      static_cast<void>(patrol_world(ways));
      ADD_FAILURE() << ways;
    } catch (const ConfigError& error) {
      EXPECT_THAT(error.issues().front().message(), HasSubstr("[x, y, x, y]")) << ways;
    }
  }
}

}  // namespace
}  // namespace sim
