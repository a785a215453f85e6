// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <numbers>
#include <utility>

#include "outlines.h"
#include "sim/io/world_io.h"
#include "sim/simulation/simulation.h"
#include "sim/world/outline.h"
#include "sim/world/robot_model.h"

namespace sim::io {
namespace {

using test::box;
using test::circle;
using test::polygon;
using testing::HasSubstr;
using testing::SizeIs;

/// A room of 4 x 4 m with one robot at its centre.
WorldDescription room() {
  WorldDescription world;
  world.arena.size = {4, 4};
  RobotDescription robot;
  robot.name = "r1";
  robot.pose = {2, 2, 0};
  robot.port = 6665;
  world.robots.push_back(robot);
  return world;
}

RobotDescription second_robot(const Pose& pose) {
  RobotDescription robot;
  robot.name = "r2";
  robot.pose = pose;
  robot.port = 6666;
  return robot;
}

std::vector<std::string> ids(const WorldDescription& world) {
  std::vector<std::string> found;
  for (const ConfigIssue& issue : check_world(world)) found.push_back(issue.id);
  return found;
}

TEST(CheckWorld, ValidWorld_NoIssues) { EXPECT_THAT(check_world(room()), SizeIs(0)); }

TEST(CheckWorld, SyrotekArena_NoIssues) {
  WorldDescription world;
  world.arena = syrotek_arena();
  EXPECT_THAT(check_world(world), SizeIs(0));
  for (ObstacleDescription& obstacle : world.arena.obstacles) {
    obstacle.state = ObstacleState::kExtended;
  }
  world.robots = {second_robot(syrotek_start_pose())};
  EXPECT_THAT(check_world(world), SizeIs(0));
}

TEST(CheckWorld, TouchingRobots_AcceptedAndOverlapRefused) {
  // The S1R covers x = 2 - 0.087 to 2 + 0.087; the box begins at the robot's edge.
  WorldDescription world = room();
  world.arena.obstacles = {box("a", {2.087 + 0.1, 2}, {0.2, 0.2})};
  EXPECT_THAT(check_world(world), SizeIs(0));
  world.arena.obstacles[0].center.x() -= 0.01;
  const std::vector<ConfigIssue> issues = check_world(world);
  ASSERT_THAT(issues, SizeIs(1));
  EXPECT_EQ(issues[0].id, "world/robot-overlaps-obstacle");
  EXPECT_EQ(issues[0].pointer, "/robots/0/pose");
  EXPECT_THAT(issues[0].found, HasSubstr("0.01 m"));
}

TEST(CheckWorld, RotatedBoxes_TestedAsPlaced) {
  // A square of 0.2 m rotated by 45 degrees extends 0.1414 m along the axes instead of 0.1 m.
  WorldDescription world = room();
  world.arena.obstacles = {box("a", {2.087 + 0.12, 2}, {0.2, 0.2})};
  EXPECT_THAT(check_world(world), SizeIs(0));
  world.arena.obstacles[0].yaw_rad = std::numbers::pi / 4;
  EXPECT_THAT(ids(world), testing::ElementsAre("world/robot-overlaps-obstacle"));
}

TEST(CheckWorld, RetractedObstacles_DoNotOverlap) {
  WorldDescription world = room();
  world.arena.obstacles = {box("d", {2, 2}, {0.5, 0.5})};
  world.arena.obstacles[0].type = ObstacleType::kDynamic;
  world.arena.obstacles[0].state = ObstacleState::kRetracted;
  EXPECT_THAT(check_world(world), SizeIs(0));
  world.arena.obstacles[0].state = ObstacleState::kExtended;
  EXPECT_THAT(ids(world), testing::ElementsAre("world/robot-overlaps-obstacle"));
}

TEST(CheckWorld, RobotInsideLargeBox_Overlaps) {
  WorldDescription world = room();
  world.arena.obstacles = {box("a", {2, 2}, {3, 3})};
  EXPECT_THAT(ids(world), testing::ElementsAre("world/robot-overlaps-obstacle"));
}

TEST(CheckWorld, EachSideOfFloor_Named) {
  WorldDescription world = room();
  const std::pair<Pose, const char*> cases[] = {{{0.05, 2, 0}, "left"},
                                                {{3.95, 2, 0}, "right"},
                                                {{2, 0.05, 0}, "bottom"},
                                                {{2, 3.95, 0}, "top"}};
  for (const auto& [pose, side] : cases) {
    world.robots[0].pose = pose;
    const std::vector<ConfigIssue> issues = check_world(world);
    ASSERT_THAT(issues, SizeIs(1));
    EXPECT_EQ(issues[0].id, "world/robot-outside");
    EXPECT_THAT(issues[0].found, HasSubstr(side));
  }
}

TEST(CheckWorld, RobotsSideBySide_MayOverlapInCircles) {
  // Two parallel S1Rs side by side are 0.162 m apart when they touch.
  WorldDescription world = room();
  world.robots.push_back(second_robot({2, 2.163, 0}));
  EXPECT_THAT(check_world(world), SizeIs(0));
  world.robots[1].pose.y_m = 2.152;
  const std::vector<ConfigIssue> issues = check_world(world);
  ASSERT_THAT(issues, SizeIs(1));
  EXPECT_EQ(issues[0].id, "world/robots-overlap");
  EXPECT_EQ(issues[0].pointer, "/robots/1/pose");
  EXPECT_THAT(issues[0].found, HasSubstr("0.01 m"));
  EXPECT_THAT(issues[0].expected, HasSubstr("r1"));
}

TEST(CheckWorld, Walls_SolidOnTheirLeft) {
  // A ring: solid between the squares of 4 m and 2 m, free inside.
  WorldDescription world = room();
  world.arena.walls = {{{{0, 0}, {4, 0}, {4, 4}, {0, 4}}}, {{{1, 1}, {1, 3}, {3, 3}, {3, 1}}}};
  EXPECT_THAT(check_world(world), SizeIs(0));
  world.robots[0].pose = {2.95, 2, 0};  // on the inner outline
  EXPECT_THAT(ids(world), testing::ElementsAre("world/robot-overlaps-wall"));
  world.robots[0].pose = {3.5, 2, 0};  // in the solid, on no edge
  EXPECT_THAT(ids(world), testing::ElementsAre("world/robot-overlaps-wall"));
}

TEST(CheckWorld, SmallPillarUnderRobot_Found) {
  // 1 cm wide, between the robot's centre and its outline: it crosses no side of the outline.
  WorldDescription world = room();
  world.arena.walls = {{{{2.03, 2.0}, {2.04, 2.0}, {2.04, 2.01}, {2.03, 2.01}}}};
  EXPECT_THAT(ids(world), testing::ElementsAre("world/robot-overlaps-wall"));
}

TEST(CheckWorld, DuplicateNamesAndPorts_Reported) {
  WorldDescription world = room();
  world.robots.push_back(second_robot({1, 1, 0}));
  world.robots[1].name = "r1";
  world.robots[1].port = 6665;
  world.arena.obstacles = {box("a", {3, 3}, {0.1, 0.1})};
  world.arena.dock_separators = {box("a", {3, 1}, {0.1, 0.1})};
  world.arena.docks = {{"d", {1, 3, 0}, {0.2, 0.2}}, {"d", {1, 2, 0}, {0.2, 0.2}}};
  std::vector<std::string> places;
  for (const ConfigIssue& issue : check_world(world)) {
    places.push_back(issue.id + " " + issue.pointer);
  }
  EXPECT_THAT(places,
              testing::UnorderedElementsAre("world/duplicate-name /arena/dock_separators/0/name",
                                            "world/duplicate-name /arena/docks/1/name",
                                            "world/duplicate-name /robots/1/name",
                                            "world/duplicate-port /robots/1/port"));
}

TEST(CheckWorld, BlocksAndDocksOffFloor_Reported) {
  WorldDescription world = room();
  world.arena.origin = {-1, -1};  // floor to (3, 3)
  world.arena.obstacles = {box("a", {2.9, 0}, {0.2, 0.2}), box("b", {2.95, 0}, {0.2, 0.2})};
  world.arena.docks = {{"d", {-0.95, 0, 0}, {0.24, 0.24}}};
  std::vector<std::string> places;
  for (const ConfigIssue& issue : check_world(world)) {
    places.push_back(issue.id + " " + issue.pointer);
  }
  EXPECT_THAT(places, testing::ElementsAre("world/obstacle-outside /arena/obstacles/1",
                                           "world/obstacle-outside /arena/docks/0"));
}

TEST(CheckWorld, Pointers_LeaveOutPreset) {
  WorldDescription world;
  world.arena = syrotek_arena();
  world.arena.obstacles.push_back(box("mine", {3.5, 1}, {0.2, 0.2}));
  const std::vector<ConfigIssue> issues = check_world(world);
  ASSERT_THAT(issues, SizeIs(1));
  EXPECT_EQ(issues[0].pointer, "/arena/obstacles/0");
}

TEST(CheckWorld, CanvasSize_Limited) {
  WorldDescription world = room();
  world.canvas.width = 0;
  world.canvas.cell_size_m = 0.0;
  EXPECT_THAT(ids(world), testing::ElementsAre("world/out-of-range", "world/out-of-range"));
}

/// The first issue of a world, as "pointer: message".
std::string first_issue(const WorldDescription& world) {
  const std::vector<ConfigIssue> issues = check_world(world);
  return issues.empty() ? "" : issues.front().pointer + ": " + issues.front().message();
}

TEST(CheckWorld, RefusesSidesTooShortForPhysics) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInf = std::numeric_limits<double>::infinity();
  for (const double side_m : {1e-4, 1e-300, 9.99e-4, 0.0, -1.0, kNan, kInf, 2e4}) {
    WorldDescription world = room();
    world.arena.obstacles.push_back(box("o1", {1, 1}, {2.0, side_m}));
    EXPECT_THAT(first_issue(world), HasSubstr("/arena/obstacles/0/size/1: expected a number from "
                                              "0.001 to 10000 m, found"))
        << side_m;
    world = room();
    world.arena.dock_separators.push_back(box("s1", {1, 1}, {side_m, 1.0}));
    EXPECT_THAT(first_issue(world), HasSubstr("/arena/dock_separators/0/size/0: ")) << side_m;
    world = room();
    world.arena.docks.push_back({"d1", {1, 1, 0}, {side_m, 1.0}});
    EXPECT_THAT(first_issue(world), HasSubstr("/arena/docks/0/size/0: ")) << side_m;
    world = room();
    world.arena.size = {side_m, 4.0};
    EXPECT_THAT(first_issue(world), HasSubstr("/arena/size/0: ")) << side_m;
  }
  WorldDescription least = room();
  least.arena.obstacles.push_back(box("o1", {1, 1}, {0.001, 0.001}, 0.3));
  EXPECT_THAT(check_world(least), SizeIs(0));
}

TEST(CheckWorld, RefusesDistancesTooSmallForPhysics) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInf = std::numeric_limits<double>::infinity();
  for (const double x_m : {1e6, -1e9, 1e300, kNan, kInf}) {
    WorldDescription world = room();
    world.arena.obstacles.push_back(box("o1", {x_m, 1}, {0.2, 0.2}));
    EXPECT_THAT(first_issue(world), HasSubstr("/arena/obstacles/0/center: ")) << x_m;
    world = room();
    world.robots[0].pose.x_m = x_m;
    EXPECT_THAT(first_issue(world), HasSubstr("/robots/0/pose: ")) << x_m;
    world = room();
    world.arena.origin = {x_m, 0.0};
    EXPECT_THAT(first_issue(world), HasSubstr("/arena/origin: ")) << x_m;
  }
  // A millionth of 5 km is 5 mm.
  WorldDescription world = room();
  world.arena.origin = {4998, 0};
  world.robots[0].pose = {5000, 2, 0};
  world.arena.obstacles.push_back(box("o1", {4999, 1}, {0.003, 0.2}));
  EXPECT_THAT(first_issue(world), HasSubstr("sides of at least 0.0049"));
  world.arena.obstacles[0].size = {0.006, 0.2};
  EXPECT_THAT(check_world(world), SizeIs(0));
}

TEST(CheckWorld, RefusesModelsTooSmallForPhysics) {
  const auto issue_of = [](const auto& edit) {
    WorldDescription world = room();
    auto model = std::make_shared<RobotModel>(s1r_model());
    edit(*model);
    world.models["toy"] = model;
    world.robots[0].model = "toy";
    return first_issue(world);
  };
  EXPECT_EQ(issue_of([](RobotModel&) {}), "");
  EXPECT_THAT(issue_of([](RobotModel& m) { m.drive.wheel_radius_m = 1e-300; }),
              HasSubstr("/robots/0/model/drive/wheel_radius: "));
  EXPECT_THAT(issue_of([](RobotModel& m) { m.drive.wheel_separation_m = 0.0; }),
              HasSubstr("/robots/0/model/drive/wheel_separation: "));
  EXPECT_THAT(issue_of([](RobotModel& m) { m.height_m = 1e-4; }), HasSubstr("/model/height: "));
  EXPECT_THAT(issue_of([](RobotModel& m) { m.mass_kg = 1e-300; }), HasSubstr("/model/mass: "));
  EXPECT_THAT(issue_of([](RobotModel& m) { m.footprint.clear(); }), HasSubstr("3 to 8 points"));
  EXPECT_THAT(issue_of([](RobotModel& m) {
                m.footprint = {{-50, 0}, {50, 0}, {50, 1e-5}, {-50, 1e-5}};
              }),
              HasSubstr("at least 0.001 m wide"));
  EXPECT_THAT(issue_of([](RobotModel& m) { m.footprint[0].x() = 1e30; }),
              HasSubstr("at most 100 m from the middle"));
  EXPECT_THAT(issue_of([](RobotModel& m) { std::reverse(m.footprint.begin(), m.footprint.end()); }),
              HasSubstr("convex"));
}

TEST(CheckWorld, RefusesWallsTooThinForPhysics) {
  WorldDescription world = room();
  world.arena.walls = {{{{1, 1}, {1.0005, 1}, {1, 2}}}};
  EXPECT_THAT(first_issue(world), HasSubstr("/arena/map/resolution: "));
  world.arena.walls = {{{{1, 1}, {1, 2}}}};
  EXPECT_THAT(first_issue(world), HasSubstr("walls of at least 3 vertices"));
  world.arena.walls = {{{{1, 1}, {1e30, 1}, {1, 2}}}};
  EXPECT_THAT(first_issue(world), HasSubstr("/arena/map/origin: "));
}

TEST(CheckWorld, ShapesFromPrograms_Checked) {
  WorldDescription world = room();
  world.arena.obstacles = {circle("c", {1, 1}, 0.3),
                           polygon("p", {3, 3}, {{0, 0}, {0.5, 0}, {0, 0.5}})};
  EXPECT_THAT(check_world(world), SizeIs(0));
  ObstacleDescription& c = world.arena.obstacles[0];
  c.size.x() = 0.5;
  EXPECT_THAT(first_issue(world), HasSubstr("/arena/obstacles/0/radius: "));
  make_circle(c, std::numeric_limits<double>::quiet_NaN());
  EXPECT_THAT(first_issue(world), HasSubstr("/arena/obstacles/0/radius: "));
  make_circle(c, 0.3);
  ObstacleDescription& p = world.arena.obstacles[1];
  std::reverse(p.outline.begin(), p.outline.end());
  EXPECT_THAT(first_issue(world), HasSubstr("counter-clockwise"));
  make_polygon(p, {{0, 0}, {0.5, 0}, {0, std::numeric_limits<double>::quiet_NaN()}});
  EXPECT_THAT(first_issue(world), HasSubstr("/arena/obstacles/1/outline: "));
  make_polygon(p, {{0, 0}, {0.5, 0}, {0, 0.5}});
  p.size = {0.2, 0.2};
  EXPECT_THAT(first_issue(world), HasSubstr("make_polygon()"));
  p.outline.clear();
  EXPECT_THAT(first_issue(world), HasSubstr("3 to 64 points"));
}

TEST(CheckWorld, TouchingCircle_DoesNotOverlap) {
  // The S1R's front is 0.087 m ahead of (2, 2), its front left corner at (2.087, 2.045).
  WorldDescription world = room();
  world.arena.obstacles = {circle("c", {2.587, 2}, 0.5)};
  EXPECT_THAT(ids(world), SizeIs(0));
  world.arena.obstacles = {circle("c", {2.586, 2}, 0.5)};
  EXPECT_THAT(first_issue(world), HasSubstr("overlapping it by 0.001 m"));
  const double diagonal_m = 0.3 / std::numbers::sqrt2;
  // Its corner towards the circle: bounding boxes overlap, the outlines do not.
  world.arena.obstacles = {circle("c", {2.087 + diagonal_m, 2.045 + diagonal_m}, 0.299)};
  EXPECT_THAT(ids(world), SizeIs(0));
  world.arena.obstacles = {circle("c", {2.087 + diagonal_m, 2.045 + diagonal_m}, 0.302)};
  EXPECT_THAT(first_issue(world), HasSubstr("overlapping it by 0.002 m"));
  world.arena.obstacles = {circle("c", {2, 2}, 1.5)};
  EXPECT_THAT(first_issue(world), HasSubstr("obstacle c"));
}

TEST(CheckWorld, FreePlaces_FoundBesideCirclesAndPolygons) {
  const WorldDescription world = load_world_text(
      R"({"arena": {"size": [4, 4], "obstacles": [
           {"shape": "circle", "center": [2, 2], "radius": 1},
           {"shape": "polygon", "center": [0, 0], "outline": [[0, 0], [4, 0], [4, 0.9], [0, 0.9]]}]}})");
  EXPECT_THAT(check_world(world), SizeIs(0));
  EXPECT_GT((world.robots[0].pose.position() - Vec2(2, 2)).norm(), 1.08);
}

}  // namespace
}  // namespace sim::io
