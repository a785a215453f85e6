// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Bodies of Stage's robots: footprints, heights and superstructures.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "sim/core/number_text.h"
#include "sim/devices/gripper.h"
#include "sim/devices/laser.h"
#include "sim/simulation/simulation.h"
#include "sim/world/outline.h"
#include "sim/world/robot_model.h"
#include "temporary_folder.h"

namespace sim {
namespace {

using testing::IsEmpty;
using testing::SizeIs;

RobotModel model_of(const std::string& position) {
  test_support::TemporaryFolder folder;
  const WorldDescription world =
      load_world(folder.write("w.world", "position ( name \"r0\" " + position + " )"));
  return *find_robot_model(world, world.robots[0].model);
}

// The laser of 0.15 x 0.16 x 0.19 m stands on the body of 0.22 m.
TEST(StageBodies, LaserOnBody_IsSuperstructure) {
  const RobotModel model = model_of(
      "size [0.4 0.4 0.22] ranger ( size [0.15 0.16 0.19] pose [0.1 0 0 0] "
      "block ( points 4 point[0] [0 0] point[1] [0 1] point[2] [1 1] point[3] [1 0] z [0 1] ) "
      "sensor ( samples 100 fov 180 ) )");
  EXPECT_NEAR(model.height_m, 0.22, 1e-9);
  EXPECT_NEAR(area_m2(model.footprint), 0.16, 1e-9);
  ASSERT_THAT(model.superstructures, SizeIs(1));
  EXPECT_NEAR(model.superstructures[0].height_m, 0.41, 1e-9);
  EXPECT_NEAR(area_m2(model.superstructures[0].outline), 0.15 * 0.16, 1e-9);
}

TEST(StageBodies, LowerParts_AddNothing) {
  const RobotModel model =
      model_of("size [0.4 0.4 0.5] model ( size [0.1 0.1 0.1] pose [0 0 -0.4 0] )");
  EXPECT_NEAR(model.height_m, 0.5, 1e-9);
  EXPECT_THAT(model.superstructures, IsEmpty());
}

// As in Stage, a point that is missing is at [0 0]: a triangle of 1 x 1 becomes a square.
TEST(StageBodies, MissingPoint_AtOrigin) {
  const RobotModel model = model_of(
      "size [0.4 0.4 0.2] block ( points 4 point[0] [1 0] point[1] [1 1] point[2] [0 1] z [0 1] )");
  EXPECT_NEAR(area_m2(model.footprint), 0.16, 1e-9);
}

// The paddles take 0.66 of the length, so the base is 0.068 x 0.3 m.
TEST(StageBodies, GripperBase_PartOfBody) {
  const std::string gripper = "gripper ( size [0.2 0.3 0.2] pose [0.3 0 -0.5 0] ";
  const RobotModel solid = model_of("size [0.4 0.4 0.5] " + gripper + ")");
  double front_m = 0.0;
  for (const Vec2& corner : solid.footprint) front_m = std::max(front_m, corner.x());
  EXPECT_NEAR(front_m, 0.268, 1e-9);
  EXPECT_NEAR(solid.height_m, 0.2, 1e-9);
  ASSERT_THAT(solid.superstructures, SizeIs(1));
  EXPECT_NEAR(solid.superstructures[0].height_m, 0.5, 1e-9);
  // Not solid: rangers see it, but it touches nothing.
  const RobotModel seen = model_of("size [0.4 0.4 0.5] " + gripper + " obstacle_return 0 )");
  EXPECT_NEAR(area_m2(seen.footprint), 0.16, 1e-9);
  ASSERT_THAT(seen.superstructures, SizeIs(2));
  EXPECT_NEAR(area_m2(seen.superstructures[1].outline), 0.068 * 0.3, 1e-9);
  EXPECT_NEAR(seen.superstructures[1].height_m, 0.2, 1e-9);
}

// Teeth of half the height before a body: together they are 1 x 0.8 m, the body alone 0.8 x 0.8 m.
TEST(StageBodies, LowPartInFront_KeepsHeight) {
  const RobotModel model = model_of(
      "size [1 0.8 0.6] "
      "block ( points 4 point[0] [0 0] point[1] [8 0] point[2] [8 8] point[3] [0 8] z [0 6] ) "
      "block ( points 4 point[0] [8 0] point[1] [10 0] point[2] [10 8] point[3] [8 8] z [0 3] )");
  EXPECT_NEAR(model.height_m, 0.3, 1e-9);
  EXPECT_NEAR(area_m2(model.footprint), 0.8, 1e-9);
  ASSERT_THAT(model.superstructures, SizeIs(1));
  EXPECT_NEAR(model.superstructures[0].height_m, 0.6, 1e-9);
  EXPECT_NEAR(area_m2(model.superstructures[0].outline), 0.64, 1e-9);
}

// The robot of the Player/Stage manual (J. Owen, K. Nickels): a body of 1 x 1 m without its front
// corners, and two teeth of 0.25 x 0.125 m before it, 0.25 m apart and half as high. `origin` moves
// the middle of all to x = 0.125, so that the teeth are at x = 0.5 to 0.75.
const char* const kBigbob =
    "size [1.25 1 1] origin [0.125 0 0 0] "
    "block ( points 6 point[5] [0 0] point[4] [0 1] point[3] [0.75 1] point[2] [1 0.75] "
    "point[1] [1 0.25] point[0] [0.75 0] z [0 1] ) "
    "block ( points 4 point[3] [1 0.75] point[2] [1.25 0.75] point[1] [1.25 0.625] "
    "point[0] [1 0.625] z [0 0.5] ) "
    "block ( points 4 point[3] [1 0.375] point[2] [1.25 0.375] point[1] [1.25 0.25] "
    "point[0] [1 0.25] z [0 0.5] ) drive \"diff\" ";

TEST(StageBodies, Teeth_SeparateParts) {
  const RobotModel model = model_of(kBigbob);
  ASSERT_THAT(model.parts, SizeIs(3));
  EXPECT_NEAR(area_m2(model.parts[0]), 1.0 - 0.25 * 0.25, 1e-9);
  EXPECT_NEAR(area_m2(model.parts[1]), 0.25 * 0.125, 1e-9);
  EXPECT_NEAR(model.height_m, 0.5, 1e-9) << "up to which all parts reach";
  ASSERT_THAT(model.superstructures, SizeIs(1));
  EXPECT_NEAR(model.superstructures[0].height_m, 1.0, 1e-9);
  const auto within = [&](const Vec2& p) {
    return std::any_of(model.parts.begin(), model.parts.end(),
                       [&](const Polygon& part) { return is_inside(part, p); });
  };
  EXPECT_TRUE(within({0.6, 0.18}));
  EXPECT_FALSE(within({0.6, 0.0})) << "between the teeth";
  EXPECT_TRUE(within({0.6, -0.18}));
}

// An L, as one concave block: 0.4 x 0.4 m without a quarter.
TEST(StageBodies, ConcaveBlock_Divided) {
  const RobotModel model = model_of(
      "size [0.4 0.4 0.2] block ( points 6 point[0] [0 0] point[1] [2 0] point[2] [2 1] "
      "point[3] [1 1] point[4] [1 2] point[5] [0 2] z [0 1] )");
  ASSERT_THAT(model.parts, SizeIs(2));
  EXPECT_NEAR(area_m2(model.parts[0]) + area_m2(model.parts[1]), 0.12, 1e-9);
  EXPECT_NEAR(model.height_m, 0.2, 1e-9);
  EXPECT_THAT(model.superstructures, IsEmpty());
}

// Bigbob drives from x = 0 towards an orange at x = 1.5, 0.15 m wide, which fits between its teeth
// and stops at its body. Its front is at 0.5 m then, and x = 1.425 - 0.5 = 0.925. The laser looks
// across from one tooth to the other, 0.625 m ahead. A convex body would stop 0.25 m earlier. The
// gripper's paddles reach from x = 0.55 to 0.75; they hold the orange, and carry it back.
TEST(StageBodies, Bigbob_HoldsOrangeBetweenTeeth) {
  test_support::TemporaryFolder folder;
  Simulation simulation(load_world(folder.write(
      "w.world",
      std::string("define bigbob position ( ") + kBigbob +
          "ranger ( sensor ( pose [0.625 0.125 -0.975 270] range [0 0.25] fov 20 samples 180 ) ) "
          "gripper ( pose [0.55 0 -1 0] size [0.4 0.3 0.2] paddle_size [0.5 0.1 0.4] "
          "obstacle_return 0 ) ) "
          "bigbob ( name \"bob1\" pose [0 0 0 0] ) "
          "model ( name \"orange\" size [0.15 0.15 0.15] pose [1.5 0 0 0] gripper_return 1 )")));
  const auto reading = [&](const char* name) -> const Reading& {
    return simulation.device(0, simulation.find_device(0, name).value()).sensor()->reading();
  };
  const auto nearest_m = [&] {
    const auto& ranges = dynamic_cast<const LaserReading&>(reading("laser")).ranges_m;
    return *std::min_element(ranges.begin(), ranges.end());
  };
  const auto drive = [&](double speed_mps, int steps) {
    const int motion = simulation.find_device(0, "motion").value();
    ASSERT_FALSE(simulation.apply({0, motion}, TwistCommand{{.v_mps = speed_mps}}));
    for (int i = 0; i < steps; ++i) simulation.step();
  };
  for (int i = 0; i < 20; ++i) simulation.step();
  EXPECT_NEAR(nearest_m(), 0.25, 1e-6);
  drive(0.4, 400);
  EXPECT_NEAR(simulation.body(0).X_WB.x_m, 0.925, 0.005);
  EXPECT_LT(nearest_m(), 0.1) << "the orange, 0.05 m from the tooth";
  const Simulation::DeviceId gripper{0, simulation.find_device(0, "gripper").value()};
  ASSERT_FALSE(simulation.apply(gripper, GripCommand{GripCommand::Action::kClose}));
  drive(0.0, 300);
  EXPECT_TRUE(dynamic_cast<const GripperReading&>(reading("gripper")).holding);
  drive(-0.4, 200);
  EXPECT_NEAR(simulation.find_object("orange").value().pose.x_m,
              simulation.body(0).X_WB.x_m + 0.575, 0.005);
}

TEST(StageBodies, PartsInvisibleToRangers_SolidOnly) {
  const RobotModel model = model_of(
      "size [0.4 0.4 0.2] "
      "model ( size [0.6 0.6 0.1] pose [0 0 0 0] ranger_return -1 ) "
      "model ( size [0.9 0.1 0.3] pose [0 0 0 0] obstacle_return 0 )");
  EXPECT_DOUBLE_EQ(model.height_m, 0.001) << "the plate, which is as wide as the whole";
  EXPECT_NEAR(area_m2(model.footprint), 0.36, 1e-9) << "without the bar, which is not solid";
  ASSERT_THAT(model.superstructures, SizeIs(2));
  EXPECT_NEAR(model.superstructures[0].height_m, 0.2, 1e-9) << "the body";
  EXPECT_NEAR(model.superstructures[1].height_m, 0.5, 1e-9) << "the bar";
  EXPECT_NEAR(area_m2(model.superstructures[1].outline), 0.09, 1e-9);
}

// A bumper that is seen but not solid, before the body and not higher than it.
TEST(StageBodies, VisiblePartsBeyondFootprint_StayVisible) {
  const RobotModel model = model_of(
      "size [0.4 0.4 0.2] model ( size [0.1 0.1 0.1] pose [0.25 0 -0.1 0] obstacle_return 0 )");
  EXPECT_NEAR(area_m2(model.footprint), 0.16, 1e-9);
  EXPECT_DOUBLE_EQ(model.height_m, 0.001);
  ASSERT_THAT(model.superstructures, SizeIs(2));
  EXPECT_NEAR(area_m2(model.superstructures[0].outline), 0.16, 1e-9) << "the body";
  EXPECT_NEAR(model.superstructures[0].height_m, 0.2, 1e-9);
  EXPECT_NEAR(area_m2(model.superstructures[1].outline), 0.01, 1e-9) << "the bumper";
  EXPECT_NEAR(model.superstructures[1].height_m, 0.2, 1e-9);
}

TEST(StageBodies, Superstructures_AtMost32) {
  std::string parts = "size [0.4 0.4 0.2] ";
  for (int i = 0; i < 40; ++i) {
    parts += "model ( size [0.02 0.02 0.1] pose [" + shortest_text(0.04 * (i % 8) - 0.16) + ' ' +
             shortest_text(0.04 * (i / 8) - 0.1) + " 0 0] )";
  }
  EXPECT_THAT(model_of(parts).superstructures, SizeIs(32));
}

TEST(StageBodies, PartsWithinHigherOnes_NotListed) {
  const RobotModel model = model_of(
      "size [0.4 0.4 0.2] model ( size [0.2 0.2 0.3] ) model ( size [0.1 0.1 0.2] ) "
      "model ( size [0.1 0.1 0.4] )");
  ASSERT_THAT(model.superstructures, SizeIs(2));
  EXPECT_NEAR(model.superstructures[0].height_m, 0.5, 1e-9);
  EXPECT_NEAR(model.superstructures[1].height_m, 0.6, 1e-9);
}

}  // namespace
}  // namespace sim
