// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Sensors and actuators of space and air: MORSE's components on the plane.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "sim/core/elevation.h"
#include "sim/core/error.h"
#include "sim/devices/air_sensors.h"
#include "sim/devices/coordinates.h"
#include "sim/devices/gps.h"
#include "sim/devices/localization.h"
#include "sim/devices/posture.h"
#include "sim/devices/proximity.h"
#include "sim/devices/semantic_camera.h"
#include "sim/devices/space_sensors.h"
#include "sim/simulation/simulation.h"

namespace sim {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr double kPi = std::numbers::pi;

// A room of 20 x 20 m with a robot of the model omni at its middle, which looks along x.
WorldDescription room_with(const std::string& devices, const std::string& more = "",
                           const std::string& arena = "") {
  return load_world_text(R"({"arena": {"size": [20, 20])" + arena +
                         R"(}, "robots": [{"name": "r1", "model": "omni", )"
                         R"("pose": {"x": 10, "y": 10})" +
                         more + R"(, "devices": {"laser": null, )" + devices + "}}]}");
}

Simulation::DeviceId id_of(const Simulation& simulation, const std::string& device) {
  return {0, simulation.find_device(0, device).value()};
}

template <typename Kind>
const Kind& device(const Simulation& simulation, const std::string& name) {
  return dynamic_cast<const Kind&>(simulation.device(0, id_of(simulation, name).device));
}

void step(Simulation& simulation, int steps) {
  for (int i = 0; i < steps; ++i) simulation.step();
}

void send(Simulation& simulation, const std::string& name, const Command& command) {
  EXPECT_EQ(simulation.apply(id_of(simulation, name), command), std::nullopt);
}

TEST(Elevation, Angles_RoundTripThroughRotation) {
  const EulerAngles angles = euler_angles_of(rotation_of(0.3, -0.4, 2.5));
  EXPECT_NEAR(angles.roll_rad, 0.3, 1e-12);
  EXPECT_NEAR(angles.pitch_rad, -0.4, 1e-12);
  EXPECT_NEAR(angles.yaw_rad, 2.5, 1e-12);
  // A positive pitch turns the x axis down.
  EXPECT_LT(rotation_of(0.0, 0.1, 0.0)(2, 0), 0.0);
}

TEST(Elevation, BodyRates_FollowFromAngleRates) {
  // Upright, yaw alone is a turn about z; with the nose up by a quarter turn it is one about x.
  EXPECT_THAT(body_rates({0, 0, 1}, {0, 0, 0.5}), ElementsAre(0.0, 0.0, 0.5));
  const auto up = body_rates({0, -0.5 * kPi, 0}, {0, 0, 0.5});
  EXPECT_NEAR(up[0], 0.5, 1e-12);
  EXPECT_NEAR(up[2], 0.0, 1e-12);
}

TEST(Elevation, PhysicsIgnoresIt) {
  const std::string devices = R"("teleport": {}, "pose": {"frequency": 100})";
  Simulation simulation(room_with(devices, R"(, "elevation": {"z": 5, "pitch_deg": 90})"));
  step(simulation, 2);
  const auto& reading = device<PoseSensor>(simulation, "pose").reading();
  EXPECT_DOUBLE_EQ(reading.elevation.z_m, 5.0);
  EXPECT_DOUBLE_EQ(reading.elevation.pitch_rad, 0.5 * kPi);
  PlaceCommand place{{8.0, 10.0, 1.0}};
  place.z_m = 7.0;  // roll and pitch keep their values
  send(simulation, "teleport", place);
  step(simulation, 1);
  EXPECT_EQ(device<PoseSensor>(simulation, "pose").reading().elevation,
            (Elevation{7.0, 0.0, 0.5 * kPi}));
  EXPECT_DOUBLE_EQ(simulation.body(0).X_WB.x_m, 8.0);
}

TEST(Mounting, PoseSensor_MovedOnBody) {
  Simulation simulation(room_with(R"("pose": {"x": 1, "z": 0.5, "yaw_deg": 90})"));
  step(simulation, 20);
  const auto& reading = device<PoseSensor>(simulation, "pose").reading();
  EXPECT_NEAR(reading.pose.x_m, 11.0, 1e-12);
  EXPECT_NEAR(reading.pose.yaw_rad, 0.5 * kPi, 1e-12);
  EXPECT_NEAR(reading.elevation.z_m, 0.5, 1e-12);
}

TEST(Mounting, InvalidCarrier_Refused) {
  try {
    Simulation simulation(room_with(R"("gyroscope": {"on": "odometry"})"));
    FAIL() << "an odometry carries a gyroscope";
  } catch (const ConfigError& error) {
    EXPECT_THAT(error.what(), HasSubstr("ptz or actarray"));
  }
}

TEST(Gyroscope, TurnsWithItsCarrier) {
  Simulation simulation(room_with(R"("head": {"type": "ptz"}, "gyroscope": {"on": "head"},)"
                                  R"("posture": {"of": "head"})"));
  send(simulation, "head", PointCommand{0.5, 0.3, 0.0, 0.0, 0.0});
  step(simulation, 200);
  const auto& reading = device<Gyroscope>(simulation, "gyroscope").reading();
  EXPECT_NEAR(reading.yaw_rad, 0.5, 1e-12);
  EXPECT_NEAR(reading.pitch_rad, -0.3, 1e-12);  // a head that looks up has its nose up
  EXPECT_NEAR(reading.roll_rad, 0.0, 1e-12);
  const auto& posture = device<Posture>(simulation, "posture").reading();
  EXPECT_THAT(posture.joints, ElementsAre("pan", "tilt"));
  EXPECT_THAT(posture.positions, ElementsAre(0.5, 0.3));
}

TEST(Velocity, AxesOfSensor_Used) {
  Simulation simulation(room_with(R"("velocity": {"yaw_deg": 90, "pitch_deg": 90})"));
  send(simulation, "motion", TwistCommand{{.v_mps = 0.5, .omega_radps = 0.3}});
  step(simulation, 200);
  // The sensor's x axis points down, its y axis backwards, its z axis to the left.
  const auto& reading = device<Velocity>(simulation, "velocity").reading();
  EXPECT_NEAR(reading.linear_mps[0], 0.0, 1e-9);
  EXPECT_NEAR(reading.linear_mps[1], -0.5, 1e-9);
  EXPECT_NEAR(reading.angular_radps[0], -0.3, 1e-9);
  const double yaw = simulation.body(0).X_WB.yaw_rad;
  EXPECT_NEAR(reading.world_mps[0], 0.5 * std::cos(yaw), 1e-9);
}

TEST(Accelerometer, MeanSinceLastReading) {
  Simulation simulation(
      room_with(R"("accelerometer": {}, "motion": {"max_acceleration": 2, "max_speed": 1})"));
  send(simulation, "motion", TwistCommand{{.v_mps = 1.0}});
  step(simulation, 30);  // 0.3 s: still 2 m/s^2
  const auto& reading = device<Accelerometer>(simulation, "accelerometer").reading();
  EXPECT_NEAR(reading.acceleration_mps2[0], 2.0, 1e-9);
  EXPECT_NEAR(reading.velocity_mps[0], 0.6, 1e-9);
  // From 0.2 s to 0.3 s: 0.1 s at a mean of 0.5 m/s, but for half a step.
  EXPECT_NEAR(reading.distance_m, 0.05, 0.002);
}

TEST(Attitude, AnglesAndRates_Measured) {
  Simulation simulation(room_with(R"("attitude": {}, "orientation": {"speed_deg": 10})"));
  OrientCommand wanted;
  wanted.yaw_rad = 1.0;
  send(simulation, "orientation", wanted);
  step(simulation, 100);  // 1 s
  const auto& reading = device<Attitude>(simulation, "attitude").reading();
  EXPECT_NEAR(reading.yaw_rad, 10.0 * kPi / 180.0, 1e-9);
  EXPECT_NEAR(reading.rate_radps[2], 10.0 * kPi / 180.0, 1e-9);
}

TEST(Orientation, ShortWay_TurnsAndStops) {
  Simulation simulation(room_with(R"("orientation": {"speed_deg": 90, "tolerance_deg": 0})"));
  OrientCommand wanted;
  wanted.yaw_rad = -0.75 * kPi;
  send(simulation, "orientation", wanted);
  step(simulation, 50);  // half a second: 45 degrees
  EXPECT_NEAR(simulation.body(0).X_WB.yaw_rad, -0.25 * kPi, 1e-9);
  step(simulation, 150);
  EXPECT_NEAR(simulation.body(0).X_WB.yaw_rad, -0.75 * kPi, 1e-8);
  wanted.pitch_rad = 0.2;
  send(simulation, "orientation", wanted);
  step(simulation, 100);
  EXPECT_NEAR(simulation.body(0).elevation.pitch_rad, 0.2, 1e-8);
  EXPECT_NEAR(simulation.body(0).X_WB.yaw_rad, -0.75 * kPi, 1e-8);
  wanted.roll_rad = std::nan("");
  EXPECT_TRUE(simulation.apply(id_of(simulation, "orientation"), wanted).has_value());
}

TEST(Barometer, MatchesStandardAtmosphere) {
  // The table of the standard atmosphere: 1013.25 hPa at sea level, 898.76 hPa at 1000 m.
  EXPECT_DOUBLE_EQ(pressure_at_pa(101325.0, 0.0), 101325.0);
  EXPECT_NEAR(pressure_at_pa(101325.0, 1000.0), 89876.0, 10.0);  // 5 Pa: g is 9.81, not 9.80665
  Simulation simulation(
      room_with(R"("barometer": {}, "teleport": {})", R"(, "elevation": {"z": 3})"));
  step(simulation, 20);
  EXPECT_DOUBLE_EQ(device<Barometer>(simulation, "barometer").reading().pressure_pa, 101325.0);
  PlaceCommand place{{8.0, 10.0, 0.0}};
  place.z_m = 103.0;
  send(simulation, "teleport", place);
  step(simulation, 20);
  EXPECT_NEAR(device<Barometer>(simulation, "barometer").reading().pressure_pa, 100129.0, 0.5);
}

TEST(Airspeed, HalfDensityTimesSquaredSpeed) {
  Simulation simulation(room_with(R"("airspeed": {"yaw_deg": 60})"));
  send(simulation, "motion", TwistCommand{{.v_mps = 1.0}});
  step(simulation, 200);
  // cos(60 degrees) of 1 m/s: 0.5 * 1.225 * 0.25.
  EXPECT_NEAR(device<Airspeed>(simulation, "airspeed").reading().pressure_pa, 0.153125, 1e-9);
}

TEST(Altimeter, DistanceToFloorOrObstacle_Measured) {
  const std::string box = R"(, "obstacles": [{"center": [15, 10], "size": [2, 2], "height": 2}])";
  Simulation simulation(room_with(R"("altimeter": {"range": 25}, "teleport": {})",
                                  R"(, "elevation": {"z": 20})", box));
  step(simulation, 20);
  const auto& altimeter = device<Altimeter>(simulation, "altimeter");
  EXPECT_DOUBLE_EQ(altimeter.reading().height_m, 20.0);
  EXPECT_TRUE(altimeter.reading().in_range);
  PlaceCommand place{{8.0, 10.0, 0.0}};
  place.z_m = 30.0;
  send(simulation, "teleport", place);
  step(simulation, 20);
  EXPECT_FALSE(altimeter.reading().in_range);
}

TEST(Thermometer, TaggedFires_Felt) {
  const std::string fire = R"(, "obstacles": [{"center": [15, 10], "tags": ["Fire"]},)"
                           R"({"center": [10, 15]}])";
  Simulation simulation(room_with(R"("thermometer": {"air": 25})", "", fire));
  step(simulation, 20);
  // 5 m away: 200 exp(-0.2 * 5).
  EXPECT_NEAR(device<Thermometer>(simulation, "thermometer").reading().temperature_c,
              25.0 + 200.0 * std::exp(-1.0), 1e-9);
}

TEST(Clock, TicksAtFrequency) {
  Simulation simulation(room_with(R"("clock": {"frequency": 20})"));
  step(simulation, 100);
  EXPECT_EQ(device<ClockSensor>(simulation, "clock").reading().sequence, 20U);
  EXPECT_EQ(device<ClockSensor>(simulation, "clock").reading().time_ns, kNanosecondsPerSecond);
}

TEST(SemanticCamera, VisibleTaggedObjects_Named) {
  const std::string boxes =
      R"(, "obstacles": [{"name": "red", "center": [14, 10], "height": 1, "tags": ["Object"]},)"
      R"({"name": "hidden", "center": [17, 10], "height": 1, "tags": ["Object"]},)"
      R"({"name": "plain", "center": [14, 11], "height": 1},)"
      R"({"name": "behind", "center": [6, 10], "height": 1, "tags": ["Object"]}])";
  Simulation simulation(
      room_with(R"("world": {"type": "semantic_camera", "z": 0.4},)"
                R"("own": {"type": "semantic_camera", "z": 0.4, "relative": true},)"
                R"("through": {"type": "semantic_camera", "z": 0.4, "occlusion": false})",
                "", boxes));
  step(simulation, 20);
  const auto& seen = device<SemanticCamera>(simulation, "world").reading().objects;
  ASSERT_EQ(seen.size(), 1U);
  EXPECT_EQ(seen[0].name, "red");
  EXPECT_THAT(seen[0].position_m, ElementsAre(14.0, 10.0, 0.5));
  EXPECT_DOUBLE_EQ(seen[0].scalar, 1.0);
  const auto& own = device<SemanticCamera>(simulation, "own").reading().objects;
  ASSERT_EQ(own.size(), 1U);
  EXPECT_NEAR(own[0].position_m[0], 0.0, 1e-12);   // to the right
  EXPECT_NEAR(own[0].position_m[1], -0.1, 1e-12);  // down: its middle is over the camera
  EXPECT_NEAR(own[0].position_m[2], 4.0, 1e-12);   // ahead
  EXPECT_NEAR(std::abs(own[0].scalar), 0.5, 1e-12);
  EXPECT_EQ(device<SemanticCamera>(simulation, "through").reading().objects.size(), 2U);
}

TEST(Proximity, ChangingTag_Found) {
  const std::string boxes = R"(, "obstacles": [{"name": "a", "center": [12, 10], "tags": ["one"]},)"
                            R"({"name": "b", "center": [10, 14], "tags": ["two"]}])";
  Simulation simulation(
      room_with(R"("proximity": {"range": 3, "track": "one", "obstacles": true})", "", boxes));
  const auto& near = device<Proximity>(simulation, "proximity");
  step(simulation, 20);
  ASSERT_EQ(near.reading().near_objects.size(), 1U);
  EXPECT_EQ(near.reading().near_objects[0].name, "a");
  send(simulation, "proximity", TrackCommand{5.0, "two"});
  step(simulation, 20);
  ASSERT_EQ(near.reading().near_objects.size(), 1U);
  EXPECT_EQ(near.reading().near_objects[0].name, "b");
  EXPECT_TRUE(simulation.apply(id_of(simulation, "proximity"), TrackCommand{-1.0, {}}).has_value());
}

TEST(Waypoint, Stop_RollsOut) {
  Simulation simulation(room_with(R"("waypoint": {"stop_deceleration": 1, "approach_gain": 50})"));
  send(simulation, "waypoint", GotoCommand{{18.0, 10.0}, 0.1, 1.0});
  step(simulation, 200);
  const double x_m = simulation.body(0).X_WB.x_m;
  const double v_mps = simulation.body(0).twist.v_mps;
  send(simulation, "waypoint", StopCommand{});
  step(simulation, 150);
  // v^2 / 2a, but for a step. (The motors could stop faster.)
  EXPECT_NEAR(simulation.body(0).X_WB.x_m - x_m, v_mps * v_mps / 2.0, 0.011);
  EXPECT_EQ(simulation.body(0).twist.v_mps, 0.0);
}

TEST(Coordinates, MatchEarth) {
  CoordinateParams ecef;
  ecef.ecef = true;
  // MORSE keeps these in single precision.
  ecef.longitude_deg = 43.6F;
  ecef.latitude_deg = 1.4333F;
  ecef.altitude_m = 135.0;
  // Figures from MORSE's own test of its modifier, to its precision.
  const Eigen::Vector3d p = to_message(ecef, {100.0, 200.0, 50.0});
  EXPECT_NEAR(p.x(), 4617493.329, 0.02);
  EXPECT_NEAR(p.y(), 4397317.326, 0.02);
  EXPECT_NEAR(p.z(), 158674.47893, 0.02);
  EXPECT_NEAR((from_message(ecef, p) - Eigen::Vector3d(100.0, 200.0, 50.0)).norm(), 0.0, 1e-6);
  CoordinateParams geodetic = ecef;
  geodetic.ecef = false;
  geodetic.geodetic = true;
  const Eigen::Vector3d g = to_message(geodetic, {100.0, 200.0, 50.0});
  EXPECT_NEAR(g.x(), 43.6008970, 2e-6);
  EXPECT_NEAR(g.y(), 1.43510869, 2e-6);
  EXPECT_NEAR(g.z(), 185.0039, 0.02);
  EXPECT_NEAR((from_message(geodetic, g) - Eigen::Vector3d(100.0, 200.0, 50.0)).norm(), 0.0, 1e-6);
}

TEST(Coordinates, NedFeetAndUtm_Invertible) {
  CoordinateParams params;
  params.ned = params.feet = params.utm = true;
  params.utm_offset_m = {1.0, 2.0, 3.0};
  const Eigen::Vector3d p = to_message(params, {10.0, 20.0, 30.0});
  EXPECT_NEAR(p.x(), 22.0 * 3.2808399, 1e-9);
  EXPECT_NEAR(p.z(), -33.0 * 3.2808399, 1e-9);
  EXPECT_NEAR((from_message(params, p) - Eigen::Vector3d(10.0, 20.0, 30.0)).norm(), 0.0, 1e-9);
}

TEST(Gps, PositionInWorldAndHeight_Read) {
  Simulation simulation(room_with(R"("gps": {})", R"(, "elevation": {"z": 4})"));
  step(simulation, 20);
  const auto& reading = device<Gps>(simulation, "gps").reading();
  EXPECT_NEAR(reading.position_m[0], 10.0, 1e-9);
  EXPECT_NEAR(reading.position_m[1], 10.0, 1e-9);
  EXPECT_NEAR(reading.position_m[2], 4.0, 1e-9);
  EXPECT_NEAR(reading.altitude_m, 204.0, 1e-9);
  EXPECT_NEAR(reading.heading_rad, 0.5 * kPi, 1e-9);  // east
}

TEST(Tags, Blanks_Refused) {
  try {
    static_cast<void>(room_with(R"("pose": {})", R"(, "tags": ["no blanks"])"));
    FAIL() << "a tag with a blank was read";
  } catch (const ConfigError& error) {
    EXPECT_EQ(error.issues().at(0).pointer, "/robots/0/tags/0");
  }
}

}  // namespace
}  // namespace sim
