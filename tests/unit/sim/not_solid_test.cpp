// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Obstacles, maps and robots that are not solid: sensors see them, and nothing collides with them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "sim/core/error.h"
#include "sim/devices/laser.h"
#include "sim/simulation/simulation.h"
#include "sim/world/occupancy_map.h"
#include "sim/world/robot_model.h"
#include "temporary_folder.h"

namespace sim {
namespace {

using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;

// r1 stands at (1, 1) and faces along x; its laser is 0.1 m high and looks straight ahead.
std::string ghost_world(const std::string& obstacles,
                        const std::string& pose = R"({"x": 1, "y": 1})") {
  return R"({"arena": {"size": [4, 2], "obstacles": [)" + obstacles +
         R"(]}, "robots": [{"name": "r1", "pose": )" + pose +
         R"(, "devices": {"laser": {"beams": 1, "range_max": 5, "height": 0.1}}}]})";
}

double ghost_range_m(const Simulation& simulation) {
  const auto& laser =
      dynamic_cast<const Laser&>(simulation.device(0, simulation.find_device(0, "laser").value()));
  return laser.reading().ranges_m.at(0);
}

void drive_ahead(Simulation& simulation, int steps) {
  const int motion = simulation.find_device(0, "motion").value();
  ASSERT_FALSE(simulation.apply({0, motion}, TwistCommand{{.v_mps = 0.5}}));
  for (int i = 0; i < steps; ++i) simulation.step();
}

class NotSolid : public testing::TestWithParam<const char*> {};

// Each obstacle begins 1 m ahead of the laser, whose beam ends there; the robot drives 2 m in 4 s.
TEST_P(NotSolid, Obstacles_VisibleButNotSolid) {
  Simulation simulation(load_world_text(ghost_world(GetParam())));
  for (int i = 0; i < 10; ++i) simulation.step();  // to the first scan
  const double laser_m =
      simulation.body(0).X_WB.x_m +
      std::any_cast<LaserParams>(simulation.world().robots[0].devices[0].params).X_BL.x_m;
  EXPECT_NEAR(ghost_range_m(simulation), 2.0 - laser_m, 1e-3);
  drive_ahead(simulation, 400);
  EXPECT_GT(simulation.body(0).X_WB.x_m, 2.8);
  EXPECT_EQ(simulation.statistics(0).collisions, 0);
}

INSTANTIATE_TEST_SUITE_P(
    Shapes, NotSolid,
    testing::Values(
        R"({"name": "a", "center": [2.2, 1], "size": [0.4, 0.4], "solid": false})",
        R"({"name": "a", "center": [2.2, 1], "shape": "circle", "radius": 0.2, "solid": false})",
        R"({"name": "a", "center": [2, 1], "shape": "polygon", "solid": false,
            "outline": [[0, -0.2], [0.4, -0.2], [0.2, 0], [0.4, 0.2], [0, 0.2]]})",
        R"({"name": "a", "center": [2.2, 1], "size": [0.4, 0.4], "portable": true, "solid": false})",
        R"({"name": "a", "center": [2.2, 1], "size": [0.4, 0.4], "mass": 1, "solid": false})"));

TEST(NotSolidThings, Marking_RobotsMayStartOnIt) {
  const std::string marking =
      R"({"name": "zone", "center": [1, 1], "size": [1, 1], "height": 0.01, "solid": )";
  EXPECT_THROW(static_cast<void>(load_world_text(ghost_world(marking + "true}"))), ConfigError);
  const WorldDescription world = load_world_text(ghost_world(marking + "false}"));
  EXPECT_THAT(true_map(world.arena, *floor_grid(world.arena, 0.1)).cells, Each(0.0F))
      << "a map shows what is in the way";
  Simulation simulation(world);
  for (int i = 0; i < 10; ++i) simulation.step();
  EXPECT_NEAR(ghost_range_m(simulation), 3.0, 0.2) << "over the marking, to the border";
  // Robots without a pose get one as if there were no marking.
  EXPECT_NO_THROW(static_cast<void>(load_world_text(
      R"({"arena": {"size": [1, 1], "obstacles": [{"name": "zone", "center": [0.5, 0.5],)"
      R"("size": [1, 1], "solid": false}]}, "robots": [{}]})")));
}

TEST(NotSolidThings, MapWalls_DrivenThrough) {
  test_support::TemporaryFolder folder;
  // 4 x 2 pixels of 1 m; the third column is dark.
  std::string picture = "P5 4 2 255\n";
  for (const int value : {255, 255, 0, 255, 255, 255, 0, 255}) {
    picture += static_cast<char>(value);
  }
  folder.write("plan.pgm", picture);
  const auto world = [&](const std::string& solid) {
    return load_world(folder.write(
        "w.json", R"({"arena": {"map": {"image": "plan.pgm", "resolution": 1, "solid": )" + solid +
                      R"(}}, "robots": [{"pose": {"x": 1, "y": 1}}]})"));
  };
  Simulation solid(world("true"));
  drive_ahead(solid, 400);
  EXPECT_LT(solid.body(0).X_WB.x_m, 2.0);
  Simulation ghost(world("false"));
  drive_ahead(ghost, 400);
  EXPECT_GT(ghost.body(0).X_WB.x_m, 2.8);
}

TEST(NotSolidThings, Robots_PassThroughEachOther) {
  test_support::TemporaryFolder folder;
  folder.write("ghost.json", R"({"name": "ghost", "solid": false, "devices": {"motion": {}},
    "footprint": [[-0.1, -0.1], [0.1, -0.1], [0.1, 0.1], [-0.1, 0.1]]})");
  Simulation simulation(load_world(folder.write(
      "w.json", R"({"arena": {"size": [4, 2], "obstacles": [{"center": [1.6, 1]}]}, "robots": [
        {"model": "./ghost.json", "pose": {"x": 1, "y": 1}},
        {"name": "r2", "pose": {"x": 2.2, "y": 1, "yaw_deg": 180}}]})")));
  drive_ahead(simulation, 400);
  EXPECT_GT(simulation.body(0).X_WB.x_m, 2.8) << "through an obstacle and a robot";
  EXPECT_EQ(simulation.body(1).X_WB.x_m, 2.2);
  EXPECT_EQ(simulation.statistics(1).collisions, 0);
}

TEST(NotSolidThings, StageModels_WithoutObstacleReturn) {
  test_support::TemporaryFolder folder;
  const WorldDescription world = load_world(folder.write("w.world", R"(
position ( name "r0" size [0.4 0.4 0.2] pose [0 0 0 0] )
position ( name "r1" size [0.4 0.4 0.2] pose [0 0 0 0] obstacle_return 0 )
model ( name "line" size [3 0.1 0.01] pose [0 0 0 0] obstacle_return 0 )
model ( name "zone" size [1 1 0.01] pose [4 0 0 0] obstacle_return 0 ranger_return -1 )
model ( name "fence" size [2 2 1] pose [0 0 0 0] noblocks 1 boundary 1 obstacle_return 0 )
model ( name "puck" size [0.1 0.1 0.1] pose [0.3 0 0 0] gripper_return 1 obstacle_return 0 )
model ( name "box" size [0.1 0.1 0.1] pose [0 3 0 0] )
)"));
  for (const ObstacleDescription& obstacle : world.arena.obstacles) {
    EXPECT_EQ(obstacle.solid, obstacle.name == "box") << obstacle.name;
  }
  EXPECT_THAT(world.arena.obstacles, SizeIs(1 + 1 + 4 + 1 + 1));
  EXPECT_EQ(world.robots[0].pose.x_m, 0.0) << "it stands on the line and in the other robot";
  EXPECT_TRUE(find_robot_model(world, world.robots[0].model)->solid);
  EXPECT_FALSE(find_robot_model(world, world.robots[1].model)->solid);
  EXPECT_THAT(world.notes,
              ElementsAre(HasSubstr("w.world:6: robots drive through this floor plan")));
}

}  // namespace
}  // namespace sim
