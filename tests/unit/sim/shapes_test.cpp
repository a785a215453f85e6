// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Round and polygonal obstacles: what sensors see of them, and how they stop robots.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "circle_range.h"
#include "outlines.h"
#include "physics/physics_world.h"
#include "polygon_overlap.h"
#include "random_numbers.h"
#include "sim/devices/blobfinder.h"
#include "sim/devices/bumper.h"
#include "sim/devices/camera.h"
#include "sim/devices/contact_sensors.h"
#include "sim/devices/fiducial.h"
#include "sim/devices/gripper.h"
#include "sim/devices/laser.h"
#include "sim/devices/rangers.h"
#include "sim/render/render.h"
#include "sim/simulation/simulation.h"
#include "sim/world/occupancy_map.h"
#include "sim/world/outline.h"

namespace sim {
namespace {

using test::circle;
using test::circle_range_m;
using test::kNotch;
using test::polygon;
using test::Random;
using testing::HasSubstr;
using Kind = PhysicsWorld::Contact::Kind;

constexpr double kPi = std::numbers::pi;
constexpr double kStep_s = 0.01;
const PhysicsWorld::Contact kNothing{-1, Kind::kObstacle, -1};

ArenaDescription floor_of(double side_m, std::vector<ObstacleDescription> obstacles) {
  ArenaDescription arena;
  arena.size = {side_m, side_m};
  arena.obstacles = std::move(obstacles);
  return arena;
}

void run(PhysicsWorld& world, int steps) {
  for (int i = 0; i < steps; ++i) world.step(kStep_s);
}

double distance_to_circle_m(const PhysicsWorld& world, int robot, const Vec2& center,
                            double radius_m) {
  const Polygon outline = test::placed(s1r_model().footprint, world.body(robot).X_WB);
  return test::distance_to_outline_m(center, outline) - radius_m;
}

// A room with a circle, a convex and a concave polygon, for a robot at (1, 1).
WorldDescription three_shapes(const std::string& devices, const std::string& more = "") {
  return load_world_text(
      R"({"arena": {"size": [6, 6], "obstacles": [
        {"name": "pillar", "shape": "circle", "center": [3, 1], "radius": 0.4, "colour": "#f00",
         "fiducial": 7},
        {"name": "wedge", "shape": "polygon", "center": [1, 3], "outline": [[0, 0], [1, 0], [0, 1]],
         "type": "dynamic", "state": "extended"},
        {"name": "notch", "shape": "polygon", "center": [3, 3.5], "yaw_deg": 10,
         "outline": [[0, 0], [1.4, 0], [1.4, 1.2], [1.2, 1.2], [1.2, 0.2], [0.2, 0.2], [0.2, 1.2],
                     [0, 1.2]]},
        {"name": "puck", "shape": "circle", "center": [5.5, 0.5], "radius": 0.02,
         "portable": true}]},
       "robots": [{"name": "r1", "pose": {"x": 1, "y": 1}, "devices": )" +
      devices + "}" + more + "]}");
}

template <typename DeviceType>
const DeviceType& device(const Simulation& simulation, int robot, const std::string& name) {
  return dynamic_cast<const DeviceType&>(
      simulation.device(robot, simulation.find_device(robot, name).value()));
}

void run(Simulation& simulation, int steps) {
  for (int i = 0; i < steps; ++i) simulation.step();
}

TEST(Shapes, Circle_LaserExact) {
  Simulation simulation(three_shapes(R"({"laser": {"noise": 0, "range_max": 6}})"));
  run(simulation, 20);
  const LaserReading& scan = device<Laser>(simulation, 0, "laser").reading();
  const Pose X_WL = scan.X_WB * device<Laser>(simulation, 0, "laser").params().X_BL;
  int met = 0;
  for (std::size_t beam = 0; beam < scan.ranges_m.size(); ++beam) {
    const double angle_rad =
        X_WL.yaw_rad + scan.angle_min_rad + scan.resolution_rad * static_cast<double>(beam);
    const double expected_m = circle_range_m(X_WL.position(), angle_rad, {3, 1}, 0.4, 6.0);
    if (expected_m == 6.0) continue;
    ++met;
    EXPECT_NEAR(scan.ranges_m[beam], expected_m, 1e-6);
  }
  // 2 asin(0.4 / 2) = 23 degrees of 0.36 degrees each.
  EXPECT_NEAR(met, 2.0 * std::asin(0.4 / (3.0 - X_WL.x_m)) / scan.resolution_rad, 2.0);
}

TEST(Shapes, Scans_MatchRayCastsInSmallAndLargeWorlds) {
  for (const int boxes : {0, 200}) {
    std::vector<ObstacleDescription> obstacles{circle("c", {3, 1}, 0.4),
                                               polygon("wedge", {1, 3}, {{0, 0}, {1, 0}, {0, 1}}),
                                               polygon("notch", {3, 3.5}, kNotch, 0.2)};
    // Boxes far away, so that the search for edges uses Box2D's tree.
    for (int i = 0; i < boxes; ++i) {
      ObstacleDescription o;
      o.name = "b" + std::to_string(i);
      o.center = {20.0 + i % 20, 20.0 + i / 20};
      obstacles.push_back(o);
    }
    const PhysicsWorld physics(floor_of(45.0, obstacles));
    const scan::ScanGeometry geometry{361, kPi / 180.0, 8.0};
    std::vector<double> ranges(361);
    Random random(4);
    for (int i = 0; i < 300; ++i) {
      const Pose X_WL{random.uniform(0.1, 5.9), random.uniform(0.1, 5.9), random.uniform(-3, 3)};
      physics.scan(geometry, X_WL, 0.1, -1, true, ranges);
      if (physics.is_inside_solid(X_WL.position(), 0.1, -1)) {
        EXPECT_THAT(ranges, testing::Each(0.0));
        continue;
      }
      int differ = 0;
      for (int beam = 0; beam < 361; ++beam) {
        const double cast_m =
            physics.ray_cast_m(X_WL.position(), X_WL.yaw_rad + geometry.angle_rad(beam), 8.0, -1);
        if (std::abs(ranges[static_cast<std::size_t>(beam)] - cast_m) > 1e-4) ++differ;
      }
      EXPECT_LE(differ, 2) << "beams that pass a corner closely";
    }
  }
}

TEST(Shapes, Inside_Exact) {
  const PhysicsWorld physics(
      floor_of(6.0, {circle("c", {3, 1}, 0.4), polygon("notch", {3, 3.5}, kNotch),
                     polygon("wedge", {1, 3}, {{0, 0}, {1, 0}, {0, 1}})}));
  EXPECT_TRUE(physics.is_inside_solid({3.0, 1.3999}, 0.1, -1));
  EXPECT_FALSE(physics.is_inside_solid({3.0, 1.4001}, 0.1, -1)) << "not its skin";
  EXPECT_TRUE(physics.is_inside_solid({3.0, 1.0}, 0.16, -1)) << "at its top";
  EXPECT_FALSE(physics.is_inside_solid({3.0, 1.0}, 0.161, -1)) << "above it";
  EXPECT_TRUE(physics.is_inside_solid({3.1, 4.5}, 0.1, -1));
  EXPECT_FALSE(physics.is_inside_solid({3.7, 4.5}, 0.1, -1)) << "within the notch";
  EXPECT_FALSE(physics.is_inside_solid({3.1, 4.5}, 0.2, -1)) << "above it";
  EXPECT_TRUE(physics.is_inside_solid({1.4, 3.4}, 0.1, -1));
  EXPECT_FALSE(physics.is_inside_solid({1.6, 3.6}, 0.1, -1));
}

TEST(Shapes, LinesOfSight_PassCircleClosely) {
  const PhysicsWorld physics(floor_of(6.0, {circle("c", {3, 3}, 0.5)}));
  const auto is_free = [&](double y) {
    return physics.is_line_free({1, y}, {5, y}, 0.1, -1, kNothing);
  };
  EXPECT_FALSE(is_free(3.4999));
  EXPECT_TRUE(is_free(3.5001)) << "through its skin in Box2D";
  EXPECT_TRUE(physics.is_line_free({1, 3}, {2.4999, 3}, 0.1, -1, kNothing)) << "ends before it";
  EXPECT_FALSE(physics.is_line_free({1, 3}, {2.5001, 3}, 0.1, -1, kNothing));
  EXPECT_TRUE(physics.is_line_free({1, 3}, {5, 3}, 0.161, -1, kNothing)) << "above it";
  EXPECT_TRUE(physics.is_line_free({1, 3}, {5, 3}, 0.1, -1, {-1, Kind::kObstacle, 0})) << "to it";
  EXPECT_TRUE(physics.is_line_free({3, 3}, {5, 3}, 0.1, -1, kNothing)) << "from within it";
  // From within the skin of 1 mm towards the circle.
  EXPECT_FALSE(physics.is_line_free({2.4995, 3}, {5, 3}, 0.1, -1, kNothing));
}

TEST(Shapes, SonarAndInfrared_MeasureCircle) {
  // Sonar 1 looks ahead from 0.081 m before the axle's centre, with a cone of 30 degrees.
  Simulation simulation(three_shapes(
      R"({"sonar": {"type": "sonar", "noise": 0}, "infrared": {"type": "infrared", "noise": 0, "range_max": 2}})"));
  run(simulation, 20);
  EXPECT_NEAR(device<Ranger>(simulation, 0, "sonar").reading().ranges_m[1], 2.0 - 0.4 - 0.081,
              1e-9);
  EXPECT_NEAR(device<Ranger>(simulation, 0, "infrared").reading().ranges_m[0], 2.0 - 0.4 - 0.081,
              1e-9);
}

TEST(Shapes, Blobfinder_SeesCircleBetweenTangents) {
  Simulation simulation(three_shapes(
      R"({"blobfinder": {"image": [200, 100], "field_of_view_deg": 60, "noise": 0, "pose": {"x": 0}, "height": 0.1}})"));
  run(simulation, 20);
  const Blobfinder& finder = device<Blobfinder>(simulation, 0, "blobfinder");
  ASSERT_EQ(finder.reading().blobs.size(), 1U);
  const BlobfinderReading::Blob& blob = finder.reading().blobs[0];
  // The tangents are at +- asin(0.4 / 2) from ahead: a slope of 0.2 / sqrt(1 - 0.04) = 0.2041. The
  // focal length is 100 / tan(30) = 173.2 pixels, so they are 35.36 pixels beside the middle.
  EXPECT_EQ(blob.left, 65);    // its centre is 34.5 pixels to the left
  EXPECT_EQ(blob.right, 134);  // and 34.5 to the right
  // The mean of the ranges of these columns.
  double sum_m = 0.0;
  for (int column = 65; column <= 134; ++column) {
    const double angle_rad = std::atan((99.5 - column) / (100.0 / std::tan(kPi / 6.0)));
    sum_m += circle_range_m({1, 1}, angle_rad, {3, 1}, 0.4, 9.0);
  }
  EXPECT_NEAR(blob.range_m, sum_m / 70.0, 1e-9);
}

TEST(Shapes, Camera_SeesTopOfLowCircle) {
  Simulation simulation(three_shapes(
      R"({"camera": {"image": [200, 100], "field_of_view_deg": 60, "pose": {"x": 0}, "height": 0.3}})"));
  run(simulation, 20);
  const CameraReading& picture = device<Camera>(simulation, 0, "camera").reading();
  const auto is_red = [&](int column, int row) {
    const auto at = 3 * static_cast<std::size_t>(row * 200 + column);
    return picture.pixels[at] > 80 && picture.pixels[at + 1] < 40;
  };
  // The lens is 0.14 m above the top and 0.3 m above the floor. With a focal length of 173.2 pixels
  // the foot in front (1.6 m) is 32.5 rows below the horizon (row 50), and the rear rim of the top
  // (2.4 m) 10.1 rows.
  EXPECT_TRUE(is_red(100, 81));
  EXPECT_FALSE(is_red(100, 83));
  EXPECT_TRUE(is_red(100, 61));
  EXPECT_FALSE(is_red(100, 58));
}

TEST(Shapes, Fiducial_OfCircleSeenUnlessHidden) {
  Simulation simulation(three_shapes(
      R"({"fiducial": {"noise": 0, "noise_bearing_deg": 0, "noise_yaw_deg": 0, "pose": {"x": 0}}})"));
  run(simulation, 30);
  const FiducialReading& reading = device<FiducialFinder>(simulation, 0, "fiducial").reading();
  ASSERT_EQ(reading.marks.size(), 1U);
  EXPECT_EQ(reading.marks[0].id, 7);
  EXPECT_NEAR(reading.marks[0].X_ST.x_m, 2.0, 1e-9);
}

// --- physics

TEST(Shapes, Robot_StopsAtCircle) {
  PhysicsWorld world(floor_of(6.0, {circle("c", {3, 3}, 0.3)}));
  world.add_robot(s1r_model(), {2.0, 3.0, 0.0});
  world.set_target(0, {0.5, 0.0, 0.0});
  run(world, 300);
  // The front is 0.087 m ahead; bodies rest 1.5 mm apart, within Box2D's tolerance of 0.5 mm.
  EXPECT_NEAR(world.body(0).X_WB.x_m, 3.0 - 0.3 - 0.087 - 0.0015, 6e-4);
  EXPECT_TRUE(world.body(0).stalled);
  const std::vector<PhysicsWorld::Contact> contacts = world.contacts_of(0);
  ASSERT_EQ(contacts.size(), 1U);
  EXPECT_EQ(contacts[0].kind, Kind::kObstacle);
  const auto touches = world.touches_of(0);
  ASSERT_EQ(touches.size(), 1U);
  EXPECT_NEAR((touches[0].p_WA - Vec2(2.7, 3.0)).norm(), 0.0, 2e-3);
}

TEST(Shapes, GrazedCircle_TurnsRobot) {
  for (const double radius_m : {0.05, 0.3, 1.0}) {
    PhysicsWorld world(floor_of(8.0, {circle("c", {4, 4}, radius_m)}));
    const double start_x = 4.0 - radius_m - 0.4;
    // Its front right corner meets the circle where the normal is 65 degrees aside.
    world.add_robot(s1r_model(), {start_x, 4.0 + 0.9 * radius_m + 0.081, 0.0});
    world.set_target(0, {0.3, 0.0, 0.0});
    double closest_m = 1.0;
    for (int i = 0; i < 1500; ++i) {
      world.step(kStep_s);
      closest_m = std::min(closest_m, distance_to_circle_m(world, 0, {4, 4}, radius_m));
    }
    EXPECT_GT(closest_m, 0.0) << "of a circle of " << radius_m << " m";
    EXPECT_GT(world.body(0).X_WB.x_m, 4.0) << "it gets past a circle of " << radius_m << " m";
    EXPECT_GT(world.body(0).X_WB.yaw_rad, 0.0) << "it turned away";
  }
}

TEST(Shapes, RandomRobots_DoNotOverlapCircles) {
  std::vector<ObstacleDescription> obstacles;
  Random random(5);
  for (int i = 0; i < 12; ++i) {
    obstacles.push_back(circle("c" + std::to_string(i), {0.7 + 1.2 * (i % 4), 0.7 + 1.6 * (i / 4)},
                               random.uniform(0.003, 0.35)));
  }
  PhysicsWorld world(floor_of(5.0, obstacles));
  for (int i = 0; i < 4; ++i) world.add_robot(s1r_model(), {0.3 + 1.3 * i, 1.5, 1.0 * i});
  double deepest_m = 1.0;
  for (int step = 0; step < 6000; ++step) {
    if (step % 60 == 0) {
      for (int i = 0; i < 4; ++i) {
        world.set_target(i, {random.uniform(-0.5, 0.5), random.uniform(-4.0, 4.0)});
      }
    }
    world.step(kStep_s);
    for (int i = 0; i < 4; ++i) {
      for (const ObstacleDescription& o : obstacles) {
        deepest_m = std::min(deepest_m, distance_to_circle_m(world, i, o.center, radius_m(o)));
      }
    }
  }
  EXPECT_GT(deepest_m, -0.0005);
  EXPECT_LT(deepest_m, 0.002) << "some touched";
}

TEST(Shapes, SpinBesideLargeCircle_DoesNotOverlap) {
  for (const double radius_m : {0.1, 0.5, 1.0, 3.0}) {
    PhysicsWorld world(floor_of(12.0, {circle("c", {6, 6}, radius_m)}));
    world.add_robot(s1r_model(), {6.0 - radius_m - 0.2, 6.0, 0.0});
    world.set_target(0, {0.3, 0.0, 0.0});
    run(world, 100);
    double closest_m = 1.0;
    for (int i = 0; i < 300; ++i) {
      world.set_target(0, {0.05, (i / 50) % 2 == 0 ? 6.0 : -6.0, 0.0});
      world.step(kStep_s);
      closest_m = std::min(closest_m, distance_to_circle_m(world, 0, {6, 6}, radius_m));
    }
    EXPECT_GT(closest_m, -0.0005) << "of a circle of " << radius_m << " m";
  }
}

TEST(Shapes, Notch_RobotStopsAtItsEnd) {
  PhysicsWorld world(floor_of(6.0, {polygon("notch", {2, 2}, kNotch)}));
  world.add_robot(s1r_model(), {2.7, 4.0, -0.5 * kPi});
  world.set_target(0, {0.4, 0.0, 0.0});
  run(world, 800);
  // The end of the notch is at y = 2.2.
  EXPECT_NEAR(world.body(0).X_WB.y_m, 2.2 + 0.087 + 0.0015, 6e-4);
  EXPECT_NEAR(world.body(0).X_WB.x_m, 2.7, 1e-3);
  EXPECT_FALSE(world.contacts_of(0).empty());
}

TEST(Shapes, PolygonOfManySides_RobotSlidesAlong) {
  // A disc of 40 sides: the joints between its sides do not stop a robot.
  Polygon outline;
  for (int i = 0; i < 40; ++i) {
    outline.push_back(0.5 * Vec2(std::cos(kPi * i / 20.0), std::sin(kPi * i / 20.0)));
  }
  PhysicsWorld world(floor_of(6.0, {polygon("disc", {3, 3}, outline)}));
  world.add_robot(s1r_model(), {2.0, 3.0 + 0.9 * 0.5 + 0.081, 0.0});
  world.set_target(0, {0.3, 0.0, 0.0});
  double closest_m = 1.0;
  for (int i = 0; i < 1200; ++i) {
    world.step(kStep_s);
    closest_m = std::min(closest_m, distance_to_circle_m(world, 0, {3, 3}, 0.4985));
  }
  EXPECT_GT(closest_m, 0.0);  // the sides are 0.5 cos(pi / 40) = 0.4985 m from the centre
  EXPECT_GT(world.body(0).X_WB.x_m, 3.0);
}

TEST(Shapes, Clearance_DistanceToOutline) {
  PhysicsWorld world(
      floor_of(8.0, {circle("c", {5, 4}, 0.3), polygon("notch", {3.4, 0.5}, kNotch)}));
  world.add_robot(s1r_model(), {4.0, 4.0, 0.0});
  EXPECT_NEAR(world.clearance_m(0, 3.0, 3.0), 1.0 - 0.3 - 0.087, 1e-5);
  world.set_pose(0, {4.1, 1.4, 0.0});  // in the notch, which reaches from x = 3.6 to 4.6
  EXPECT_NEAR(world.clearance_m(0, 3.0, 3.0), 0.5 - 0.087, 1e-5);
}

TEST(Shapes, RobotWithin_ExactExceptForSkins) {
  PhysicsWorld world(floor_of(8.0, {}));
  world.add_robot(s1r_model(), {4.0, 4.0, 0.0});
  EXPECT_EQ(world.robot_within(circle("c", {4.387 + 0.003, 4.0}, 0.3)), -1);
  EXPECT_EQ(world.robot_within(circle("c", {4.387 - 0.001, 4.0}, 0.3)), 0);
  EXPECT_EQ(world.robot_within(polygon("n", {3.3, 3.5}, kNotch)), -1) << "within its notch";
  EXPECT_EQ(world.robot_within(polygon("n", {3.45, 3.5}, kNotch)), -1);
  EXPECT_EQ(world.robot_within(polygon("n", {3.3, 3.9}, kNotch)), 0);
  Polygon large = kNotch;
  for (Vec2& p : large) p *= 5.0;
  EXPECT_EQ(world.robot_within(polygon("n", {3.5, 3.5}, large)), 0) << "wholly in it, at no side";
}

// --- simulations

TEST(Shapes, DynamicCircleAndPolygon_RefuseToRiseUnderRobot) {
  for (
      const char* shape :
      {R"("shape": "circle", "radius": 0.3)",
       R"("shape": "polygon", "outline": [[-0.4, -0.4], [0.4, -0.4], [0.4, 0.4], [0, 0.2], [-0.4, 0.4]])"}) {
    Simulation simulation(load_world_text(
        std::string(R"({"arena": {"size": [4, 4], "obstacles": [{"name": "d", "center": [2, 2], )"
                    R"("type": "dynamic", "state": "retracted", )") +
        shape + R"(}]}, "robots": [{"pose": {"x": 2, "y": 2}}]})"));
    EXPECT_THAT(simulation.set_obstacle_state("d", ObstacleState::kExtended).value(),
                HasSubstr("a robot stands on it"));
    ASSERT_FALSE(simulation.place_object("r1", {0.5, 0.5, 0.0}));
    EXPECT_FALSE(simulation.set_obstacle_state("d", ObstacleState::kExtended));
    run(simulation, 2);
    EXPECT_THAT(simulation.place_object("r1", {2, 2, 0}).value(), HasSubstr("obstacle d"));
    EXPECT_FALSE(simulation.set_obstacle_state("d", ObstacleState::kRetracted));
    EXPECT_FALSE(simulation.place_object("r1", {2, 2, 0}));
  }
}

TEST(Shapes, Size_ScalesCirclesAndPolygons) {
  Simulation simulation(three_shapes("{}"));
  EXPECT_EQ(simulation.find_object("pillar")->size, Vec2(0.8, 0.8));
  EXPECT_THAT(simulation.set_block_size("pillar", {1.0, 0.9}, 0.2).value(), HasSubstr("a circle"));
  EXPECT_FALSE(simulation.set_block_size("pillar", {1.0, 1.0}, 0.2));
  EXPECT_EQ(simulation.find_object("pillar")->size, Vec2(1.0, 1.0));
  EXPECT_EQ(simulation.find_object("wedge")->size, Vec2(1.0, 1.0));
  EXPECT_FALSE(simulation.set_block_size("wedge", {2.0, 0.5}, 0.2));
  const std::vector<ObstacleDescription>& obstacles = simulation.world().arena.obstacles;
  EXPECT_THAT(obstacles[1].outline, testing::ElementsAre(Vec2(0, 0), Vec2(2, 0), Vec2(0, 0.5)));
  EXPECT_THAT(simulation.set_block_size("wedge", {2.0, 1e-3}, 0.2).value(), HasSubstr("0.001"));
}

TEST(Shapes, BumperAndCollisionSensor_FeelCircle) {
  Simulation simulation(three_shapes(R"({"bumper": {}, "collision": {}})"));
  const int motion = simulation.find_device(0, "motion").value();
  ASSERT_FALSE(simulation.apply({0, motion}, TwistCommand{{.v_mps = 0.4}}));
  run(simulation, 600);
  const auto& bumper = device<Bumper>(simulation, 0, "bumper");
  int pressed = 0;
  for (std::size_t i = 0; i < bumper.segments().size(); ++i) {
    if (bumper.reading().pressed[i] == 0) continue;
    ++pressed;
    EXPECT_NEAR(bumper.segments()[i].X_BS.yaw_rad, 0.0, 1e-9) << "only the front";
  }
  EXPECT_EQ(pressed, 1);
  EXPECT_THAT(device<CollisionSensor>(simulation, 0, "collision").reading().objects,
              testing::ElementsAre("pillar"));
}

TEST(Shapes, GrippedPuck_VisibleToOthers) {
  Simulation simulation(three_shapes(
      R"({"gripper": {"length": 0.08, "opening": 0.12, "travel_time": 1}})",
      R"(, {"name": "r2", "pose": {"x": 1.5, "y": 2, "yaw_deg": -90}, "devices": {"laser": {"noise": 0}}})"));
  // The paddles cover x = 1.087 .. 1.167.
  ASSERT_FALSE(simulation.place_object("puck", {1.13, 1.0, 0.0}));
  const Simulation::DeviceId gripper{0, simulation.find_device(0, "gripper").value()};
  ASSERT_FALSE(simulation.apply(gripper, GripCommand{GripCommand::Action::kClose}));
  run(simulation, 150);
  const GripperReading& reading = device<Gripper>(simulation, 0, "gripper").reading();
  EXPECT_TRUE(reading.holding);
  // It closes in steps of 1.2 mm.
  EXPECT_NEAR(reading.gap_m, 0.04, 0.0013);
  EXPECT_TRUE(reading.outer_beam || reading.inner_beam);
  const int motion = simulation.find_device(0, "motion").value();
  ASSERT_FALSE(simulation.apply({0, motion}, TwistCommand{{.v_mps = 0.2}}));
  run(simulation, 185);
  ASSERT_FALSE(simulation.apply({0, motion}, TwistCommand{}));
  run(simulation, 15);
  const Pose X_WT = simulation.find_object("puck")->pose;
  EXPECT_GT(X_WT.x_m, 1.4);
  const LaserReading& scan = device<Laser>(simulation, 1, "laser").reading();
  const Pose X_WL = scan.X_WB * device<Laser>(simulation, 1, "laser").params().X_BL;
  int met = 0;
  for (std::size_t beam = 0; beam < scan.ranges_m.size(); ++beam) {
    const double angle_rad =
        X_WL.yaw_rad + scan.angle_min_rad + scan.resolution_rad * static_cast<double>(beam);
    const double expected_m =
        circle_range_m(X_WL.position(), angle_rad, X_WT.position(), 0.02, 9.0);
    if (expected_m == 9.0 || scan.ranges_m[beam] < expected_m - 0.01) continue;
    ++met;
    EXPECT_NEAR(scan.ranges_m[beam], expected_m, 1e-6);
  }
  EXPECT_GT(met, 3);
  ASSERT_FALSE(simulation.apply(gripper, GripCommand{GripCommand::Action::kOpen}));
  EXPECT_LT(simulation.world().arena.obstacles[3].carried_by, 0);
}

TEST(Shapes, ReachAcross_FollowsOutline) {
  const auto round = reach_across({0.1, 0.05, 0.3}, circle("c", {0, 0}, 0.05), 0.13, 0.2);
  ASSERT_TRUE(round);
  EXPECT_NEAR(round->first, 0.05 - 0.04, 1e-12);  // 0.03 m beside the centre: a half chord of 0.04
  EXPECT_NEAR(round->second, 0.05 + 0.04, 1e-12);
  EXPECT_FALSE(reach_across({0.1, 0.05, 0.3}, circle("c", {0, 0}, 0.05), 0.16, 0.2));
  const auto wedge =
      reach_across({0, 0, 0}, polygon("p", {0, 0}, {{0, 0}, {1, 0}, {0, 1}}), 0.5, 0.6);
  ASSERT_TRUE(wedge);
  EXPECT_NEAR(wedge->first, 0.0, 1e-12);
  EXPECT_NEAR(wedge->second, 0.5, 1e-12);
}

TEST(Shapes, TrueMap_HasEachTouchedCell) {
  const ArenaDescription arena =
      floor_of(4.0, {circle("c", {1.03, 1.01}, 0.47), polygon("n", {2, 2}, kNotch, 0.3)});
  CanvasDescription grid;
  grid.width = grid.height = 80;
  grid.cell_size_m = 0.05;
  const OccupancyMap map = true_map(arena, grid);
  const Polygon notch = corners_of(arena.obstacles[1]);
  for (int row = 0; row < 80; ++row) {
    for (int column = 0; column < 80; ++column) {
      const Vec2 low(0.05 * column, 0.05 * (79 - row));
      const Vec2 nearest = arena.obstacles[0].center.cwiseMax(low).cwiseMin(low + Vec2(0.05, 0.05));
      const double off_m = (nearest - arena.obstacles[0].center).norm() - 0.47;
      const bool occupied = map.at(column, row) == 1.0F;
      EXPECT_TRUE(occupied || off_m > -1e-6) << low.transpose();
      bool in_notch = false;
      for (int i = 0; i <= 10; ++i) {
        for (int k = 0; k <= 10; ++k) {
          in_notch = in_notch || is_inside(notch, low + Vec2(0.005 * i, 0.005 * k));
        }
      }
      EXPECT_TRUE(occupied || !in_notch) << low.transpose();
      // A corner of the notch may reach into a cell between the samples.
      const bool near_notch = is_inside(notch, low) ||
                              std::any_of(notch.begin(), notch.end(),
                                          [&](const Vec2& p) { return (p - low).norm() < 0.1; });
      if (off_m > 1e-6 && !in_notch && !near_notch && occupied) {
        // The samples are 5 mm apart, so a side of the notch cuts off less than that.
        double least_m = 1.0;
        for (const Vec2& c : {low, Vec2(low + Vec2(0.05, 0)), Vec2(low + Vec2(0, 0.05)),
                              Vec2(low + Vec2(0.05, 0.05))}) {
          least_m = std::min(least_m, test::distance_to_outline_m(c, notch));
        }
        EXPECT_LT(least_m, 0.008) << low.transpose();
      }
    }
  }
}

TEST(Shapes, Snapshots_RestoreShapes) {
  const auto make = [] {
    return Simulation(three_shapes(R"({"laser": {}, "sonar": {"type": "sonar"}})",
                                   R"(, {"name": "r2", "pose": {"x": 1.5, "y": 2}})"));
  };
  Simulation simulation = make();
  const int motion = simulation.find_device(0, "motion").value();
  ASSERT_FALSE(simulation.apply({0, motion}, TwistCommand{{.v_mps = 0.5, .omega_radps = 0.3}}));
  run(simulation, 350);  // against the pillar
  ASSERT_FALSE(simulation.place_object("notch", {3.2, 3.4, 0.7}));
  ASSERT_FALSE(simulation.set_block_size("wedge", {0.8, 1.3}, 0.2));
  ASSERT_FALSE(simulation.set_block_size("puck", {0.1, 0.1}, 0.1));
  run(simulation, 5);
  const Snapshot snapshot = simulation.save();
  run(simulation, 500);
  const std::uint64_t expected = simulation.state_hash();
  Simulation other = make();
  run(other, 30);
  for (Simulation* restored : {&simulation, &other}) {
    restored->restore(snapshot);
    EXPECT_EQ(restored->save(), snapshot);
    run(*restored, 500);
    EXPECT_EQ(restored->state_hash(), expected);
  }
}

// Number of reddish pixels of a picture with one red block.
int red_pixels(const std::string& shape) {
  const Simulation simulation(load_world_text(
      R"({"arena": {"size": [4, 4], "obstacles": [{"center": [1.2, 1.3], "colour": "#f00", )" +
      shape + R"(}]}, "robots": []})"));
  const render::Image image = render::draw_scene(simulation.snapshot());
  int count = 0;
  for (std::size_t i = 0; i < image.rgb.size(); i += 3) {
    if (image.rgb[i] > 2 * image.rgb[i + 1] && image.rgb[i] > 100) ++count;
  }
  return count;
}

TEST(Shapes, Pictures_ShowAreas) {
  const double box = red_pixels(R"("size": [1.4, 1.2])");
  ASSERT_GT(box, 10'000.0);
  // Pixels at the edge count by halves: 1 % is several times their part of the area.
  EXPECT_NEAR(red_pixels(R"("shape": "circle", "radius": 0.6)") / box, kPi * 0.36 / (1.4 * 1.2),
              0.01);
  EXPECT_NEAR(red_pixels(R"("shape": "polygon", "yaw_deg": 20, "outline": [[0, 0], [1.4, 0],
                           [1.4, 1.2], [1.2, 1.2], [1.2, 0.2], [0.2, 0.2], [0.2, 1.2], [0, 1.2]])") /
                  box,
              0.68 / (1.4 * 1.2), 0.02);
}

}  // namespace
}  // namespace sim
