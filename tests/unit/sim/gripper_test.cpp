// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/devices/gripper.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "sim/core/error.h"
#include "sim/devices/blobfinder.h"
#include "sim/devices/fiducial.h"
#include "sim/devices/laser.h"
#include "sim/simulation/simulation.h"
#include "sim/world/occupancy_map.h"

namespace sim {
namespace {

using testing::HasSubstr;
using Action = GripCommand::Action;

constexpr double kPi = std::numbers::pi;

// r1, an S1R at (1, 1), faces along x. Its front is 0.087 m ahead, so the paddles cover x = 1.087
// to 1.167. They are 0.12 m apart and close in 1 s. The can covers x = 1.107 .. 1.147, y = 0.98 ..
// 1.02: 0.04 m across. r2 is far from both.
constexpr const char* kCan =
    R"({"name": "can", "center": [1.127, 1], "size": [0.04, 0.04], "portable": true})";

Simulation world_with(const std::string& obstacles, const std::string& settings = "") {
  return Simulation(load_world_text(
      R"({"arena": {"size": [4, 3], "obstacles": [)" + obstacles +
      R"(]}, "robots": [{"name": "r1", "pose": {"x": 1, "y": 1}, "devices": {"gripper": {)" +
      R"("length": 0.08, "opening": 0.12, "travel_time": 1)" + settings +
      R"(}}}, {"name": "r2", "pose": {"x": 3, "y": 2.5}}]})"));
}

struct Rig {
  explicit Rig(const std::string& obstacles, const std::string& settings = "")
      : simulation(world_with(obstacles, settings)),
        gripper{0, simulation.find_device(0, "gripper").value()} {}

  void run(int steps) {
    for (int i = 0; i < steps; ++i) simulation.step();
  }
  std::optional<std::string> grip(Action action) {
    return simulation.apply(gripper, GripCommand{action});
  }
  [[nodiscard]] const Gripper& device() const {
    return dynamic_cast<const Gripper&>(simulation.device(0, gripper.device));
  }
  [[nodiscard]] const GripperReading& reading() const { return device().reading(); }
  void drive(const Twist& twist, int steps) {
    const int motion = simulation.find_device(0, "motion").value();
    ASSERT_FALSE(simulation.apply({0, motion}, TwistCommand{twist}));
    run(steps);
    ASSERT_FALSE(simulation.apply({0, motion}, TwistCommand{}));
    run(1);
  }
  [[nodiscard]] Pose pose_of(const std::string& name) const {
    return simulation.find_object(name).value().pose;
  }
  // The smallest range that a robot's laser has measured.
  [[nodiscard]] double nearest_m(int robot) const {
    const auto& laser = dynamic_cast<const Laser&>(
        simulation.device(robot, simulation.find_device(robot, "laser").value()));
    const auto& ranges = laser.reading().ranges_m;
    return *std::min_element(ranges.begin(), ranges.end());
  }

  Simulation simulation;
  Simulation::DeviceId gripper;
};

// A marking under the paddles does not disturb. A portable can that is not solid is an object like
// others.
TEST(Gripper, MarkingsAndNonSolids_NeitherGrippedNorFelt) {
  const std::string marking =
      R"({"name": "line", "center": [1.13, 1], "size": [0.5, 0.5], "solid": false})";
  Rig empty(marking);
  empty.run(10);
  EXPECT_FALSE(empty.reading().outer_beam);
  EXPECT_FALSE(empty.reading().inner_beam);
  ASSERT_FALSE(empty.grip(Action::kClose));
  empty.run(150);
  EXPECT_EQ(empty.reading().state, GripperState::kClosed);
  EXPECT_FALSE(empty.reading().holding);

  // The inner beam is at x = 1.107, the side of the can; the outer one at 1.147.
  Rig rig(marking + R"(, {"name": "can", "center": [1.127, 1], "size": [0.041, 0.04],)" +
          R"("portable": true, "solid": false})");
  rig.run(10);
  EXPECT_TRUE(rig.reading().inner_beam);
  EXPECT_TRUE(rig.reading().outer_beam);
  ASSERT_FALSE(rig.grip(Action::kClose));
  rig.run(150);
  EXPECT_TRUE(rig.reading().holding);
}

TEST(ReachAcross, ReachOfPartInStrip) {
  // A box of 0.2 x 0.1 centred at (0.3, 0.05): x = 0.2 .. 0.4, y = 0 .. 0.1.
  const Vec2 size(0.2, 0.1);
  const auto whole = reach_across({0.3, 0.05, 0.0}, size, 0.0, 1.0);
  ASSERT_TRUE(whole);
  EXPECT_NEAR(whole->first, 0.0, 1e-12);
  EXPECT_NEAR(whole->second, 0.1, 1e-12);
  EXPECT_TRUE(reach_across({0.3, 0.05, 0.0}, size, 0.25, 0.35));  // no corner, but sides
  EXPECT_FALSE(reach_across({0.3, 0.05, 0.0}, size, 0.0, 0.15));
  EXPECT_FALSE(reach_across({0.3, 0.05, 0.0}, size, 0.45, 1.0));
  // A square of side sqrt(2) on its corner: a rhombus with half-diagonals of 1 and its left corner
  // at x = 0. At x = 0.25 it extends 0.25 to either side.
  const double side = std::sqrt(2.0);
  const auto tip = reach_across({1.0, 0.0, kPi / 4.0}, {side, side}, -1.0, 0.25);
  ASSERT_TRUE(tip);
  EXPECT_NEAR(tip->first, -0.25, 1e-12);
  EXPECT_NEAR(tip->second, 0.25, 1e-12);
}

TEST(Gripper, Travel_TakesItsTime) {
  Rig rig("");
  rig.run(10);
  EXPECT_EQ(rig.reading().state, GripperState::kOpen);
  EXPECT_NEAR(rig.reading().gap_m, 0.12, 1e-12);
  ASSERT_FALSE(rig.grip(Action::kClose));
  rig.run(90);
  EXPECT_EQ(rig.reading().state, GripperState::kMoving);
  EXPECT_NEAR(rig.reading().gap_m, 0.012, 1e-9);  // 0.9 of the way
  rig.run(10);
  EXPECT_EQ(rig.reading().state, GripperState::kClosed);
  EXPECT_EQ(rig.reading().gap_m, 0.0);
  EXPECT_FALSE(rig.reading().holding);
  ASSERT_FALSE(rig.grip(Action::kOpen));
  rig.run(40);
  ASSERT_FALSE(rig.grip(Action::kStop));
  rig.run(30);
  EXPECT_EQ(rig.reading().state, GripperState::kOpen);  // stopped
  EXPECT_NEAR(rig.reading().gap_m, 0.4 * 0.12, 1e-9);
  ASSERT_FALSE(rig.grip(Action::kOpen));
  rig.run(60);
  EXPECT_NEAR(rig.reading().gap_m, 0.12, 1e-9);
}

TEST(Gripper, Beams_Broken) {
  // Beams at x = 1.087 + 0.25 * 0.08 = 1.107 and 1.087 + 0.75 * 0.08 = 1.147, for |y - 1| <= 0.06.
  const auto beams = [](const std::string& center) {
    Rig rig(R"({"name": "box", "center": [)" + center + R"(], "size": [0.02, 0.04]})");
    rig.run(10);
    return std::pair(rig.reading().inner_beam, rig.reading().outer_beam);
  };
  EXPECT_EQ(beams("1.108, 1.0"), std::pair(true, false));
  EXPECT_EQ(beams("1.127, 1.0"), std::pair(false, false));  // between them
  EXPECT_EQ(beams("1.148, 1.0"), std::pair(false, true));
  EXPECT_EQ(beams("1.148, 1.079"), std::pair(false, true));   // 1 mm inside
  EXPECT_EQ(beams("1.148, 1.081"), std::pair(false, false));  // 1 mm outside
  EXPECT_EQ(beams("1.148, 0.921"), std::pair(false, true));
  EXPECT_EQ(beams("1.2, 1.0"), std::pair(false, false));
}

TEST(Gripper, LowObjects_NotFelt) {
  Rig rig(R"({"name": "mat", "center": [1.127, 1], "size": [0.06, 0.04], "height": 0.049, )"
          R"("portable": true})");
  ASSERT_FALSE(rig.grip(Action::kClose));
  rig.run(110);
  EXPECT_FALSE(rig.reading().inner_beam);
  EXPECT_EQ(rig.reading().state, GripperState::kClosed);
  EXPECT_FALSE(rig.reading().holding);
}

TEST(Gripper, ObjectBetweenPaddles_Gripped) {
  Rig rig(kCan);
  ASSERT_FALSE(rig.grip(Action::kClose));
  // The gap is down to 0.04 after 1 - 0.04 / 0.12 = 2/3 s.
  rig.run(60);
  EXPECT_EQ(rig.reading().state, GripperState::kMoving);
  EXPECT_EQ(rig.simulation.world().arena.obstacles[0].carried_by, -1);
  rig.run(6);
  EXPECT_EQ(rig.simulation.world().arena.obstacles[0].carried_by, -1);
  rig.run(1);
  EXPECT_EQ(rig.simulation.world().arena.obstacles[0].carried_by, 0);
  rig.run(3);
  EXPECT_EQ(rig.reading().state, GripperState::kClosed);
  EXPECT_TRUE(rig.reading().holding);
  EXPECT_NEAR(rig.reading().gap_m, 0.04, 1e-9);
  EXPECT_NEAR(rig.pose_of("can").x_m, 1.127, 1e-12);
}

TEST(Gripper, Load_Carried) {
  Rig rig(kCan);
  ASSERT_FALSE(rig.grip(Action::kClose));
  rig.run(70);
  rig.drive({0.2, 1.0}, 200);
  const Pose X_WB = rig.simulation.body(0).X_WB;
  EXPECT_GT(X_WB.yaw_rad, 1.5);
  // 0.127 ahead of the axle, as when it was taken; it rotates with the robot.
  const Pose expected = X_WB * Pose{0.127, 0.0, 0.0};
  const Pose X_WT = rig.pose_of("can");
  EXPECT_NEAR(X_WT.x_m, expected.x_m, 1e-9);
  EXPECT_NEAR(X_WT.y_m, expected.y_m, 1e-9);
  EXPECT_NEAR(normalize_angle(X_WT.yaw_rad - expected.yaw_rad), 0.0, 1e-9);
  EXPECT_EQ(rig.simulation.statistics(0).collisions, 0);
  ASSERT_FALSE(rig.grip(Action::kOpen));
  EXPECT_EQ(rig.simulation.world().arena.obstacles[0].carried_by, -1);
  rig.drive({-0.2, 0.0}, 50);
  EXPECT_NEAR(rig.pose_of("can").x_m, expected.x_m, 1e-9);  // stays there
  EXPECT_NEAR(rig.pose_of("can").y_m, expected.y_m, 1e-9);
}

TEST(Gripper, PlacedRobot_CarriesLoad) {
  Rig rig(kCan);
  ASSERT_FALSE(rig.grip(Action::kClose));
  rig.run(70);
  ASSERT_FALSE(rig.simulation.place_object("r1", {2.0, 2.0, kPi / 2.0}));
  EXPECT_NEAR(rig.pose_of("can").x_m, 2.0, 1e-9);
  EXPECT_NEAR(rig.pose_of("can").y_m, 2.127, 1e-9);
}

TEST(Gripper, Load_VisibleToOthersOnly) {
  Rig rig(kCan);
  rig.run(10);
  // The laser is 0.035 ahead of the axle; the can's near side is at 0.107.
  EXPECT_NEAR(rig.nearest_m(0), 0.072, 0.002);
  ASSERT_FALSE(rig.grip(Action::kClose));
  rig.run(80);
  EXPECT_GT(rig.nearest_m(0), 0.9);  // the border, 1 m away
  // The robots face each other, 1 m from axle to axle: r2's laser is at 0.035, the can's far side
  // at 0.147.
  ASSERT_FALSE(rig.simulation.place_object("r1", {1.5, 1.5, 0.0}));
  ASSERT_FALSE(rig.simulation.place_object("r2", {2.5, 1.5, kPi}));
  rig.run(20);
  EXPECT_NEAR(rig.nearest_m(1), 1.0 - 0.035 - 0.147, 0.002);
  ASSERT_FALSE(rig.grip(Action::kOpen));
  rig.run(20);
  EXPECT_NEAR(rig.nearest_m(1), 1.0 - 0.035 - 0.147, 0.002);
}

TEST(Gripper, Load_HiddenFromOwnFinderAndMap) {
  Simulation simulation(load_world_text(
      R"({"arena": {"size": [4, 3], "obstacles": [{"name": "can", "center": [1.127, 1],
          "size": [0.04, 0.04], "fiducial": 7, "colour": "#00ff00", "portable": true}]},
          "robots": [{"name": "r1", "pose": {"x": 1, "y": 1}, "devices": {"fiducial": {},
                      "gripper": {"length": 0.08, "opening": 0.12, "travel_time": 1}}},
                     {"name": "r2", "pose": {"x": 2, "y": 1, "yaw_deg": 180},
                      "devices": {"fiducial": {}, "blobfinder": {"height": 0.05}}}]})"));
  const auto seen_by = [&](int robot) {
    return dynamic_cast<const FiducialFinder&>(
               simulation.device(robot, simulation.find_device(robot, "fiducial").value()))
        .reading()
        .marks.size();
  };
  const auto occupied = [&] {
    return true_map(simulation.world().arena, {.width = 400, .height = 300, .cell_size_m = 0.01})
        .at(112, 199);
  };
  const auto run = [&](int steps) {
    for (int i = 0; i < steps; ++i) simulation.step();
  };
  run(10);
  EXPECT_EQ(seen_by(0), 1U);
  EXPECT_EQ(seen_by(1), 1U);
  EXPECT_EQ(occupied(), 1.0F);
  ASSERT_FALSE(simulation.apply({0, simulation.find_device(0, "gripper").value()},
                                GripCommand{Action::kClose}));
  run(80);
  EXPECT_EQ(simulation.world().arena.obstacles[0].carried_by, 0);
  EXPECT_EQ(seen_by(0), 0U);
  EXPECT_EQ(seen_by(1), 1U);
  EXPECT_EQ(occupied(), 0.0F);
  // r2 sees it in front of r1, in its own colour.
  const auto& blobs = dynamic_cast<const Blobfinder&>(
                          simulation.device(1, simulation.find_device(1, "blobfinder").value()))
                          .reading()
                          .blobs;
  EXPECT_TRUE(std::any_of(blobs.begin(), blobs.end(), [](const auto& blob) {
    return blob.colour == Colour{0, 0xff, 0, 0xff};
  }));
}

TEST(Gripper, Load_BlocksNobody) {
  Rig rig(kCan);
  ASSERT_FALSE(rig.grip(Action::kClose));
  rig.run(70);
  // The can is 0.147 ahead: it reaches the border before the robot's front, at 0.087, does.
  rig.drive({0.4, 0.0}, 900);
  EXPECT_NEAR(rig.simulation.body(0).X_WB.x_m, 4.0 - 0.087, 0.002);
  EXPECT_GT(rig.pose_of("can").x_m + 0.02, 4.0);
}

TEST(Gripper, ReleaseWithoutRoom_Refused) {
  Rig rig(kCan);
  ASSERT_FALSE(rig.grip(Action::kClose));
  rig.run(70);
  rig.drive({0.4, 0.0}, 900);
  const auto refusal = rig.grip(Action::kOpen);
  ASSERT_TRUE(refusal);
  EXPECT_THAT(*refusal, HasSubstr("obstacle can cannot be put down: it would stick out"));
  rig.run(10);
  EXPECT_EQ(rig.reading().state, GripperState::kError);
  EXPECT_TRUE(rig.reading().holding);
  rig.drive({-0.4, 0.0}, 50);
  ASSERT_FALSE(rig.grip(Action::kOpen));
  rig.run(10);
  EXPECT_EQ(rig.reading().state, GripperState::kMoving);
  EXPECT_FALSE(rig.reading().holding);
  // Nor on another robot, nor on a block.
  ASSERT_FALSE(rig.simulation.place_object("can", {1.127, 1.0, 0.0}));
  ASSERT_FALSE(rig.simulation.place_object("r1", {1.0, 1.0, 0.0}));
  rig.run(100);
  ASSERT_FALSE(rig.grip(Action::kClose));
  rig.run(70);
  ASSERT_FALSE(rig.simulation.place_object("r1", {2.85, 2.5, 0.0}) &&
               rig.simulation.place_object("r1", {2.8, 2.5, 0.0}));
  EXPECT_THAT(rig.grip(Action::kOpen).value_or(""), HasSubstr("robot r2 stands there"));
}

TEST(Gripper, UngrippableObject_StopsIt) {
  // Three things that cannot be taken: one is wider than the opening, one is not portable, and one
  // is a wall across the tips.
  for (const char* thing :
       {R"({"name": "b", "center": [1.127, 1.05], "size": [0.04, 0.04], "portable": true})",
        R"({"name": "b", "center": [1.127, 1], "size": [0.04, 0.04]})",
        R"({"name": "b", "center": [1.2, 1], "size": [0.1, 1]})"}) {
    Rig rig(thing);
    ASSERT_FALSE(rig.grip(Action::kClose));
    rig.run(100);
    EXPECT_EQ(rig.reading().state, GripperState::kError) << thing;
    EXPECT_FALSE(rig.reading().holding);
    ASSERT_FALSE(rig.grip(Action::kOpen));
    rig.run(100);
    EXPECT_EQ(rig.reading().state, GripperState::kOpen);
  }
}

TEST(Gripper, ObjectsBeside_Untouched) {
  Rig rig(R"({"name": "b", "center": [1.127, 1.1], "size": [0.04, 0.04], "portable": true})");
  ASSERT_FALSE(rig.grip(Action::kClose));
  rig.run(100);
  EXPECT_EQ(rig.reading().state, GripperState::kClosed);
  EXPECT_FALSE(rig.reading().holding);
}

TEST(Gripper, Store_HoldsObjects) {
  Rig rig(kCan, R"(, "capacity": 1)");
  EXPECT_THAT(rig.grip(Action::kStore).value_or(""), HasSubstr("holds nothing"));
  EXPECT_THAT(rig.grip(Action::kRetrieve).value_or(""), HasSubstr("is empty"));
  ASSERT_FALSE(rig.grip(Action::kClose));
  rig.run(70);
  EXPECT_THAT(rig.grip(Action::kRetrieve).value_or(""), HasSubstr("is empty"));
  ASSERT_FALSE(rig.grip(Action::kStore));
  rig.run(100);
  EXPECT_EQ(rig.reading().state, GripperState::kOpen);
  EXPECT_EQ(rig.reading().stored, 1);
  EXPECT_FALSE(rig.reading().inner_beam);
  EXPECT_NEAR(rig.pose_of("can").x_m, 1.0, 1e-12);  // inside the robot
  rig.drive({0.2, 0.0}, 100);
  ASSERT_FALSE(rig.grip(Action::kRetrieve));
  rig.run(10);
  EXPECT_EQ(rig.reading().state, GripperState::kClosed);
  EXPECT_EQ(rig.reading().stored, 0);
  EXPECT_NEAR(rig.reading().gap_m, 0.04, 1e-9);
  EXPECT_NEAR(rig.pose_of("can").x_m, rig.simulation.body(0).X_WB.x_m + 0.127, 1e-9);
  Rig without(kCan);
  ASSERT_FALSE(without.grip(Action::kClose));
  without.run(70);
  EXPECT_THAT(without.grip(Action::kStore).value_or(""), HasSubstr("holds 0 things at most"));
}

TEST(Gripper, ObjectPlacedElsewhere_Lost) {
  Rig rig(kCan);
  ASSERT_FALSE(rig.grip(Action::kClose));
  rig.run(70);
  ASSERT_FALSE(rig.simulation.place_object("can", {3.0, 1.0, 0.0}));
  rig.drive({0.2, 0.0}, 50);
  rig.run(10);
  EXPECT_FALSE(rig.reading().holding);
  EXPECT_NEAR(rig.pose_of("can").x_m, 3.0, 1e-12);
  // It is solid there: robots collide with it. Its near side is at 2.98.
  ASSERT_FALSE(rig.grip(Action::kOpen));
  rig.drive({0.4, 0.0}, 600);
  EXPECT_NEAR(rig.simulation.body(0).X_WB.x_m, 2.98 - 0.087, 0.002);
}

TEST(Portable, MayBePutBeyondFloor) {
  Rig rig(std::string(kCan) + R"(, {"name": "block", "center": [3, 1]})");
  EXPECT_FALSE(rig.simulation.place_object("can", {-10.0, -10.0, 0.0}));
  EXPECT_NEAR(rig.pose_of("can").x_m, -10.0, 1e-12);
  EXPECT_TRUE(rig.simulation.place_object("block", {-10.0, -10.0, 0.0}));
}

TEST(Portable, Carried_KeepsState) {
  Rig rig(R"({"name": "can", "type": "dynamic", "center": [1.127, 1], "size": [0.04, 0.04], )"
          R"("portable": true})");
  ASSERT_FALSE(rig.grip(Action::kClose));
  rig.run(70);
  EXPECT_THAT(rig.simulation.set_obstacle_state("can", ObstacleState::kRetracted).value_or(""),
              HasSubstr("is carried by robot r1"));
  ASSERT_FALSE(rig.grip(Action::kOpen));
  EXPECT_FALSE(rig.simulation.set_obstacle_state("can", ObstacleState::kRetracted));
  rig.run(100);
  ASSERT_FALSE(rig.grip(Action::kClose));
  rig.run(100);
  EXPECT_FALSE(rig.reading().holding);  // nothing to hold there
}

TEST(Gripper, Reset_StartsAnew) {
  Rig rig(kCan);
  ASSERT_FALSE(rig.grip(Action::kClose));
  rig.run(70);
  rig.drive({0.2, 0.5}, 100);
  rig.simulation.reset();
  rig.run(10);
  EXPECT_EQ(rig.reading().state, GripperState::kOpen);
  EXPECT_NEAR(rig.pose_of("can").x_m, 1.127, 1e-12);
  EXPECT_NEAR(rig.nearest_m(0), 0.072, 0.002);
}

TEST(Gripper, OffOrSuspended_StandsStill) {
  Rig rig(kCan);
  ASSERT_FALSE(rig.grip(Action::kClose));
  rig.run(30);
  ASSERT_FALSE(rig.simulation.set_robot_dynamics(0, false));
  rig.run(100);
  EXPECT_NEAR(rig.device().gap_m(), 0.7 * 0.12, 1e-9);
  ASSERT_FALSE(rig.simulation.set_robot_dynamics(0, true));
  rig.simulation.set_active(rig.gripper, false);
  rig.run(100);
  EXPECT_NEAR(rig.device().gap_m(), 0.7 * 0.12, 1e-9);
}

TEST(Gripper, Repeatable) {
  const auto run = [] {
    Rig rig(kCan);
    EXPECT_FALSE(rig.grip(Action::kClose));
    rig.run(70);
    rig.drive({0.2, 0.5}, 100);
    const std::uint64_t carrying = rig.simulation.state_hash();
    EXPECT_FALSE(rig.grip(Action::kOpen));
    rig.drive({-0.2, 0.5}, 100);
    return std::pair(carrying, rig.simulation.state_hash());
  };
  EXPECT_EQ(run(), run());
}

TEST(Gripper, InvalidSettings_Refused) {
  try {
    static_cast<void>(world_with("", R"(, "capacity": 101)"));
    FAIL() << "a store of 101 was read";
  } catch (const ConfigError& error) {
    ASSERT_EQ(error.issues().size(), 1U);
    EXPECT_EQ(error.issues()[0].id, "world/out-of-range");
    EXPECT_EQ(error.issues()[0].pointer, "/robots/0/devices/gripper/capacity");
  }
}

}  // namespace
}  // namespace sim
