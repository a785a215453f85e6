// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// The optional sensors of robots: collision, battery, proximity, infrared and sonar.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "sim/core/error.h"
#include "sim/core/number_text.h"
#include "sim/devices/battery.h"
#include "sim/devices/bumper.h"
#include "sim/devices/contact_sensors.h"
#include "sim/devices/laser.h"
#include "sim/devices/proximity.h"
#include "sim/devices/rangers.h"
#include "sim/scan/cone.h"
#include "sim/simulation/simulation.h"

namespace sim {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr double kDegrees = std::numbers::pi / 180.0;

/// A robot in the format of world files.
std::string robot(const std::string& name, double x, double y, double yaw_deg,
                  const std::string& devices = "{}") {
  return R"({"name": ")" + name + R"(", "pose": {"x": )" + fixed_text(x, 6) + R"(, "y": )" +
         fixed_text(y, 6) + R"(, "yaw_deg": )" + fixed_text(yaw_deg, 6) + R"(}, "devices": )" +
         devices + "}";
}

/// A room of 4 x 4 m; `more` goes into the arena.
WorldDescription room(const std::string& robots, const std::string& more = "") {
  return load_world_text(R"({"arena": {"size": [4, 4])" + (more.empty() ? "" : ", " + more) +
                         R"(}, "robots": [)" + robots + "]}");
}

template <typename ReadingType>
const ReadingType& reading(const Simulation& simulation, const std::string& device, int robot = 0) {
  const int index = simulation.find_device(robot, device).value();
  return dynamic_cast<const ReadingType&>(
      dynamic_cast<const Sensor&>(simulation.device(robot, index)).reading());
}

void drive(Simulation& simulation, double v, double omega = 0.0, int robot = 0) {
  const auto refusal = simulation.apply({robot, simulation.find_device(robot, "motion").value()},
                                        TwistCommand{{.v_mps = v, .omega_radps = omega}});
  ASSERT_FALSE(refusal.has_value()) << *refusal;
}

void run(Simulation& simulation, int steps) {
  for (int i = 0; i < steps; ++i) simulation.step();
}

// --- collision

// The S1R extends 0.087 m ahead, so at x = 1.463 it is 50 mm from a face at x = 1.6.
constexpr const char* kBlock =
    R"("obstacles": [{"name": "block", "center": [1.8, 2], "size": [0.4, 0.4]}])";

TEST(LaserReading, BeforeFirstScan_NothingNear) {
  LaserReading reading;
  reading.range_max_m = 5.0;
  EXPECT_EQ(reading.least_range_m(), 5.0);
  EXPECT_EQ(reading.least_angle_rad(), 0.0);
}

TEST(CollisionSensor, ContactBetweenReadings_Reported) {
  Simulation simulation(
      room(robot("r1", 1.463, 2, 0, R"({"collision": {"frequency": 1}})"), kBlock));
  drive(simulation, 0.5);
  run(simulation, 20);  // free motion would be 100 mm
  drive(simulation, -0.2);
  run(simulation, 80);
  ASSERT_EQ(reading<CollisionReading>(simulation, "collision").sequence, 1U);
  ASSERT_LT(simulation.body(0).X_WB.x_m, 1.4);  // far away from the block
  EXPECT_TRUE(reading<CollisionReading>(simulation, "collision").collision);
  EXPECT_THAT(reading<CollisionReading>(simulation, "collision").objects, ElementsAre("block"));
  run(simulation, 100);
  ASSERT_EQ(reading<CollisionReading>(simulation, "collision").sequence, 2U);
  EXPECT_FALSE(reading<CollisionReading>(simulation, "collision").collision);
  EXPECT_THAT(reading<CollisionReading>(simulation, "collision").objects, IsEmpty());
}

TEST(CollisionSensor, LastingContact_InEachReading) {
  Simulation simulation(room(robot("r1", 1.463, 2, 0, R"({"collision": {}})"), kBlock));
  run(simulation, 10);
  EXPECT_FALSE(reading<CollisionReading>(simulation, "collision").collision);
  drive(simulation, 0.5);
  run(simulation, 10);  // it reaches the block
  for (int i = 0; i < 5; ++i) {
    run(simulation, 10);
    EXPECT_TRUE(reading<CollisionReading>(simulation, "collision").collision) << i;
  }
  EXPECT_EQ(simulation.statistics(0).collisions, 1);
  drive(simulation, 0.0);  // at rest, still touching
  run(simulation, 100);
  EXPECT_THAT(reading<CollisionReading>(simulation, "collision").objects, ElementsAre("block"));
}

TEST(CollisionSensor, EachObject_NamedOnceInOrder) {
  // r1 is 1 mm from the left and the bottom border, and r2 is 1 mm ahead of it. All distances are
  // below the 2 mm that count as touching.
  Simulation simulation(room(robot("r1", 0.088, 0.082, 0, R"({"collision": {}})") + "," +
                             robot("r2", 0.263, 0.082, 0, R"({"collision": {}})")));
  run(simulation, 10);
  EXPECT_THAT(reading<CollisionReading>(simulation, "collision", 0).objects,
              ElementsAre("border", "r2"));
  EXPECT_THAT(reading<CollisionReading>(simulation, "collision", 1).objects,
              ElementsAre("border", "r1"));
}

TEST(CollisionSensor, DockSeparatorsAndMapWalls_Named) {
  WorldDescription world = room(
      robot("r1", 0.912, 1.5, 0, R"({"collision": {}})") + "," +
          robot("r2", 3, 3, 0, R"({"collision": {}})"),
      R"("dock_separators": [{"name": "separator1", "center": [3.188, 3], "size": [0.2, 0.2]}])");
  world.arena.walls.push_back({{{1, 1}, {2, 1}, {2, 2}, {1, 2}}});
  Simulation simulation(std::move(world));
  run(simulation, 10);
  EXPECT_THAT(reading<CollisionReading>(simulation, "collision", 0).objects, ElementsAre("wall"));
  EXPECT_THAT(reading<CollisionReading>(simulation, "collision", 1).objects,
              ElementsAre("separator1"));
}

// --- battery

TEST(BatteryLoad, GrowsWithWheelSpeed) {
  BatteryParams params;
  params.idle_power_w = 6.0;
  params.drive_power_ws_per_m = 8.0;
  EXPECT_DOUBLE_EQ(battery_load_w(params, {}, 0.14), 6.0);
  EXPECT_DOUBLE_EQ(battery_load_w(params, {0.5, 0.0}, 0.14), 10.0);
  EXPECT_DOUBLE_EQ(battery_load_w(params, {-0.5, 0.0}, 0.14), 10.0);
  // Turning on the spot at 3 rad/s: wheels at -+ 3 * 0.07 = 0.21 m/s.
  EXPECT_DOUBLE_EQ(battery_load_w(params, {0.0, 3.0}, 0.14), 6.0 + 8.0 * 0.21);
  // Wheels at 0.29 and 0.71 m/s: their mean is the robot's speed.
  EXPECT_DOUBLE_EQ(battery_load_w(params, {0.5, -3.0}, 0.14), 10.0);
  // Sideways and ahead, 0.5 m/s in total.
  EXPECT_DOUBLE_EQ(battery_load_w(params, {0.3, 0.0, -0.4}, 0.14), 10.0);
}

TEST(BatteryVoltage, LinearInCharge) {
  const BatteryParams params;
  EXPECT_DOUBLE_EQ(battery_voltage_v(params, 0.0), 9.0);
  EXPECT_DOUBLE_EQ(battery_voltage_v(params, 0.5), 10.8);
  EXPECT_DOUBLE_EQ(battery_voltage_v(params, 1.0), 12.6);
}

TEST(Dock, RotatedArea_ContainsRobot) {
  DockDescription dock;
  dock.pose = {1.0, 2.0, 30.0 * kDegrees};
  dock.size = {0.4, 0.2};
  EXPECT_TRUE(is_on_dock(dock, {1.0, 2.0}));
  EXPECT_TRUE(is_on_dock(dock, dock.pose * Vec2(0.199, 0.099)));
  EXPECT_FALSE(is_on_dock(dock, dock.pose * Vec2(0.201, 0.0)));
  EXPECT_FALSE(is_on_dock(dock, dock.pose * Vec2(0.0, -0.101)));
  EXPECT_FALSE(is_on_dock(dock, {1.0 + 0.199, 2.0 + 0.099}));  // on it without the rotation
}

TEST(Battery, DrainsWithTimeAndDriving) {
  Simulation simulation(
      room(robot("r1", 0.5, 2, 0, R"({"battery": {"capacity": 1, "initial_charge": 60}})")));
  run(simulation, 1000);
  drive(simulation, 0.2);
  run(simulation, 1000);
  // 60 % of 3600 J, minus 10 s at 6 W and 10 s at 6 + 8 * 0.2 W: 2160 - 60 - 76 = 2024 J.
  const auto& battery = reading<BatteryReading>(simulation, "battery");
  EXPECT_NEAR(battery.charge_percent, 100.0 * 2024.0 / 3600.0, 1e-9);
  EXPECT_NEAR(battery.energy_wh, 2024.0 / 3600.0, 1e-11);
  EXPECT_NEAR(battery.voltage_v, 9.0 + 3.6 * 2024.0 / 3600.0, 1e-10);
  EXPECT_EQ(battery.capacity_wh, 1.0);
  EXPECT_EQ(battery.status, BatteryStatus::kDischarging);
  EXPECT_EQ(battery.sequence, 200U);
}

TEST(Battery, StalledRobot_DrainsLikeDriving) {
  const std::string devices = R"({"battery": {"capacity": 1}})";
  Simulation simulation(
      room(robot("r1", 1.5, 2, 0, devices) + "," + robot("r2", 0.5, 1, 0, devices), kBlock));
  drive(simulation, 0.25, 0.0, 0);
  drive(simulation, 0.25, 0.0, 1);
  run(simulation, 500);
  ASSERT_TRUE(simulation.body(0).stalled);
  ASSERT_FALSE(simulation.body(1).stalled);
  EXPECT_EQ(reading<BatteryReading>(simulation, "battery", 0).charge_percent,
            reading<BatteryReading>(simulation, "battery", 1).charge_percent);
}

TEST(Battery, Dock_ChargesOnlyThere) {
  Simulation simulation(
      room(robot("r1", 1, 1, 0, R"({"battery": {"capacity": 0.02, "initial_charge": 0}})"),
           R"("docks": [{"pose": {"x": 1, "y": 1, "yaw_deg": 90}}])"));
  const auto& battery = reading<BatteryReading>(simulation, "battery");
  run(simulation, 100);  // 1 s at 40 W into 72 J
  EXPECT_NEAR(battery.charge_percent, 100.0 * 40.0 / 72.0, 1e-9);
  EXPECT_EQ(battery.status, BatteryStatus::kCharging);
  run(simulation, 100);  // full after 1.8 s
  EXPECT_EQ(battery.charge_percent, 100.0);
  EXPECT_EQ(battery.status, BatteryStatus::kCharged);
  drive(simulation, 0.5);
  run(simulation, 20);  // 0.1 m of the 0.12 m to the dock's edge
  EXPECT_EQ(battery.status, BatteryStatus::kCharged);
  drive(simulation, 0.5);
  run(simulation, 10);  // 0.15 m: out since step 25 of these 30, where x = 1.125 m
  EXPECT_EQ(battery.status, BatteryStatus::kDischarging);
  drive(simulation, 0.0);
  run(simulation, 10);
  // 10 steps (or 11: step 24 ends exactly on the edge) at 10 W and 10 at 6 W are outside.
  EXPECT_NEAR(battery.energy_wh * 3600.0, 72.0 - 0.6 - 0.65, 0.06);
}

TEST(Battery, Empty_RobotStillDrives) {
  Simulation simulation(
      room(robot("r1", 0.5, 2, 0, R"({"battery": {"capacity": 0.001, "initial_charge": 50}})")));
  drive(simulation, 0.5);
  run(simulation, 400);  // 1.8 J at 10 W last 0.18 s
  EXPECT_EQ(reading<BatteryReading>(simulation, "battery").charge_percent, 0.0);
  EXPECT_EQ(reading<BatteryReading>(simulation, "battery").voltage_v, 9.0);
  EXPECT_NEAR(simulation.body(0).X_WB.x_m, 2.5, 1e-9);
}

TEST(BatteryStatus, HasWordsOfMorse) {
  EXPECT_EQ(to_string(BatteryStatus::kCharged), "Charged");
  EXPECT_EQ(to_string(BatteryStatus::kCharging), "Charging");
  EXPECT_EQ(to_string(BatteryStatus::kDischarging), "Discharging");
}

// --- proximity

using Neighbour = ProximityReading::Neighbour;

TEST(Proximity, RobotsInRange_ReportedByName) {
  Simulation simulation(room(robot("me", 1, 1, 0, R"({"proximity": {}})") + "," +
                             robot("zoe", 1, 2, 0) + "," +        // exactly 1 m: near
                             robot("amy", 1.375, 1.5, 0) + "," +  // 0.375, 0.5: 0.625 m
                             robot("far", 2.1, 1, 0)));
  run(simulation, 10);
  EXPECT_THAT(reading<ProximityReading>(simulation, "proximity").near_objects,
              ElementsAre(Neighbour{"amy", 0.625}, Neighbour{"zoe", 1.0}));
}

TEST(Proximity, DrivingRobots_Followed) {
  Simulation simulation(
      room(robot("me", 1, 1, 0, R"({"proximity": {}})") + "," + robot("far", 2.1, 1, 180)));
  drive(simulation, 0.5, 0.0, 1);
  run(simulation, 50);
  const auto& near = reading<ProximityReading>(simulation, "proximity").near_objects;
  ASSERT_EQ(near.size(), 1U);
  EXPECT_NEAR(near[0].distance_m, 1.1 - 0.25, 1e-9);
}

TEST(Proximity, Obstacles_ReportedOnRequest) {
  Simulation simulation(
      room(robot("me", 1, 1, 0, R"({"proximity": {"obstacles": true, "range": 2}})") + "," +
               robot("block", 1, 2.5, 0),
           R"("obstacles": [{"name": "block", "center": [2, 1]},
                            {"name": "trap", "center": [1, 2], "type": "dynamic",
                             "state": "retracted"},
                            {"name": "away", "center": [3.5, 3.5]}],
              "dock_separators": [{"name": "separator1", "center": [1, 0.5]}])"));
  run(simulation, 10);
  // Of two robots with the same name, the nearer one comes first.
  EXPECT_THAT(
      reading<ProximityReading>(simulation, "proximity").near_objects,
      ElementsAre(Neighbour{"block", 1.0}, Neighbour{"block", 1.5}, Neighbour{"separator1", 0.5}));
  ASSERT_FALSE(simulation.set_obstacle_state("trap", ObstacleState::kExtended).has_value());
  run(simulation, 10);
  EXPECT_EQ(reading<ProximityReading>(simulation, "proximity").near_objects.back(),
            (Neighbour{"trap", 1.0}));
}

// --- infrared and sonar

TEST(Infrared, Ring_MeasuresRoom) {
  Simulation simulation(load_world_text(R"({"arena": {"size": [1, 1]}, "robots": [)" +
                                        robot("r1", 0.5, 0.5, 0, R"({"infrared": {}})") + "]}"));
  run(simulation, 10);
  const auto& ring = reading<RangerReading>(simulation, "infrared");
  // Ahead 0.5 - 0.081, sideways 0.5 - 0.075, into the corners sqrt(2) (0.5 - 0.061).
  const double corner = std::sqrt(2.0) * 0.439;
  const std::vector<double> expected{0.419, corner, 0.425, corner, 0.419, corner, 0.425, corner};
  ASSERT_EQ(ring.ranges_m.size(), expected.size());
  ASSERT_EQ(ring.X_BS.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    // Exact to 1e-7 of the maximum range.
    EXPECT_NEAR(ring.ranges_m[i], expected[i], 1e-6) << i;
  }
  EXPECT_EQ(ring.range_max_m, 0.8);
  EXPECT_EQ(ring.field_of_view_rad, 0.0);
}

TEST(Infrared, NothingMet_ReadsLimit) {
  Simulation simulation(room(robot("r1", 2, 2, 30, R"({"infrared": {"noise": 0.1}})")));
  run(simulation, 10);
  for (const double range : reading<RangerReading>(simulation, "infrared").ranges_m) {
    EXPECT_EQ(range, 0.8);
  }
}

TEST(Infrared, LowObjects_NotSeen) {
  const std::string sill =
      R"("obstacles": [{"name": "sill", "center": [2.5, 2], "size": [0.2, 2], "height": 0.049}])";
  const std::string mounts = R"("mounts": [{"x": 0.05}])";
  Simulation over(room(robot("r1", 2, 2, 0, R"({"infrared": {)" + mounts + "}}"), sill));
  Simulation below(
      room(robot("r1", 2, 2, 0, R"({"infrared": {"height": 0.04, )" + mounts + "}}"), sill));
  run(over, 10);
  run(below, 10);
  EXPECT_THAT(reading<RangerReading>(over, "infrared").ranges_m, ElementsAre(0.8));
  // From x = 2.05 to the face at 2.4.
  EXPECT_NEAR(reading<RangerReading>(below, "infrared").ranges_m[0], 0.35, 1e-6);
}

TEST(Infrared, TransducerInsideSolid_ReadsZeroAlone) {
  Simulation simulation(room(
      robot("r1", 1.4, 2, 0, R"({"infrared": {"mounts": [{"x": 0.3}, {"x": 0.1}]}})"), kBlock));
  run(simulation, 10);
  const auto& ranges = reading<RangerReading>(simulation, "infrared").ranges_m;
  EXPECT_EQ(ranges[0], 0.0);          // at x = 1.7, 0.1 m inside the block
  EXPECT_NEAR(ranges[1], 0.1, 1e-6);  // at x = 1.5
}

TEST(Infrared, Several_SeeOtherRobotsNotOwn) {
  Simulation simulation(room(robot("r1", 1, 2, 0,
                                   R"({"front": {"type": "infrared", "mounts": [{"x": -0.05}]},
                     "rear": {"type": "infrared", "mounts": [{"x": -0.05, "yaw_deg": 180}]}})") +
                             "," + robot("r2", 1.5, 2, 0)));
  run(simulation, 10);
  // From x = 0.95 through its own body to the back of r2 at 1.5 - 0.087.
  EXPECT_NEAR(reading<RangerReading>(simulation, "front").ranges_m[0], 0.463, 1e-6);
  EXPECT_EQ(reading<RangerReading>(simulation, "rear").ranges_m[0], 0.8);
}

// --- bumper

using Pressed = std::vector<std::uint8_t>;

TEST(BumperSegments, SurroundFootprint) {
  const std::vector<BumperSegment> sides = segments_round(s1r_model().footprint);
  ASSERT_EQ(sides.size(), 8U);
  // The front side, from (0.087, -0.045) to (0.087, 0.045), faces ahead.
  EXPECT_NEAR(sides[0].X_BS.x_m, 0.087, 1e-12);
  EXPECT_NEAR(sides[0].X_BS.y_m, 0.0, 1e-12);
  EXPECT_NEAR(sides[0].X_BS.yaw_rad, 0.0, 1e-12);
  EXPECT_NEAR(sides[0].length_m, 0.09, 1e-12);
  EXPECT_EQ(sides[0].radius_m, 0.0);
  // Side 2, from (0.05, 0.081) to (-0.05, 0.081), faces left; side 4 faces back.
  EXPECT_NEAR(sides[2].X_BS.yaw_rad, 90.0 * kDegrees, 1e-12);
  EXPECT_NEAR(sides[2].length_m, 0.1, 1e-12);
  EXPECT_NEAR(std::abs(sides[4].X_BS.yaw_rad), std::numbers::pi, 1e-12);
}

TEST(BumperSegments, DistanceToPoint_Known) {
  const BumperSegment straight{{0.2, 0.1, 0.0}, 0.1, 0.0};  // x = 0.2, y from 0.05 to 0.15
  EXPECT_NEAR(distance_to_segment_m(straight, {0.25, 0.12}), 0.05, 1e-12);
  EXPECT_NEAR(distance_to_segment_m(straight, {0.23, 0.01}), 0.05, 1e-12);  // 3, 4, 5
  // A quarter of a circle of 0.1 m around the origin, from -45 to 45 degrees.
  const BumperSegment arc{{0.1, 0.0, 0.0}, 0.05 * std::numbers::pi, 0.1};
  EXPECT_NEAR(distance_to_segment_m(arc, {0.15 * std::cos(0.7), 0.15 * std::sin(0.7)}), 0.05,
              1e-12);
  EXPECT_NEAR(distance_to_segment_m(arc, {0.0, 0.1}), 0.2 * std::sin(22.5 * kDegrees), 1e-12);
  EXPECT_NEAR(distance_to_segment_m(arc, {0.02, 0.0}), 0.08, 1e-12);
  // The same arc on the other side, facing back.
  const BumperSegment turned{{-0.1, 0.0, std::numbers::pi}, 0.05 * std::numbers::pi, 0.1};
  EXPECT_NEAR(distance_to_segment_m(turned, {0.0, -0.1}), 0.2 * std::sin(22.5 * kDegrees), 1e-12);
}

TEST(BumperSegments, Touch_PressesNearest) {
  // Three along x = 0.1: y from -0.15 to -0.05, to 0.05, to 0.15.
  const std::vector<BumperSegment> row = {
      {{0.1, -0.1, 0.0}, 0.1, 0.0}, {{0.1, 0.0, 0.0}, 0.1, 0.0}, {{0.1, 0.1, 0.0}, 0.1, 0.0}};
  const auto pressed = [&](const Vec2& from, const Vec2& to) {
    Pressed result(3, 0);
    press_segments(row, 0.05, from, to, result);
    return result;
  };
  EXPECT_EQ(pressed({0.1, 0.02}, {0.1, 0.02}), (Pressed{0, 1, 0}));
  EXPECT_EQ(pressed({0.1, 0.05}, {0.1, 0.05}), (Pressed{0, 1, 1}));    // the joint
  EXPECT_EQ(pressed({0.1, 0.052}, {0.1, 0.052}), (Pressed{0, 0, 1}));  // 2 mm beside it
  EXPECT_EQ(pressed({0.1, -0.12}, {0.1, 0.12}), (Pressed{1, 1, 1}));   // a flat wall
  EXPECT_EQ(pressed({0.13, 0.17}, {0.13, 0.17}), (Pressed{0, 0, 1}));  // 3.6 cm away
  EXPECT_EQ(pressed({0.16, 0.0}, {0.16, 0.0}), (Pressed{0, 0, 0}));    // 6 cm: out of reach
}

Pressed pressed(const Simulation& simulation, int robot = 0) {
  return reading<BumperReading>(simulation, "bumper", robot).pressed;
}

TEST(Bumper, FlatWall_PressesFlatFront) {
  Simulation simulation(room(robot("r1", 3.5, 2, 0, R"({"bumper": {}})")));
  run(simulation, 10);
  EXPECT_EQ(pressed(simulation), Pressed(8, 0));
  drive(simulation, 0.5);  // 0.413 m to the border
  run(simulation, 70);
  EXPECT_EQ(pressed(simulation), Pressed(8, 0));
  run(simulation, 30);
  // The front, and at its ends the joints to the two adjacent sides.
  EXPECT_EQ(pressed(simulation), (Pressed{1, 1, 0, 0, 0, 0, 0, 1}));
  drive(simulation, -0.1);
  run(simulation, 20);
  EXPECT_EQ(pressed(simulation), Pressed(8, 0));
}

TEST(Bumper, Corner_PressesTouchedSide) {
  // A block whose corner (2.5, 2.02) touches the front, 2 cm left of its centre.
  const std::string tip = R"("obstacles": [{"name": "tip", "center": [)" +
                          fixed_text(2.5 + 0.2 * std::sqrt(0.5), 6) +
                          R"(, 2.02], "size": [0.2, 0.2], "yaw_deg": 45}])";
  const std::string two = R"({"bumper": {"segments": [
      {"x": 0.087, "y": 0.03, "length": 0.06}, {"x": 0.087, "y": -0.03, "length": 0.06}]}})";
  Simulation simulation(room(robot("r1", 2, 2, 0, two), tip));
  drive(simulation, 0.5);  // 0.413 m to the corner, which then turns the robot
  run(simulation, 90);
  EXPECT_EQ(pressed(simulation), (Pressed{1, 0}));
}

TEST(Bumper, TouchBetweenReadings_Reported) {
  Simulation simulation(room(robot("r1", 3.9, 2, 0, R"({"bumper": {"frequency": 1}})")));
  drive(simulation, 0.5);  // 13 mm to the border
  run(simulation, 30);
  drive(simulation, -0.5);
  run(simulation, 69);
  EXPECT_EQ(simulation.body(0).X_WB.x_m < 3.8, true);
  run(simulation, 1);
  EXPECT_EQ(pressed(simulation), (Pressed{1, 1, 0, 0, 0, 0, 0, 1}));
  run(simulation, 100);
  EXPECT_EQ(pressed(simulation), Pressed(8, 0));
}

TEST(Bumper, OtherRobots_PressBothSides) {
  Simulation simulation(room(robot("r1", 1.0, 2, 0, R"({"bumper": {}})") + "," +
                             robot("r2", 1.3, 2, 0, R"({"bumper": {}})")));
  drive(simulation, 0.3);
  run(simulation, 80);
  EXPECT_EQ(pressed(simulation, 0)[0], 1);  // r1 with its front
  EXPECT_EQ(pressed(simulation, 1)[4], 1);  // r2 with its back
  EXPECT_EQ(pressed(simulation, 1)[0], 0);
}

// --- cones

using scan::Cone;
using scan::EdgeBuffer;
using scan::least_range_in_cone_m;

// The outline of a box, solid on its left.
void add_box(EdgeBuffer& edges, const Pose& X_WO, double half_x, double half_y) {
  const std::array<Vec2, 4> corners = {X_WO * Vec2(half_x, -half_y), X_WO * Vec2(half_x, half_y),
                                       X_WO * Vec2(-half_x, half_y), X_WO * Vec2(-half_x, -half_y)};
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec2& a = corners[i];
    const Vec2& b = corners[(i + 1) % 4];
    edges.add(static_cast<float>(a.x()), static_cast<float>(a.y()), static_cast<float>(b.x()),
              static_cast<float>(b.y()));
  }
}

TEST(LeastRangeInCone, FootSideOrCorner_Nearest) {
  EdgeBuffer edges;
  add_box(edges, {3.0, 0.0, 0.0}, 1.0, 1.0);  // its face at x = 2, y from -1 to 1
  const auto least = [&](double yaw_deg, double field_deg) {
    return least_range_in_cone_m(edges.edges(), {0, 0, yaw_deg * kDegrees, field_deg * kDegrees},
                                 5.0);
  };
  EXPECT_DOUBLE_EQ(least(0.0, 30.0), 2.0);                              // the foot of the face
  EXPECT_DOUBLE_EQ(least(14.0, 30.0), 2.0);                             // still within
  EXPECT_DOUBLE_EQ(least(20.0, 30.0), 2.0 / std::cos(5.0 * kDegrees));  // where the side meets it
  EXPECT_DOUBLE_EQ(least(-20.0, 30.0), 2.0 / std::cos(5.0 * kDegrees));
  // The corner (2, 1) lies at 26.57 degrees; a cone from 26 on meets the face just below it.
  EXPECT_DOUBLE_EQ(least(41.0, 30.0), 2.0 / std::cos(26.0 * kDegrees));
  EXPECT_DOUBLE_EQ(least(42.0, 30.0), 5.0);   // from 27 on: past it
  EXPECT_DOUBLE_EQ(least(180.0, 30.0), 5.0);  // behind the sensor
  EXPECT_DOUBLE_EQ(least(90.0, 180.0), 2.0);  // a half-plane, whose border is the foot's ray
  EXPECT_DOUBLE_EQ(least(0.0, 0.0), 2.0);     // a ray
  EXPECT_DOUBLE_EQ(least(20.0, 0.0), 2.0 / std::cos(20.0 * kDegrees));
  EXPECT_DOUBLE_EQ(least_range_in_cone_m(edges.edges(), {0.5, 0.25, 0.0, 0.0}, 1.25), 1.25);
  EXPECT_DOUBLE_EQ(least_range_in_cone_m(edges.edges(), {0.5, 0.25, 0.0, 0.5}, 5.0), 1.5);
  // From inside the box, its faces point away.
  EXPECT_DOUBLE_EQ(least_range_in_cone_m(edges.edges(), {3.0, 0.0, 0.0, 1.0}, 5.0), 5.0);
}

TEST(LeastRangeInCone, NarrowObjects_Seen) {
  EdgeBuffer edges;
  add_box(edges, {4.0, 0.5, 0.0}, 0.0005, 0.0005);  // 1 mm wide, 0.014 degrees
  EXPECT_NEAR(least_range_in_cone_m(edges.edges(), {0, 0, 0, 30.0 * kDegrees}, 5.0),
              std::hypot(3.9995, 0.4995), 1e-6);
}

// The slow reference: beams that fill the cone, at most 0.25 degrees apart, including both its
// sides.
double least_of_beams(const EdgeBuffer& edges, double yaw_rad, double field_of_view_rad,
                      double range_max_m) {
  const int half = static_cast<int>(std::ceil(0.5 * field_of_view_rad / (0.25 * kDegrees)));
  scan::ScanKernel kernel({2 * half + 1, 0.5 * field_of_view_rad / half, range_max_m});
  std::vector<double> ranges(static_cast<std::size_t>(2 * half + 1));
  kernel.scan(edges, yaw_rad, ranges);
  return *std::min_element(ranges.begin(), ranges.end());
}

TEST(LeastRangeInCone, MatchesBeamsAndCorners) {
  RandomStream random(7, "cones");
  const auto in = [&](double low, double high) { return low + (high - low) * random.uniform(); };
  int met = 0;
  for (int round = 0; round < 2000; ++round) {
    EdgeBuffer edges;
    for (int box = 0; box < 12; ++box) {
      const double angle = in(-3.1, 3.1);
      const double distance = in(0.8, 6.0);
      add_box(edges, {distance * std::cos(angle), distance * std::sin(angle), in(-3.1, 3.1)},
              in(0.01, 0.4), in(0.01, 0.4));
    }
    const double yaw = in(-3.1, 3.1);
    const double field = in(1.0, 180.0) * kDegrees;
    // Beams may miss corners between them, but nothing else that matters.
    double expected = least_of_beams(edges, yaw, field, 5.0);
    for (const scan::Edge& edge : edges.edges()) {
      const Vec2 a(edge.x0_m, edge.y0_m);
      const double off = std::abs(normalize_angle(std::atan2(a.y(), a.x()) - yaw));
      if (off <= 0.5 * field) expected = std::min(expected, a.norm());
    }
    const double found = least_range_in_cone_m(edges.edges(), {0, 0, yaw, field}, 5.0);
    // The foot of a wall is at most 0.125 degrees from a beam: 2.4e-6 of the range.
    ASSERT_NEAR(found, expected, 3e-6 * expected) << round;
    ASSERT_LE(found, expected + 1e-6);
    if (found < 5.0) ++met;
  }
  EXPECT_GT(met, 1500);
}

TEST(LeastRangeInCone, ZeroWidth_MatchesBeam) {
  RandomStream random(7, "rays");
  for (int round = 0; round < 2000; ++round) {
    EdgeBuffer edges;
    for (int box = 0; box < 12; ++box) {
      const double angle = 6.2 * random.uniform();
      add_box(edges, {3.0 * std::cos(angle), 3.0 * std::sin(angle), 3.0 * random.uniform()}, 0.3,
              0.2);
    }
    const double yaw = 6.2 * random.uniform() - 3.1;
    scan::ScanKernel kernel({1, 0.1, 5.0});
    std::vector<double> beam(1);
    kernel.scan(edges, yaw, beam);
    ASSERT_NEAR(least_range_in_cone_m(edges.edges(), {0, 0, yaw, 0.0}, 5.0), beam[0], 1e-5)
        << round;
  }
}

// Rays that end exactly at corners of a closed outline never pass through them.
TEST(LeastRangeInCone, Joints_Opaque) {
  EdgeBuffer edges;
  constexpr int kCorners = 360;
  const auto corner = [](int i) {
    const double angle = 2.0 * std::numbers::pi * (i % kCorners) / kCorners;
    return Vec2(2.0 * std::cos(angle), 2.0 * std::sin(angle));
  };
  for (int i = 0; i < kCorners; ++i) {  // a round room: clockwise, solid outside
    const Vec2 a = corner(i + 1);
    const Vec2 b = corner(i);
    edges.add(static_cast<float>(a.x()), static_cast<float>(a.y()), static_cast<float>(b.x()),
              static_cast<float>(b.y()));
  }
  for (int i = 0; i < kCorners; ++i) {
    const scan::Edge& edge = edges.edges()[static_cast<std::size_t>(i)];
    const double yaw = std::atan2(static_cast<double>(edge.y1_m), static_cast<double>(edge.x1_m));
    for (const double turn : {0.0, 1e-17, 1e-16, -1e-16, 1e-9}) {
      EXPECT_LT(least_range_in_cone_m(edges.edges(), {0, 0, yaw + turn, 0.0}, 5.0), 2.001) << i;
    }
  }
}

TEST(InfraredVoltage, MatchesTypicalValuesOfDataSheet) {
  const InfraredParams params;
  const auto voltage = [&](double range_m) {
    return infrared_voltage_v(range_m, params.voltage_gain_vm, params.voltage_shift_m);
  };
  EXPECT_NEAR(voltage(0.8), 0.4, 1e-12);
  EXPECT_NEAR(voltage(0.1), 2.4, 1e-12);
  EXPECT_NEAR(voltage(0.2), 1.4, 1e-12);  // 0.336 / 0.24
}

// One transducer at the centre of the robot, with a cone of 30 degrees.
constexpr const char* kSonar = R"({"sonar": {"mounts": [{}]}})";

double sonar_range(const Simulation& simulation) {
  return reading<RangerReading>(simulation, "sonar").ranges_m.at(0);
}

TEST(Sonar, LeastRangeInCone_Read) {
  // A wall 2 m ahead. At 10 degrees its foot is inside the cone.
  Simulation within(room(robot("r1", 2, 2, 10, kSonar)));
  run(within, 10);
  EXPECT_NEAR(sonar_range(within), 2.0, 1e-6);
  // At 20 degrees the cone's side is nearest, 5 degrees from the foot.
  Simulation beside(room(robot("r1", 2, 2, 20, kSonar)));
  run(beside, 10);
  EXPECT_NEAR(sonar_range(beside), 2.0 / std::cos(5.0 * kDegrees), 1e-6);
}

TEST(Sonar, Corner_SeenOnlyInsideCone) {
  // A box on its corner: the corner that faces the robot is at (3, 2.2), 11.3 degrees to the left.
  const std::string side = fixed_text(0.4 / std::sqrt(2.0), 6);
  const auto tip = [&](double y) {
    return R"("obstacles": [{"name": "tip", "center": [3.2, )" + fixed_text(y, 6) +
           R"(], "yaw_deg": 45, "size": [)" + side + ", " + side + "]}]";
  };
  Simulation in_cone(room(robot("r1", 2, 2, 0, kSonar), tip(2.2)));
  run(in_cone, 10);
  // Its size is written with 6 digits.
  EXPECT_NEAR(sonar_range(in_cone), std::hypot(1.0, 0.2), 2e-6);
  // 0.5 m further to the left its lowest corner (3.2, 2.5) is at 22.6 degrees: the sonar sees the
  // wall.
  Simulation beside(room(robot("r1", 2, 2, 0, kSonar), tip(2.7)));
  run(beside, 10);
  EXPECT_NEAR(sonar_range(beside), 2.0, 1e-6);
}

TEST(Sonar, Default_LeftAheadAndRight) {
  Simulation simulation(room(robot("r1", 2, 3.5, 0, R"({"sonar": {}})")));
  run(simulation, 10);
  const auto& sonar = reading<RangerReading>(simulation, "sonar");
  ASSERT_EQ(sonar.ranges_m.size(), 3U);
  // Left: mounted at y = 3.561, 0.439 m below the border; the upper side of its cone rises at 60
  // degrees.
  EXPECT_NEAR(sonar.ranges_m[0], 0.439 / std::sin(60.0 * kDegrees), 1e-5);
  // Ahead, at x = 2.081: the border above is at 0.5 / sin 15 = 1.93 m, the border ahead at 1.919 m.
  EXPECT_NEAR(sonar.ranges_m[1], 1.919, 2e-5);
  // Right, at x = 2.061: its cone covers -60 to -30 degrees, where the border ahead is nearest.
  EXPECT_NEAR(sonar.ranges_m[2], 1.939 / std::cos(30.0 * kDegrees), 1e-5);
  EXPECT_NEAR(sonar.field_of_view_rad, 30.0 * kDegrees, 1e-12);
}

TEST(Sonar, Noise_HasDeviation) {
  Simulation simulation(room(
      robot("r1", 2, 2, 0, R"({"sonar": {"mounts": [{}], "noise": 0.02, "frequency": 100}})")));
  constexpr int kReadings = 10000;
  double sum = 0.0;
  double squares = 0.0;
  for (int i = 0; i < kReadings; ++i) {
    simulation.step();
    const double error = sonar_range(simulation) - 2.0;
    sum += error;
    squares += error * error;
  }
  // Four standard errors: of a mean sigma / sqrt(n), of a deviation sigma / sqrt(2 n).
  EXPECT_NEAR(sum / kReadings, 0.0, 4.0 * 0.02 / std::sqrt(kReadings));
  EXPECT_NEAR(std::sqrt(squares / kReadings), 0.02, 4.0 * 0.02 / std::sqrt(2.0 * kReadings));
}

TEST(Sonar, Noise_StaysInRange) {
  // 2 m to the wall, and a limit of 2.01 m: half of all errors of 0.1 m would be beyond it.
  Simulation simulation(room(
      robot("r1", 2, 2, 0,
            R"({"sonar": {"mounts": [{}], "noise": 0.1, "range_max": 2.01, "frequency": 100}})")));
  int at_limit = 0;
  for (int i = 0; i < 100; ++i) {
    simulation.step();
    ASSERT_LE(sonar_range(simulation), 2.01);
    if (sonar_range(simulation) == 2.01) ++at_limit;
  }
  EXPECT_GT(at_limit, 20);
}

// --- all sensors

constexpr const char* kAll =
    R"({"battery": {}, "bumper": {}, "collision": {}, "infrared": {"noise": 0.01},
        "proximity": {"obstacles": true}, "sonar": {"noise": 0.02},
        "laser": {"noise": 0.01, "beams": 37, "resolution_deg": 5}})";

// Two robots that collide with the block and each other.
std::uint64_t hash_of_a_drive(WorldDescription world) {
  Simulation simulation(std::move(world));
  for (int i = 0; i < 500; ++i) {
    if (i % 50 == 0) {
      drive(simulation, 0.5 - 0.01 * (i / 50), 0.3 * ((i / 50) % 3 - 1), 0);
      drive(simulation, 0.4, -0.2, 1);
    }
    simulation.step();
  }
  return simulation.state_hash();
}

TEST(AddedSensors, EqualSeeds_EqualRuns) {
  WorldDescription world =
      room(robot("r1", 1.2, 2, 0, kAll) + "," + robot("r2", 1.2, 2.3, -20, kAll), kBlock);
  const std::uint64_t first = hash_of_a_drive(world);
  EXPECT_EQ(hash_of_a_drive(world), first);
  world.simulation.seed = 2;
  EXPECT_NE(hash_of_a_drive(world), first);
}

TEST(AddedSensors, IncludedInHash) {
  const auto hash = [](const std::string& devices) {
    return hash_of_a_drive(
        room(robot("r1", 1.2, 2, 0, devices) + "," + robot("r2", 1.2, 2.3, -20), kBlock));
  };
  const std::uint64_t without = hash("{}");
  EXPECT_NE(hash(R"({"collision": {}})"), without);
  EXPECT_NE(hash(R"({"proximity": {}})"), without);
  EXPECT_NE(hash(R"({"battery": {}})"), hash(R"({"battery": {"initial_charge": 99}})"));
  EXPECT_NE(hash(R"({"sonar": {}})"), hash(R"({"sonar": {"noise": 0.01}})"));
}

TEST(AddedSensors, NoiseOfOthers_Unchanged) {
  const std::string laser = R"("laser": {"noise": 0.01})";
  Simulation alone(room(robot("r1", 2, 2, 0, "{" + laser + "}")));
  Simulation with_sonar(room(robot("r1", 2, 2, 0, "{" + laser + R"(, "sonar": {"noise": 0.02}})")));
  run(alone, 100);
  run(with_sonar, 100);
  EXPECT_EQ(reading<LaserReading>(alone, "laser").ranges_m,
            reading<LaserReading>(with_sonar, "laser").ranges_m);
}

/// Invalid settings, and their errors.
struct BadSettings {
  const char* type;
  const char* settings;
  const char* id;
  const char* place;  ///< below the device's
  const char* words;
};

void PrintTo(const BadSettings& bad, std::ostream* out) { *out << bad.type << bad.settings; }

class BadSensor : public testing::TestWithParam<BadSettings> {};

TEST_P(BadSensor, RefusedWithIdPlaceAndReason) {
  const BadSettings& bad = GetParam();
  try {
    static_cast<void>(
        room(robot("r1", 2, 2, 0, std::string("{\"") + bad.type + "\": " + bad.settings + "}")));
    FAIL() << "these settings were read";
  } catch (const ConfigError& error) {
    ASSERT_EQ(error.issues().size(), 1U) << error.what();
    const ConfigIssue& issue = error.issues()[0];
    EXPECT_EQ(issue.id, bad.id);
    EXPECT_EQ(issue.pointer, std::string("/robots/0/devices/") + bad.type + bad.place);
    EXPECT_THAT(issue.message(), HasSubstr(bad.words));
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, BadSensor,
    testing::Values(
        BadSettings{"collision", R"({"frequency": 0})", "world/out-of-range", "/frequency", "Hz"},
        BadSettings{"battery", R"({"capacity": 0})", "world/out-of-range", "/capacity", "W h"},
        BadSettings{"battery", R"({"initial_charge": 101})", "world/out-of-range",
                    "/initial_charge", "from 0 to 100 percent"},
        BadSettings{"battery", R"({"idle_power": -1})", "world/out-of-range", "/idle_power", "W"},
        BadSettings{"battery", R"({"empty_voltage": 13})", "device/battery-voltage", "",
                    "13 V empty, 12.6 V full"},
        BadSettings{"bumper", R"({"reach": 0})", "world/out-of-range", "/reach", "m"},
        BadSettings{"bumper", R"({"segments": {}})", "world/wrong-type", "/segments", "a list"},
        BadSettings{"bumper", R"({"segments": [{}, {"length": 0}]})", "world/out-of-range",
                    "/segments/1/length", "m"},
        BadSettings{"bumper", R"({"segments": [{"yaw": 1}]})", "world/unknown-key",
                    "/segments/0/yaw", "yaw_deg"},
        BadSettings{"bumper", R"({"segments": [{"length": 0.7, "radius": 0.1}]})",
                    "device/bumper-segment", "/segments/0", "whole circle"},
        BadSettings{"infrared", R"({"voltage_gain": 0})", "world/out-of-range", "/voltage_gain",
                    "V m"},
        BadSettings{"proximity", R"({"range": 0})", "world/out-of-range", "/range", "m"},
        BadSettings{"proximity", R"({"obstacles": 1})", "world/wrong-type", "/obstacles",
                    "true or false"},
        BadSettings{"infrared", R"({"field_of_view_deg": 10})", "world/unknown-key",
                    "/field_of_view_deg", "frequency"},
        BadSettings{"sonar", R"({"ranges_max": [2, 1]})", "device/transducers", "/ranges_max",
                    "as many as there are mounts: 3"},
        BadSettings{"sonar", R"({"ranges_max": [2, 1, 3.5]})", "device/transducers", "/ranges_max",
                    "3.5 m"},
        BadSettings{"sonar", R"({"ranges_max": [2, 1, 3], "intensity": 1})", "device/transducers",
                    "/ranges_max", "intensity"},
        BadSettings{"sonar", R"({"heights": [0.1, -1, 0.1]})", "world/out-of-range", "/heights/1",
                    "a length"},
        BadSettings{"infrared", R"({"mounts": {"x": 0}})", "world/wrong-type", "/mounts", "a list"},
        BadSettings{"sonar", R"({"mounts": [{}, 1]})", "world/wrong-type", "/mounts/1",
                    "an object"},
        BadSettings{"sonar", R"({"mounts": [{"yaw": 1}]})", "world/unknown-key", "/mounts/0/yaw",
                    "yaw_deg"},
        BadSettings{"sonar", R"({"mounts": [{"x": "a"}]})", "world/wrong-type", "/mounts/0/x",
                    "a number"},
        BadSettings{"sonar", R"({"field_of_view_deg": 0})", "world/out-of-range",
                    "/field_of_view_deg", "degrees"},
        BadSettings{"sonar", R"({"range_max": 0})", "world/out-of-range", "/range_max", "m"},
        BadSettings{"sonar", R"({"noise": -0.1})", "world/out-of-range", "/noise", "m"}));

TEST(Rangers, AtMost1024Transducers) {
  const auto issues = [](int count) {
    std::string mounts = "{}";
    for (int i = 1; i < count; ++i) mounts += ", {}";
    try {
      static_cast<void>(room(robot("r1", 2, 2, 0, R"({"sonar": {"mounts": [)" + mounts + "]}}")));
    } catch (const ConfigError& error) {
      return error.issues();
    }
    return std::vector<ConfigIssue>{};
  };
  EXPECT_THAT(issues(1024), IsEmpty());
  ASSERT_EQ(issues(1025).size(), 1U);
  EXPECT_EQ(issues(1025)[0].id, "world/too-many");
  EXPECT_THAT(issues(1025)[0].message(), HasSubstr("at most 1024"));
}

}  // namespace
}  // namespace sim
