// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Robots whose bodies are not convex: they consist of several convex parts, with gaps between them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "outlines.h"
#include "physics/physics_world.h"
#include "polygon_overlap.h"
#include "sim/core/error.h"
#include "sim/devices/laser.h"
#include "sim/simulation/simulation.h"
#include "sim/world/outline.h"
#include "sim/world/robot_model.h"
#include "temporary_folder.h"

namespace sim {
namespace {

using testing::HasSubstr;
using testing::SizeIs;
using PartsKind = PhysicsWorld::Contact::Kind;

constexpr double kPartsStep_s = 0.01;
constexpr double kPartsPi = std::numbers::pi;

// A body of 0.4 x 0.4 m with two arms of 0.2 x 0.1 m before it: the gap between them is 0.2 m wide
// and 0.2 m deep.
const std::vector<Polygon> kFork{{{-0.2, -0.2}, {0.2, -0.2}, {0.2, 0.2}, {-0.2, 0.2}},
                                 {{0.2, 0.1}, {0.4, 0.1}, {0.4, 0.2}, {0.2, 0.2}},
                                 {{0.2, -0.2}, {0.4, -0.2}, {0.4, -0.1}, {0.2, -0.1}}};

RobotModel fork_model(DriveKind drive = DriveKind::kDifferential) {
  RobotModel model = s1r_model();
  model.name = "fork";
  model.footprint = {{-0.2, -0.2}, {0.4, -0.2}, {0.4, 0.2}, {-0.2, 0.2}};
  model.parts = kFork;
  model.height_m = 0.2;
  model.drive.kind = drive;
  return model;
}

ArenaDescription fork_floor() {
  ArenaDescription arena;
  arena.size = {4.0, 4.0};
  return arena;
}

ObstacleDescription block_at(double x, double y, double length, double width) {
  ObstacleDescription block;
  block.center = {x, y};
  block.size = {length, width};
  block.height_m = 0.5;
  return block;
}

void drive_for(PhysicsWorld& world, int robot, const Twist& twist, int steps) {
  world.set_target(robot, twist);
  for (int i = 0; i < steps; ++i) world.step(kPartsStep_s);
}

// The deepest overlap of a fork with an outline in W [m].
double fork_overlap_m(const PhysicsWorld& world, const Polygon& other) {
  double deepest_m = 0.0;
  for (const Polygon& part : kFork) {
    deepest_m =
        std::max(deepest_m, test::overlap_depth_m(test::placed(part, world.body(0).X_WB), other));
  }
  return deepest_m;
}

// The block covers x = 1.27 to 1.37 and y = 0.95 to 1.05. The arms are 0.05 m beside it, the middle
// of the robot, which ends at x = 1.2, is 0.07 m behind it.
TEST(BodyParts, ObjectBetweenArms_StopsMiddle) {
  ArenaDescription arena = fork_floor();
  arena.obstacles = {block_at(1.32, 1.0, 0.1, 0.1)};
  PhysicsWorld world(arena);
  world.add_robot(fork_model(), {1.0, 1.0, 0.0});
  EXPECT_EQ(world.robot_within(arena.obstacles[0]), -1);
  EXPECT_NEAR(world.clearance_m(0, 1.0, 1.0), 0.05, 1e-5);
  drive_for(world, 0, {0.2, 0.0, 0.0}, 100);
  // Bodies keep a gap of about 1.5 mm.
  EXPECT_NEAR(world.body(0).X_WB.x_m, 1.07, 0.003);
  EXPECT_TRUE(world.body(0).stalled);
  ASSERT_THAT(world.contacts_of(0), SizeIs(testing::Ge(1U)));
  // It turns until an arm is at the block, and the block stays between the arms.
  drive_for(world, 0, {0.0, 1.0, 0.0}, 200);
  EXPECT_GT(world.body(0).X_WB.yaw_rad, 0.05);
  EXPECT_LT(world.body(0).X_WB.yaw_rad, 0.5);
  EXPECT_LT(fork_overlap_m(world, test::box_polygon(arena.obstacles[0])), 0.001);
  drive_for(world, 0, {-0.2, 0.0, 0.0}, 300);
  EXPECT_LT(world.body(0).X_WB.x_m, 0.7) << "it drives away backwards";
}

TEST(BodyParts, RoundObject_FitsBetweenArms) {
  ArenaDescription arena = fork_floor();
  ObstacleDescription puck;
  puck.center = {1.32, 1.0};
  make_circle(puck, 0.05);
  arena.obstacles = {puck};
  PhysicsWorld world(arena);
  world.add_robot(fork_model(), {1.0, 1.0, 0.0});
  drive_for(world, 0, {0.2, 0.0, 0.0}, 100);
  EXPECT_NEAR(world.body(0).X_WB.x_m, 1.07, 0.003);
}

// The gap is 0.2 m wide, an S1R 0.162 m.
TEST(BodyParts, RobotFitsIntoGapOfOther) {
  PhysicsWorld world(fork_floor());
  world.add_robot(fork_model(), {1.0, 1.0, 0.0});
  const int small = world.add_robot(s1r_model(), {2.0, 1.0, kPartsPi});
  world.set_suspended(0, true);
  drive_for(world, small, {0.3, 0.0, 0.0}, 400);
  EXPECT_NEAR(world.body(small).X_WB.x_m, 1.2 + 0.087, 0.003);
  EXPECT_NEAR(world.body(small).X_WB.y_m, 1.0, 1e-3);
}

// A body that slides along the common side of two parts must not stop where the second part begins:
// its inner side is inside the body. The left side of the robot is at y = 1.2 and turns against a
// solid that ends at y = 1.2012 and has corners at x = 1.45 and 1.65. They pass the joint of an arm
// and the middle, 0.2 m ahead of the robot's origin, when that is at x = 1.25 and 1.45.
class BodyPartsSlide : public testing::TestWithParam<const char*> {
 protected:
  static ArenaDescription floor_with(const std::string& kind) {
    ArenaDescription arena = fork_floor();
    if (kind == "box") arena.obstacles = {block_at(1.55, 1.3012, 0.2, 0.2)};
    if (kind == "turned box") {
      arena.obstacles = {block_at(1.55, 1.2012 + 0.1 * std::sqrt(2.0), 0.2, 0.2)};
      arena.obstacles[0].yaw_rad = 0.25 * kPartsPi;
    }
    if (kind == "circle") {
      arena.obstacles = {block_at(1.55, 1.3012, 0.2, 0.2)};
      make_circle(arena.obstacles[0], 0.1);
    }
    if (kind == "wall") {
      arena.walls = {{{{1.45, 1.2012}, {1.65, 1.2012}, {1.65, 1.4}, {1.45, 1.4}}}};
    }
    if (kind == "concave") {
      arena.obstacles = {block_at(1.45, 1.2012, 0.2, 0.2)};
      make_polygon(arena.obstacles[0],
                   {{0.0, 0.0}, {0.2, 0.0}, {0.2, 0.2}, {0.1, 0.1}, {0.0, 0.2}});
    }
    return arena;
  }
};

TEST_P(BodyPartsSlide, PassesJoint) {
  PhysicsWorld world(floor_with(GetParam()));
  world.add_robot(fork_model(), {1.2, 1.0, 0.0});
  // Forwards 0.5 m in 2.5 s, and backwards 0.4 m in 2 s.
  drive_for(world, 0, {0.2, 0.1, 0.0}, 250);
  EXPECT_GT(world.body(0).X_WB.x_m, 1.65);
  world.set_pose(0, {1.46, 1.0, 0.0});
  drive_for(world, 0, {-0.2, 0.1, 0.0}, 200);
  EXPECT_LT(world.body(0).X_WB.x_m, 1.1);
}

// A rectangle that is divided into parts slides along a solid as fast as a whole one: 0.2 m/s.
TEST_P(BodyPartsSlide, SameSpeedAsSingleBody) {
  RobotModel divided = fork_model();
  divided.parts = {{{-0.2, -0.2}, {0.2, -0.2}, {0.2, 0.2}, {-0.2, 0.2}},
                   {{0.2, -0.2}, {0.4, -0.2}, {0.4, 0.2}, {0.2, 0.2}}};
  RobotModel whole = divided;
  whole.parts.clear();
  for (const double speed_mps : {0.2, -0.2}) {
    std::vector<double> ends_m;
    for (const RobotModel& model : {whole, divided}) {
      const ArenaDescription arena = floor_with(GetParam());
      PhysicsWorld world(arena);
      world.add_robot(model, {speed_mps > 0.0 ? 1.2 : 1.46, 1.0, 0.0});
      drive_for(world, 0, {speed_mps, 0.1, 0.0}, 100);
      ends_m.push_back(world.body(0).X_WB.x_m);
    }
    // A step is 2 mm. Stopping at each inner side would cost more than 1 cm.
    EXPECT_NEAR(ends_m[1], ends_m[0], 0.002);
  }
}

INSTANTIATE_TEST_SUITE_P(Solids, BodyPartsSlide,
                         testing::Values("box", "turned box", "circle", "wall", "concave"));

// A sensor at (2, y) that looks along -x meets the middle's front at x = 1.2 through the gap and an
// arm's front at x = 1.4 beside it. One at (1.3, 0.5) that looks along +y meets the right arm at y
// = 0.8, and one in the gap, at (1.3, 1), the left arm at y = 1.1.
TEST(BodyParts, Beams_PassThroughGap) {
  PhysicsWorld world(fork_floor());
  world.add_robot(fork_model(), {1.0, 1.0, 0.0});
  scan::ScanGeometry beam;
  beam.beam_count = 1;
  beam.range_max_m = 5.0;
  const auto range_m = [&](double x, double y, double yaw_rad, double height_m) {
    std::vector<double> ranges(1);
    world.scan(beam, {x, y, yaw_rad}, height_m, -1, true, ranges);
    return ranges[0];
  };
  EXPECT_NEAR(range_m(2.0, 1.0, kPartsPi, 0.1), 0.8, 1e-4);
  EXPECT_NEAR(range_m(2.0, 1.15, kPartsPi, 0.1), 0.6, 1e-4);
  EXPECT_NEAR(range_m(1.3, 0.5, 0.5 * kPartsPi, 0.1), 0.3, 1e-4);
  EXPECT_NEAR(range_m(1.3, 1.0, 0.5 * kPartsPi, 0.1), 0.1, 1e-4);
  EXPECT_EQ(range_m(1.3, 1.15, 0.5 * kPartsPi, 0.1), 0.0) << "inside of an arm";
  EXPECT_EQ(range_m(2.0, 1.0, kPartsPi, 0.25), 5.0) << "above the robot and the border";
  EXPECT_NEAR(world.ray_cast_m({2.0, 1.0}, kPartsPi, 5.0, -1), 0.8, 1e-4);
  EXPECT_FALSE(world.is_inside_solid({1.3, 1.0}, 0.1, -1));
  EXPECT_TRUE(world.is_inside_solid({1.3, 0.85}, 0.1, -1));
  const PhysicsWorld::Contact nothing{-1, PartsKind::kObstacle, -1};
  EXPECT_TRUE(world.is_line_free({1.35, 0.95}, {1.25, 1.05}, 0.1, -1, nothing));
  EXPECT_FALSE(world.is_line_free({1.35, 0.95}, {1.35, 1.15}, 0.1, -1, nothing));
}

// The model as a file, in a world with a block between its arms.
const char* const kForkFile = R"({"name": "fork", "height": 0.2,
  "footprint": [[[-0.2, -0.2], [0.2, -0.2], [0.2, 0.2], [-0.2, 0.2]],
                [[0.2, 0.1], [0.4, 0.1], [0.4, 0.2], [0.2, 0.2]],
                [[0.2, -0.2], [0.4, -0.2], [0.4, -0.1], [0.2, -0.1]]],
  "devices": {"motion": {}, "gripper": {"pose": {"x": 0.25}, "length": 0.15, "opening": 0.18,
              "travel_time": 1}}})";

class BodyPartsWorld : public testing::Test {
 protected:
  WorldDescription read(const std::string& model, const std::string& pose) {
    folder_.write("fork.model.json", model);
    return load_world(folder_.write(
        "w.json", R"({"arena": {"size": [4, 4], "obstacles": [{"name": "can", "center": [1.32, 1],)"
                  R"("size": [0.1, 0.1], "portable": true}]}, "robots": [{"name": "r1", "model":)"
                  R"("./fork.model.json", "pose": )" +
                      pose + "}]}"));
  }
  test_support::TemporaryFolder folder_;
};

TEST_F(BodyPartsWorld, RobotStartsAroundObjectAndGripsIt) {
  const WorldDescription world = read(kForkFile, R"({"x": 1, "y": 1})");
  const RobotModel& model = *find_robot_model(world, world.robots[0].model);
  EXPECT_THAT(model.parts, SizeIs(3));
  EXPECT_NEAR(area_m2(model.footprint), 0.24, 1e-9) << "the outline around the parts";
  Simulation simulation(world);
  const Simulation::DeviceId gripper{0, simulation.find_device(0, "gripper").value()};
  ASSERT_FALSE(simulation.apply(gripper, GripCommand{GripCommand::Action::kClose}));
  for (int i = 0; i < 150; ++i) simulation.step();
  const int motion = simulation.find_device(0, "motion").value();
  ASSERT_FALSE(simulation.apply({0, motion}, TwistCommand{{.v_mps = 0.2}}));
  for (int i = 0; i < 200; ++i) simulation.step();
  // 0.4 m, less what the motors take to reach their speed; the can stays 0.32 m ahead.
  const double x_m = simulation.body(0).X_WB.x_m;
  EXPECT_GT(x_m, 1.3);
  EXPECT_NEAR(simulation.find_object("can").value().pose.x_m, x_m + 0.32, 1e-9);
}

TEST_F(BodyPartsWorld, ObjectInArm_Overlaps) {
  try {
    static_cast<void>(read(kForkFile, R"({"x": 1, "y": 0.9})"));
    FAIL() << "accepted";
  } catch (const ConfigError& error) {
    // The arm ends at y = 1 and 1.1, the can at 0.95 and 1.05: they overlap by 0.05 m.
    EXPECT_EQ(error.issues().front().id, "world/robot-overlaps-obstacle");
    EXPECT_THAT(error.issues().front().found, HasSubstr("by 0.05 m"));
  }
}

TEST_F(BodyPartsWorld, RestoredState_ContinuesExactly) {
  const WorldDescription world = read(kForkFile, R"({"x": 0.8, "y": 1})");
  const auto drive = [](Simulation& simulation, int steps) {
    const int motion = simulation.find_device(0, "motion").value();
    ASSERT_FALSE(simulation.apply({0, motion}, TwistCommand{{.v_mps = 0.2, .omega_radps = 0.3}}));
    for (int i = 0; i < steps; ++i) simulation.step();
  };
  Simulation whole(world);
  drive(whole, 150);
  const Snapshot saved = whole.save();
  drive(whole, 150);
  Simulation rest(world);
  rest.restore(saved);
  drive(rest, 150);
  EXPECT_EQ(rest.state_hash(), whole.state_hash());
}

TEST_F(BodyPartsWorld, ConcavePart_Refused) {
  const std::string bad = R"({"name": "bad", "footprint": [
    [[-0.2, -0.2], [0.2, -0.2], [0.2, 0.2], [-0.2, 0.2]],
    [[0.2, 0], [0.4, 0.2], [0.3, 0], [0.4, -0.2]]]})";
  try {
    static_cast<void>(read(bad, R"({"x": 2, "y": 2})"));
    FAIL() << "accepted";
  } catch (const ConfigError& error) {
    EXPECT_EQ(error.issues().front().id, "world/bad-footprint");
    EXPECT_THAT(error.issues().front().found, HasSubstr("in part 1"));
  }
}

// An L of 2 x 2 without its upper right quarter: two convex parts, with the area of the whole.
TEST(ConvexParts, CoverConcaveOutline) {
  const Polygon ell{{0.0, 0.0}, {2.0, 0.0}, {2.0, 1.0}, {1.0, 1.0}, {1.0, 2.0}, {0.0, 2.0}};
  const std::vector<Polygon> parts = convex_parts_of(ell, 8);
  ASSERT_THAT(parts, SizeIs(2));
  double sum_m2 = 0.0;
  for (const Polygon& part : parts) {
    EXPECT_TRUE(is_convex(part));
    sum_m2 += area_m2(part);
  }
  EXPECT_NEAR(sum_m2, 3.0, 1e-12);
}

TEST(ConvexParts, NumberOfCorners_Limited) {
  Polygon round;
  for (int i = 0; i < 20; ++i) {
    round.emplace_back(std::cos(0.1 * i * kPartsPi), std::sin(0.1 * i * kPartsPi));
  }
  double sum_m2 = 0.0;
  for (const Polygon& part : convex_parts_of(round, 8)) {
    EXPECT_LE(part.size(), 8U);
    sum_m2 += area_m2(part);
  }
  EXPECT_NEAR(sum_m2, area_m2(round), 1e-9);
}

}  // namespace
}  // namespace sim
