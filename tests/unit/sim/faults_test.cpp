// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Faults of devices, which the arena controller gives them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "sim/devices/laser.h"
#include "sim/devices/motion.h"
#include "sim/devices/rangers.h"
#include "sim/simulation/simulation.h"
#include "simulation_runs.h"

namespace sim {
namespace {

using test::drive;
using test::run;
using testing::Each;
using testing::HasSubstr;
using testing::Lt;

/// A robot that looks along x in a room of 4 m x 4 m, with some timers or traps. Its laser measures
/// every 0.1 s.
Simulation robot_with(const std::string& controller) {
  return Simulation(load_world_text(R"({"arena": {"size": [4, 4]},
    "robots": [{"name": "r1", "pose": {"x": 1, "y": 2},
                "devices": {"laser": {"frequency": 10}, "sonar": {}, "infrared": {}}}],
    "controller": {)" + controller + "}}"));
}
Simulation robot_with_faults(const std::string& faults) {
  return robot_with(R"("timers": [)" + faults + "]");
}
/// A timer with a fault at a time.
std::string at(const std::string& time_s, const std::string& fault) {
  return R"({"at": )" + time_s + R"(, "do": [{"fault": {"robot": "r1", )" + fault + "}}]}";
}

const Device& device_of(const Simulation& simulation, const std::string& name) {
  return simulation.device(0, simulation.find_device(0, name).value());
}
template <typename ReadingType>
const ReadingType& reading_of(const Simulation& simulation, const std::string& name) {
  return dynamic_cast<const ReadingType&>(device_of(simulation, name).sensor()->reading());
}

TEST(DeviceFaults, DeadSensor_MakesNoReadingsUntilItIsRepaired) {
  Simulation simulation =
      robot_with_faults(at("0.55", R"("device": "laser", "kind": "dead")") + "," +
                        at("1.05", R"("device": "laser", "kind": "none")"));
  run(simulation, 1.0);
  EXPECT_EQ(reading_of<LaserReading>(simulation, "laser").sequence, 5U);
  EXPECT_EQ(reading_of<LaserReading>(simulation, "laser").time_ns, from_seconds(0.5));
  run(simulation, 0.1);
  EXPECT_EQ(reading_of<LaserReading>(simulation, "laser").time_ns, from_seconds(1.1));
  EXPECT_EQ(simulation.arena_events().newest.back().text, "the laser of r1 works again");
}

TEST(DeviceFaults, DeadMotors_StopAndRefuseCommands) {
  Simulation simulation = robot_with_faults(at("1", R"("device": "motion", "kind": "dead")"));
  drive(simulation, 0.2);
  run(simulation, 2.0);
  EXPECT_NEAR(simulation.body(0).X_WB.x_m, 1.2, 0.05);  // it starts and stops gently
  const int motion = simulation.find_device(0, "motion").value();
  EXPECT_TRUE(simulation.apply({0, motion}, TwistCommand{{.v_mps = 0.2}}));
}

TEST(DeviceFaults, BlindRangers_ReadTheirMaximum) {
  Simulation simulation =
      robot_with_faults(at("0.5", R"("device": "laser", "kind": "blind")") + "," +
                        at("0.5", R"("device": "sonar", "kind": "blind")") + "," +
                        at("0.5", R"("device": "infrared", "kind": "blind")"));
  run(simulation, 0.5);
  EXPECT_THAT(reading_of<LaserReading>(simulation, "laser").ranges_m, Each(Lt(4.0)));
  run(simulation, 0.5);
  const auto& laser = reading_of<LaserReading>(simulation, "laser");
  EXPECT_THAT(laser.ranges_m, Each(laser.range_max_m));
  for (const char* const name : {"sonar", "infrared"}) {
    const auto& ranger = reading_of<RangerReading>(simulation, name);
    EXPECT_THAT(ranger.ranges_m, Each(ranger.range_max_m)) << name;
  }
}

TEST(DeviceFaults, Jump_MovesTheEstimateOnce) {
  Simulation simulation = robot_with_faults(
      at("0.5", R"("device": "odometry", "kind": "jump", "by": {"x": 0.2, "yaw_deg": 90})"));
  run(simulation, 0.45);
  const Pose before = device_of(simulation, "odometry").pose_estimate().value();
  run(simulation, 0.5);
  const Pose after = device_of(simulation, "odometry").pose_estimate().value();
  EXPECT_NEAR(after.x_m, before.x_m + 0.2, 1e-12);
  EXPECT_NEAR(after.yaw_rad, before.yaw_rad + M_PI / 2, 1e-12);
  EXPECT_EQ(simulation.body(0).X_WB, (Pose{1.0, 2.0, 0.0}));
}

TEST(DeviceFaults, State_IsSavedAndReset) {
  const std::string faults = at("0.5", R"("device": "laser", "kind": "blind")");
  Simulation simulation = robot_with_faults(faults);
  run(simulation, 0.6);
  Simulation other = robot_with_faults(faults);
  EXPECT_NE(other.state_hash(), simulation.state_hash());
  other.restore(simulation.save());
  EXPECT_TRUE(device_of(other, "laser").blind());
  EXPECT_EQ(other.state_hash(), simulation.state_hash());
  EXPECT_FALSE(simulation.reset());
  EXPECT_FALSE(device_of(simulation, "laser").blind());
}

TEST(DeviceFaults, Trap_ConcernsRobotThatSprangIt) {
  Simulation simulation =
      robot_with(R"("traps": [{"region": {"circle": {"center": [1, 2], "radius": 0.3}},
                    "do": [{"fault": {"device": "laser"}}, {"fault": {"device": "arm"}}]}])");
  run(simulation, 0.1);
  EXPECT_FALSE(device_of(simulation, "laser").active());
  // Robots without a device are left alone.
  EXPECT_THAT(simulation.arena_events().newest.back().text, HasSubstr("laser of r1 is dead"));
}

}  // namespace
}  // namespace sim
