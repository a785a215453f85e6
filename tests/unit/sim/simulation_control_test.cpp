// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Requests of clients to a running simulation other than driving: goals, teleporting, resetting,
// switching devices off, suspending dynamics.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <string>

#include "sim/core/error.h"
#include "sim/devices/builtin.h"
#include "sim/devices/laser.h"
#include "sim/devices/localization.h"
#include "sim/devices/teleport.h"
#include "sim/devices/waypoint.h"
#include "sim/simulation/simulation.h"

namespace sim {
namespace {

using testing::HasSubstr;

constexpr double kPi = std::numbers::pi;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

// A robot that faces along x at (1, 2) in a 4 x 4 m room, with a waypoint device and a teleport.
// `devices` are further settings, `more` further parts of the world, `arena` of the arena.
WorldDescription room(const std::string& devices = "", const std::string& more = "",
                      const std::string& arena = "") {
  return load_world_text(R"({"arena": {"size": [4, 4])" + arena + R"(}, "robots": [
      {"name": "r1", "pose": {"x": 1, "y": 2, "yaw_deg": 0},
       "devices": {"waypoint": {}, "teleport": {})" +
                         (devices.empty() ? "" : ", " + devices) + "}}" + more + "]}");
}

Simulation::DeviceId id_of(const Simulation& simulation, const std::string& device, int robot = 0) {
  return {robot, simulation.find_device(robot, device).value()};
}

std::optional<std::string> tell(Simulation& simulation, const std::string& device,
                                const Command& what, int robot = 0) {
  return simulation.apply(id_of(simulation, device, robot), what);
}

void command(Simulation& simulation, const std::string& device, const Command& what,
             int robot = 0) {
  const auto refusal = tell(simulation, device, what, robot);
  ASSERT_FALSE(refusal.has_value()) << *refusal;
}

// The reason why the command was refused; "" if it was accepted.
std::string refusal(Simulation& simulation, const std::string& device, const Command& what,
                    int robot = 0) {
  return tell(simulation, device, what, robot).value_or("");
}

void drive(Simulation& simulation, double v, double omega, int robot = 0) {
  command(simulation, "motion", TwistCommand{{.v_mps = v, .omega_radps = omega}}, robot);
}

void run(Simulation& simulation, int steps) {
  for (int i = 0; i < steps; ++i) simulation.step();
}

template <typename DeviceType>
const DeviceType& device(const Simulation& simulation, const std::string& name, int robot = 0) {
  return dynamic_cast<const DeviceType&>(
      simulation.device(robot, simulation.find_device(robot, name).value()));
}

const Waypoint& waypoint(const Simulation& simulation, const std::string& name = "waypoint") {
  return device<Waypoint>(simulation, name);
}

const PoseReading& pose_reading(const Simulation& simulation, const std::string& name,
                                int robot = 0) {
  return dynamic_cast<const PoseReading&>(device<Sensor>(simulation, name, robot).reading());
}

// Steps until the waypoint is no longer in transit.
int steps_until_over(Simulation& simulation, int limit) {
  for (int i = 1; i <= limit; ++i) {
    simulation.step();
    if (waypoint(simulation).status() != WaypointStatus::kTransit) return i;
  }
  return limit + 1;
}

// --- Waypoint
// ----------------------------------------------------------------------------------

TEST(WaypointTwist, TurnsDrivesAndSlowsDown) {
  const WaypointParams params;  // gains 4 and 2 a second, at most 2 rad/s
  const auto twist = [&](double x, double y) {
    return waypoint_twist({0.0, 0.0, 0.0}, {{x, y}, 0.1, 0.4}, params);
  };
  EXPECT_EQ(twist(1.0, 0.0), (Twist{0.4, 0.0, 0.0}));
  EXPECT_DOUBLE_EQ(twist(0.1, 0.0).v_mps, 0.2);  // 2 / s * 0.1 m
  EXPECT_EQ(twist(0.0, 0.0), Twist{});

  const Twist left = twist(std::cos(0.1), std::sin(0.1));
  EXPECT_NEAR(left.omega_radps, 0.4, 1e-12);
  EXPECT_NEAR(left.v_mps, 0.4 * std::cos(0.1), 1e-12);
  EXPECT_NEAR(twist(std::cos(0.1), -std::sin(0.1)).omega_radps, -0.4, 1e-12);

  EXPECT_NEAR(twist(0.0, 1.0).v_mps, 0.0, 1e-12);  // a goal at its side: turns on the spot
  EXPECT_EQ(twist(0.0, 1.0).omega_radps, 2.0);     // 4 pi / 2, limited
  EXPECT_EQ(twist(-1.0, 0.0), (Twist{0.0, 2.0, 0.0}));
  EXPECT_EQ(twist(-1.0, -1e-3).omega_radps, -2.0);  // the shorter turn
}

TEST(WaypointTwist, RobotHeading_Used) {
  // At (1, 1) facing along y, the goal is 0.5 m straight ahead.
  const Twist twist = waypoint_twist({1.0, 1.0, 0.5 * kPi}, {{1.0, 1.5}, 0.1, 0.3}, {});
  EXPECT_DOUBLE_EQ(twist.v_mps, 0.3);
  EXPECT_NEAR(twist.omega_radps, 0.0, 1e-12);
}

TEST(Waypoint, GoalAhead_ReachedInExpectedTime) {
  Simulation simulation(room());
  EXPECT_EQ(waypoint(simulation).status(), WaypointStatus::kArrived);
  EXPECT_EQ(waypoint(simulation).goal_number(), 0U);
  command(simulation, "waypoint", GotoCommand{{2.5, 2.0}, 0.1, 0.4});
  EXPECT_EQ(waypoint(simulation).status(), WaypointStatus::kTransit);
  EXPECT_EQ(waypoint(simulation).goal_number(), 1U);
  EXPECT_EQ(waypoint(simulation).goal(), Vec2(2.5, 2.0));
  // 1.3 m at 0.4 m/s until 0.2 m are left: 325 steps. Then each step reduces the distance by 2 / s
  // * 0.01 s = 2 %: 0.98^34 = 0.503, 0.98^35 = 0.493, so half of it takes 35 steps.
  EXPECT_NEAR(steps_until_over(simulation, 1000), 360, 1);
  EXPECT_EQ(waypoint(simulation).status(), WaypointStatus::kArrived);
  EXPECT_LE(waypoint(simulation).distance_m(), 0.1);
  EXPECT_GT(waypoint(simulation).distance_m(), 0.095);

  const Pose there = simulation.body(0).X_WB;  // it stands
  run(simulation, 50);
  EXPECT_EQ(simulation.body(0).X_WB, there);
  EXPECT_EQ(simulation.body(0).twist, Twist{});
}

TEST(Waypoint, GoalsOnAllSides_ReachedWithinTolerance) {
  for (const double angle : {0.7, 0.5 * kPi, 2.5, kPi, -2.0, -0.5 * kPi, -0.3}) {
    Simulation simulation(room());
    command(simulation, "teleport", PlaceCommand{{2.0, 2.0, 0.4}});
    const Vec2 goal = Vec2(2.0, 2.0) + 1.2 * Vec2(std::cos(angle), std::sin(angle));
    command(simulation, "waypoint", GotoCommand{goal, 0.02, 1.0});
    // At most half a turn at 2 rad/s, 1.0 m at 0.5 m/s, then from 0.25 m to 0.02 m at 2 / s in
    // ln(12.5) / 2 s: 1.6 + 2 + 1.3 s, plus half of that for curves.
    EXPECT_LT(steps_until_over(simulation, 1000), 730) << angle;
    EXPECT_EQ(waypoint(simulation).status(), WaypointStatus::kArrived) << angle;
    EXPECT_LE((simulation.body(0).X_WB.position() - goal).norm(), 0.02) << angle;
  }
}

TEST(Waypoint, Motors_LimitSpeed) {
  Simulation simulation(room(R"("motion": {"max_speed": 0.2})"));
  command(simulation, "waypoint", GotoCommand{{3.0, 2.0}});  // requests 1 m/s
  run(simulation, 10);
  EXPECT_DOUBLE_EQ(simulation.body(0).twist.v_mps, 0.2);
}

TEST(Waypoint, NearGoal_ReachedAtOnce) {
  Simulation simulation(room());
  drive(simulation, 0.3, 0.0);
  command(simulation, "waypoint", GotoCommand{{1.2, 2.0}, 0.5, 1.0});
  simulation.step();
  EXPECT_EQ(waypoint(simulation).status(), WaypointStatus::kArrived);
  EXPECT_EQ(waypoint(simulation).goal_number(), 1U);
  // the goal has replaced the command, too
  EXPECT_EQ(simulation.body(0).X_WB, (Pose{1.0, 2.0, 0.0}));
}

TEST(Waypoint, StopAndResume_Work) {
  Simulation simulation(room());
  command(simulation, "waypoint", GotoCommand{{2.5, 2.0}, 0.1, 0.4});
  run(simulation, 100);
  command(simulation, "waypoint", StopCommand{});
  EXPECT_EQ(waypoint(simulation).status(), WaypointStatus::kStop);
  run(simulation, 100);
  EXPECT_NEAR(simulation.body(0).X_WB.x_m, 1.4, 1e-9);  // 1 s at 0.4 m/s
  EXPECT_EQ(waypoint(simulation).goal(), Vec2(2.5, 2.0));
  EXPECT_EQ(waypoint(simulation).goal_number(), 1U);

  command(simulation, "waypoint", ResumeCommand{});
  EXPECT_EQ(waypoint(simulation).status(), WaypointStatus::kTransit);
  EXPECT_NEAR(steps_until_over(simulation, 1000), 260, 1);
  EXPECT_EQ(waypoint(simulation).status(), WaypointStatus::kArrived);
  EXPECT_EQ(waypoint(simulation).goal_number(), 1U);
}

TEST(Waypoint, LaterCommand_ReplacesEarlier) {
  Simulation simulation(room());
  command(simulation, "waypoint", GotoCommand{{3.0, 2.0}, 0.1, 0.4});
  run(simulation, 50);
  drive(simulation, -0.1, 0.5);
  EXPECT_EQ(waypoint(simulation).status(), WaypointStatus::kStop);
  run(simulation, 10);
  EXPECT_EQ(simulation.body(0).twist.v_mps, -0.1);
  EXPECT_EQ(simulation.body(0).twist.omega_radps, 0.5);

  command(simulation, "waypoint", ResumeCommand{});
  run(simulation, 10);
  EXPECT_GT(simulation.body(0).twist.v_mps, 0.3);
  drive(simulation, 0.0, 1.0);
  run(simulation, 1);
  command(simulation, "waypoint", GotoCommand{{1.0, 3.0}, 0.1, 0.4});
  EXPECT_EQ(waypoint(simulation).goal_number(), 2U);
  run(simulation, 1);
  EXPECT_EQ(simulation.body(0).twist.omega_radps, 2.0);
}

TEST(Waypoint, TwoDevices_LaterCommandSteers) {
  Simulation simulation(room(R"("other": {"type": "waypoint"})"));
  command(simulation, "waypoint", GotoCommand{{3.0, 2.0}, 0.1, 0.4});
  command(simulation, "other", GotoCommand{{2.0, 2.0}, 0.1, 0.2});
  EXPECT_EQ(waypoint(simulation).status(), WaypointStatus::kStop);
  EXPECT_EQ(waypoint(simulation, "other").status(), WaypointStatus::kTransit);
  run(simulation, 10);
  EXPECT_DOUBLE_EQ(simulation.body(0).twist.v_mps, 0.2);
}

TEST(Waypoint, MotorsOff_Waits) {
  Simulation simulation(room());
  command(simulation, "waypoint", GotoCommand{{3.0, 2.0}, 0.1, 0.4});
  command(simulation, "motion", MotorEnableCommand{false});
  drive(simulation, 0.3, 0.0);  // ignored, so the waypoint keeps control
  run(simulation, 10);
  EXPECT_EQ(simulation.body(0).X_WB.x_m, 1.0);
  EXPECT_EQ(waypoint(simulation).status(), WaypointStatus::kTransit);
  command(simulation, "motion", MotorEnableCommand{true});
  run(simulation, 10);
  EXPECT_NEAR(simulation.body(0).X_WB.x_m, 1.04, 1e-9);
}

TEST(Waypoint, Wall_StaysInTransit) {
  Simulation simulation(room());
  command(simulation, "waypoint", GotoCommand{{5.0, 2.0}, 0.1, 0.5});
  run(simulation, 1000);
  EXPECT_EQ(waypoint(simulation).status(), WaypointStatus::kTransit);
  EXPECT_TRUE(simulation.body(0).stalled);
}

TEST(Waypoint, InvalidCommands_Refused) {
  Simulation simulation(room());
  const auto why = [&](const Command& what) { return refusal(simulation, "waypoint", what); };
  EXPECT_THAT(why(GotoCommand{{kNan, 0.0}}), HasSubstr("finite"));
  EXPECT_THAT(why(GotoCommand{{0.0, kInfinity}}), HasSubstr("finite"));
  EXPECT_THAT(why(GotoCommand{{1.0, 1.0}, 0.0}), HasSubstr("tolerance"));
  EXPECT_THAT(why(GotoCommand{{1.0, 1.0}, kNan}), HasSubstr("tolerance"));
  EXPECT_THAT(why(GotoCommand{{1.0, 1.0}, kInfinity}), HasSubstr("tolerance"));
  EXPECT_THAT(why(GotoCommand{{1.0, 1.0}, 0.5, -1.0}), HasSubstr("speed"));
  EXPECT_THAT(why(GotoCommand{{1.0, 1.0}, 0.5, 0.0}), HasSubstr("speed"));
  EXPECT_THAT(why(GotoCommand{{1.0, 1.0}, 0.5, kNan}), HasSubstr("speed"));
  EXPECT_THAT(why(ResumeCommand{}), HasSubstr("none was given"));
  EXPECT_THAT(why(TwistCommand{}), HasSubstr("takes no such command"));
  EXPECT_EQ(waypoint(simulation).goal_number(), 0U);
  EXPECT_EQ(waypoint(simulation).status(), WaypointStatus::kArrived);

  Simulation unmoved(room(R"("motion": null)"));
  EXPECT_THAT(refusal(unmoved, "waypoint", GotoCommand{{1.0, 1.0}}), HasSubstr("no motors"));
  run(unmoved, 10);
}

TEST(Waypoint, Readings_ReportProgress) {
  Simulation simulation(room(R"("slow": {"type": "waypoint", "frequency": 5})"));
  run(simulation, 10);
  const WaypointReading& reading = waypoint(simulation).reading();
  EXPECT_EQ(reading.sequence, 1U);
  EXPECT_EQ(reading.status, WaypointStatus::kArrived);
  EXPECT_EQ(reading.goal_m, Vec2(1.0, 2.0));
  EXPECT_EQ(reading.distance_m, 0.0);
  command(simulation, "waypoint", GotoCommand{{3.0, 2.0}, 0.1, 0.4});
  run(simulation, 10);
  EXPECT_EQ(reading.sequence, 2U);
  EXPECT_EQ(reading.status, WaypointStatus::kTransit);
  EXPECT_EQ(reading.goal_number, 1U);
  EXPECT_EQ(reading.goal_m, Vec2(3.0, 2.0));
  EXPECT_NEAR(reading.distance_m, 1.96, 1e-9);  // 0.1 s at 0.4 m/s from 2 m
  EXPECT_NEAR(reading.position_m.x(), 1.04, 1e-9);
  EXPECT_EQ(waypoint(simulation, "slow").reading().sequence, 1U);
  EXPECT_EQ(to_string(WaypointStatus::kArrived), "Arrived");
  EXPECT_EQ(to_string(WaypointStatus::kTransit), "Transit");
  EXPECT_EQ(to_string(WaypointStatus::kStop), "Stop");
}

// --- Teleport
// ----------------------------------------------------------------------------------

TEST(Teleport, RobotPlacedAtRest) {
  Simulation simulation(room(R"("laser": {"range_max": 9})"));
  drive(simulation, 0.4, 0.0);
  run(simulation, 50);  // to x = 1.2
  command(simulation, "teleport", PlaceCommand{{3.0, 1.0, 0.5 * kPi + 2.0 * kPi}});
  EXPECT_NEAR(simulation.body(0).X_WB.yaw_rad, 0.5 * kPi, 1e-12);
  EXPECT_EQ(simulation.body(0).twist, Twist{});
  run(simulation, 10);
  // It stands and has no twist. The localisation reports the new pose, the wheels have not moved.
  EXPECT_NEAR(pose_reading(simulation, "pose").pose.x_m, 3.0, 1e-12);
  EXPECT_NEAR(pose_reading(simulation, "pose").pose.y_m, 1.0, 1e-12);
  EXPECT_NEAR(pose_reading(simulation, "odometry").pose.x_m, 0.2, 1e-9);
  EXPECT_NEAR(simulation.statistics(0).path_length_m, 0.2, 1e-9);
  // The laser faces along y from 0.035 m ahead of the axle: 3 - 0.035 m to the upper border.
  const auto& scan = device<Laser>(simulation, "laser").reading();
  EXPECT_NEAR(scan.ranges_m[340], 2.965, 1e-4);

  drive(simulation, 0.4, 0.0);
  run(simulation, 50);
  EXPECT_NEAR(simulation.body(0).X_WB.y_m, 1.2, 1e-9);
  EXPECT_NEAR(simulation.statistics(0).path_length_m, 0.4, 1e-9);
}

TEST(Teleport, Translate_AlongWorldAxesAndRotateInPlace) {
  Simulation simulation(room());
  command(simulation, "teleport", RotateCommand{0.5 * kPi});
  command(simulation, "teleport", TranslateCommand{{0.5, -0.25}});
  EXPECT_NEAR(simulation.body(0).X_WB.x_m, 1.5, 1e-12);
  EXPECT_NEAR(simulation.body(0).X_WB.y_m, 1.75, 1e-12);
  EXPECT_NEAR(simulation.body(0).X_WB.yaw_rad, 0.5 * kPi, 1e-12);
  command(simulation, "teleport", RotateCommand{kPi});
  EXPECT_NEAR(simulation.body(0).X_WB.yaw_rad, -0.5 * kPi, 1e-12);
  EXPECT_NEAR(simulation.body(0).X_WB.x_m, 1.5, 1e-12);
}

TEST(Teleport, Transit_EndedAndOdometryCanBeSet) {
  Simulation simulation(room());
  command(simulation, "waypoint", GotoCommand{{3.0, 2.0}});
  run(simulation, 10);
  command(simulation, "teleport", PlaceCommand{{2.0, 1.0, 0.0}});
  EXPECT_EQ(waypoint(simulation).status(), WaypointStatus::kStop);
  command(simulation, "pose", SetPoseCommand{{0.0, 0.0, 0.0}});
  run(simulation, 10);
  EXPECT_NEAR(pose_reading(simulation, "pose").pose.x_m, 0.0, 1e-12);
  EXPECT_NEAR(pose_reading(simulation, "pose").pose.y_m, 0.0, 1e-12);
  EXPECT_EQ(simulation.body(0).X_WB, (Pose{2.0, 1.0, 0.0}));
}

TEST(Teleport, OccupiedPlace_RefusedWithName) {
  Simulation simulation(room("", R"(, {"name": "r2", "pose": {"x": 3, "y": 3}})",
                             R"(, "obstacles": [
                                 {"name": "block", "center": [2, 1], "size": [0.2, 0.2]},
                                 {"name": "gate", "type": "dynamic", "center": [2, 3],
                                  "size": [0.2, 0.2], "state": "retracted"}],
                               "dock_separators": [
                                 {"name": "fin", "center": [0.1, 1], "size": [0.2, 0.02]}])"));
  const auto why = [&](double x, double y) {
    return refusal(simulation, "teleport", PlaceCommand{{x, y, 0.0}});
  };
  drive(simulation, 0.1, 0.0);
  EXPECT_THAT(why(2.15, 1.0), HasSubstr("obstacle block stands there, at (2.00, 1.00)"));
  EXPECT_THAT(why(0.1, 1.05), HasSubstr("separator fin"));
  EXPECT_THAT(why(3.1, 3.1), HasSubstr("robot r2 stands there, at (3.00, 3.00)"));
  EXPECT_THAT(why(-5.0, 1.0), HasSubstr("beyond the left side of the floor"));
  EXPECT_THAT(why(2.0, 3.95), HasSubstr("beyond the top side"));
  EXPECT_THAT(why(1e300, 1.0), HasSubstr("beyond the right side"));
  EXPECT_THAT(why(kNan, 1.0), HasSubstr("finite"));
  EXPECT_THAT(refusal(simulation, "teleport", RotateCommand{kInfinity}), HasSubstr("finite"));
  EXPECT_THAT(refusal(simulation, "teleport", TranslateCommand{{1e308, 1e308}}),
              HasSubstr("beyond"));
  EXPECT_THAT(refusal(simulation, "teleport", TwistCommand{}), HasSubstr("no such command"));
  EXPECT_EQ(simulation.body(0).X_WB, (Pose{1.0, 2.0, 0.0}));
  run(simulation, 10);  // the refused request does not stop it
  EXPECT_NEAR(simulation.body(0).X_WB.x_m, 1.01, 1e-9);

  EXPECT_EQ(why(2.0, 3.0), "");  // retracted: free
  EXPECT_THAT(simulation.set_obstacle_state("gate", ObstacleState::kExtended).value_or(""),
              HasSubstr("a robot stands on it"));
  EXPECT_EQ(why(2.0, 3.0), "");  // it may be placed at its own place
  EXPECT_EQ(why(1.0, 2.0), "");
  ASSERT_FALSE(simulation.set_obstacle_state("gate", ObstacleState::kExtended));
  EXPECT_THAT(why(2.0, 3.0), HasSubstr("obstacle gate"));
}

TEST(Teleport, MapWall_Refused) {
  WorldDescription world = room();
  world.arena.walls.push_back({{{2.0, 1.0}, {3.0, 1.0}, {3.0, 3.0}, {2.0, 3.0}}});
  Simulation simulation(world);
  EXPECT_THAT(refusal(simulation, "teleport", PlaceCommand{{2.0, 2.0, 0.0}}),
              HasSubstr("a wall of the map stands there"));
  EXPECT_THAT(refusal(simulation, "teleport", PlaceCommand{{2.5, 2.0, 0.0}}),
              HasSubstr("a wall of the map stands there"));
}

TEST(Teleport, Trail_HasGap) {
  Simulation simulation(room(R"("pen": {"trail": true, "colour": "#ff0000"})"));
  run(simulation, 1);
  command(simulation, "teleport", PlaceCommand{{3.0, 2.0, 0.0}});
  run(simulation, 1);
  drive(simulation, 0.5, 0.0);
  run(simulation, 50);  // 0.25 m farther
  const Canvas& canvas = simulation.canvas();
  const auto alpha = [&](double x_m) {
    return canvas.pixel(canvas.column(x_m), canvas.row(2.0)).value().a;
  };
  EXPECT_EQ(alpha(1.0), 255);
  EXPECT_EQ(alpha(3.0), 255);
  EXPECT_EQ(alpha(3.2), 255);
  for (double x_m = 1.1; x_m < 2.9; x_m += 0.1) EXPECT_EQ(alpha(x_m), 0) << x_m;
}

TEST(Teleport, Contacts_FoundAnew) {
  Simulation simulation(
      room("", "", R"(, "obstacles": [{"name": "block", "center": [2, 2], "size": [0.4, 0.4]}])"));
  drive(simulation, 0.5, 0.0);
  run(simulation, 300);  // 0.713 m to the block's face
  EXPECT_EQ(simulation.statistics(0).collisions, 1);
  command(simulation, "teleport", PlaceCommand{{1.0, 3.0, 0.0}});
  drive(simulation, 0.5, 0.0);
  run(simulation, 100);
  EXPECT_NEAR(simulation.body(0).X_WB.x_m, 1.5, 1e-9);  // nothing stops it there
  command(simulation, "teleport", PlaceCommand{{1.5, 2.0, 0.0}});
  drive(simulation, 0.5, 0.0);
  run(simulation, 100);
  EXPECT_EQ(simulation.statistics(0).collisions, 2);
  // The face is at 1.8 m, half the robot's length is 0.087 m, and the gap at rest is 1.5 mm.
  EXPECT_NEAR(simulation.body(0).X_WB.x_m, 1.713, 0.003);
}

// --- Odometry since the last reading
// -----------------------------------------------------------

TEST(OdometryIncrement, ArcSinceLastReading) {
  Simulation simulation(room());
  drive(simulation, 0.2, 0.5);
  run(simulation, 10);
  const PoseReading& odometry = pose_reading(simulation, "odometry");
  // 0.1 s: 0.02 m of a circle of 0.4 m radius, 0.05 rad.
  EXPECT_NEAR(odometry.path_length_m, 0.02, 1e-12);
  EXPECT_NEAR(odometry.increment.x_m, 0.4 * std::sin(0.05), 1e-12);
  EXPECT_NEAR(odometry.increment.y_m, 0.4 * (1.0 - std::cos(0.05)), 1e-12);
  EXPECT_NEAR(odometry.increment.yaw_rad, 0.05, 1e-12);
  Pose sum = odometry.increment;
  for (int i = 0; i < 20; ++i) {
    run(simulation, 10);
    EXPECT_NEAR(odometry.increment.x_m, 0.4 * std::sin(0.05), 1e-12);
    sum = sum * odometry.increment;
  }
  EXPECT_NEAR(sum.x_m, odometry.pose.x_m, 1e-12);
  EXPECT_NEAR(sum.y_m, odometry.pose.y_m, 1e-12);
  EXPECT_NEAR(sum.yaw_rad, odometry.pose.yaw_rad, 1e-12);
  drive(simulation, 0.0, 0.0);
  run(simulation, 20);
  EXPECT_EQ(odometry.increment, Pose{});
  EXPECT_EQ(odometry.path_length_m, 0.0);
}

TEST(OdometryIncrement, BackAndForth_CountsWholePath) {
  Simulation simulation(room());
  drive(simulation, 0.2, 0.0);
  run(simulation, 5);
  drive(simulation, -0.2, 0.0);
  run(simulation, 5);
  const PoseReading& odometry = pose_reading(simulation, "odometry");
  EXPECT_NEAR(odometry.path_length_m, 0.02, 1e-12);
  EXPECT_NEAR(odometry.increment.x_m, 0.0, 1e-12);
}

TEST(OdometryIncrement, FrameOfLastReading_WithShiftInStartFrame) {
  Simulation simulation(room());
  const double quarter = 0.5 * kPi;
  drive(simulation, 0.0, quarter);  // a quarter turn in a second
  run(simulation, 100);
  drive(simulation, 0.2, 0.0);
  run(simulation, 10);
  const PoseReading& odometry = pose_reading(simulation, "odometry");
  EXPECT_NEAR(odometry.increment.x_m, 0.02, 1e-12);
  EXPECT_NEAR(odometry.increment.y_m, 0.0, 1e-12);
  EXPECT_NEAR(odometry.shift_m().x(), 0.0, 1e-12);
  EXPECT_NEAR(odometry.shift_m().y(), 0.02, 1e-12);

  // Setting the pose meanwhile does not count as motion.
  run(simulation, 5);
  command(simulation, "odometry", SetPoseCommand{{7.0, 8.0, 0.0}});
  run(simulation, 5);
  EXPECT_NEAR(odometry.pose.x_m, 7.01, 1e-12);
  EXPECT_NEAR(odometry.increment.x_m, 0.02, 1e-12);
  EXPECT_NEAR(odometry.shift_m().x(), 0.02, 1e-12);
  EXPECT_NEAR(odometry.path_length_m, 0.02, 1e-12);
}

TEST(OdometryLevel, ReadAndReportedToClients) {
  const auto level = [](const std::string& settings) {
    const WorldDescription world = room("\"odometry\": {" + settings + "}");
    for (const DeviceDescription& d : world.robots.at(0).devices) {
      if (d.type != "odometry") continue;
      for (const DeviceKind& kind : device_kinds()) {
        if (kind.name == d.type) return kind.properties(d.params).at("level");
      }
    }
    return -1.0;
  };
  EXPECT_EQ(level(""), 0.0);
  EXPECT_EQ(level(R"("level": "integrated")"), 0.0);
  EXPECT_EQ(level(R"("level": "differential")"), 1.0);
  EXPECT_EQ(level(R"("level": "raw")"), 2.0);
  try {
    static_cast<void>(level(R"("level": "rw")"));
    FAIL() << "an unknown level was read";
  } catch (const ConfigError& error) {
    ASSERT_EQ(error.issues().size(), 1U);
    EXPECT_EQ(error.issues()[0].id, "world/unknown-value");
    EXPECT_EQ(error.issues()[0].pointer, "/robots/0/devices/odometry/level");
    EXPECT_THAT(error.issues()[0].hint, HasSubstr("raw"));
  }
}

// --- Reset
// -------------------------------------------------------------------------------------

// Two robots with noisy sensors, one of them leaving a trail, and a gate.
WorldDescription busy_room() {
  return room(R"("laser": {"noise": 0.02}, "pose": {"noise": 0.01, "noise_yaw_deg": 1},
                 "odometry": {"noise": 0.02}, "pen": {"trail": true})",
              R"(, {"name": "r2", "pose": {"x": 3, "y": 2, "yaw_deg": 180},
                    "devices": {"odometry": {"noise": 0.02}}})",
              R"(, "obstacles": [{"name": "gate", "type": "dynamic", "center": [2, 3.5],
                                  "size": [0.2, 0.2], "state": "extended"}])");
}

// The commands to both simulations at a step, counted from their (new) start.
void act_at(Simulation& simulation, int step) {
  if (step == 0) command(simulation, "waypoint", GotoCommand{{2.5, 2.4}, 0.05, 0.5});
  if (step == 0) drive(simulation, 0.5, 0.1, 1);  // they collide
  if (step == 150) drive(simulation, 0.3, 0.7, 1);
  if (step == 300) drive(simulation, -0.2, 0.4, 0);
  if (step == 400) {
    EXPECT_EQ(simulation.set_obstacle_state("gate", ObstacleState::kRetracted), std::nullopt);
  }
}

void expect_same_reading(const PoseReading& a, const PoseReading& b) {
  EXPECT_EQ(a.pose, b.pose);
  EXPECT_EQ(a.increment, b.increment);
  EXPECT_EQ(a.path_length_m, b.path_length_m);
}

TEST(Reset, SameFutureAsNewSimulation) {
  Simulation fresh(busy_room());
  Simulation used(busy_room());
  // 237 steps: not a multiple of any sensor's period.
  drive(used, 0.4, 0.3, 0);
  drive(used, 0.5, 0.0, 1);
  ASSERT_FALSE(used.set_obstacle_state("gate", ObstacleState::kRetracted));
  for (int i = 0; i < 237; ++i) {
    if (i == 100) command(used, "teleport", PlaceCommand{{2.0, 3.5, 1.0}});
    if (i == 150) command(used, "odometry", SetPoseCommand{{5.0, 5.0, 1.0}});
    if (i == 160) command(used, "pose", SetPoseCommand{{5.0, 5.0, 1.0}});
    used.step();
  }
  used.set_active(id_of(used, "laser"), false);
  ASSERT_FALSE(used.set_robot_dynamics(1, false));
  used.reset();

  EXPECT_EQ(used.body(0).X_WB, fresh.body(0).X_WB);
  EXPECT_EQ(used.world().arena.obstacles[0].state, ObstacleState::kExtended);
  EXPECT_TRUE(used.active(id_of(used, "laser")));
  EXPECT_TRUE(used.robot_dynamics(1));
  for (int i = 0; i < 600; ++i) {
    act_at(fresh, i);
    act_at(used, i);
    fresh.step();
    used.step();
    for (int robot = 0; robot < 2; ++robot) {
      ASSERT_EQ(used.body(robot).X_WB, fresh.body(robot).X_WB) << "step " << i;
      ASSERT_EQ(used.body(robot).twist, fresh.body(robot).twist) << "step " << i;
    }
    ASSERT_EQ(used.updated(), fresh.updated()) << "step " << i;
  }
  for (int robot = 0; robot < 2; ++robot) {
    expect_same_reading(pose_reading(used, "odometry", robot),
                        pose_reading(fresh, "odometry", robot));
    expect_same_reading(pose_reading(used, "pose", robot), pose_reading(fresh, "pose", robot));
  }
  EXPECT_EQ(device<Laser>(used, "laser").reading().ranges_m,
            device<Laser>(fresh, "laser").reading().ranges_m);
  EXPECT_EQ(used.canvas().data(), fresh.canvas().data());
  EXPECT_EQ(waypoint(used).status(), waypoint(fresh).status());
}

TEST(Reset, ClockSequencesAndStatistics_Continue) {
  Simulation simulation(busy_room());
  const LayerId layer = simulation.layers().add(LayerKind::kColour, {"plan"}, 1);
  drive(simulation, 0.4, 0.0);
  run(simulation, 105);
  const RobotStatistics before = simulation.statistics(0);
  EXPECT_NEAR(before.path_length_m, 0.42, 1e-9);
  simulation.reset();
  EXPECT_EQ(simulation.now_ns(), 1'050'000'000);
  EXPECT_EQ(simulation.steps(), 105U);
  EXPECT_TRUE(simulation.updated().empty());
  EXPECT_TRUE(simulation.layers().contains(layer));
  EXPECT_EQ(pose_reading(simulation, "pose").sequence, 0U);  // none since the reset
  run(simulation, 9);
  EXPECT_TRUE(simulation.updated().empty());
  run(simulation, 1);
  EXPECT_EQ(pose_reading(simulation, "pose").sequence, 11U);  // 10 were made before
  EXPECT_EQ(pose_reading(simulation, "pose").time_ns, 1'150'000'000);
  // Nothing drives, and returning to the start does not count as path.
  EXPECT_EQ(simulation.statistics(0).path_length_m, before.path_length_m);
  EXPECT_EQ(simulation.statistics(0).least_clearance_m, before.least_clearance_m);
  EXPECT_EQ(simulation.statistics(0).collisions, 0);
}

TEST(Reset, Canvas_ClearedExceptFirstMarkOfTrail) {
  Simulation simulation(busy_room());
  const std::vector<std::uint8_t> at_start = simulation.canvas().data();
  drive(simulation, 0.4, 0.0);
  run(simulation, 100);
  simulation.canvas().draw_line(0, 0, 50, 50, {1, 2, 3, 255});
  EXPECT_NE(simulation.canvas().data(), at_start);
  simulation.reset();
  EXPECT_EQ(simulation.canvas().data(), at_start);
  simulation.layers().resize(50, 60);  // clients chose this size for their layers
  simulation.reset();
  EXPECT_EQ(simulation.canvas().width(), 50);
}

TEST(Reset, Goals_CancelledVisibly) {
  Simulation simulation(room());
  command(simulation, "waypoint", GotoCommand{{3.0, 2.0}});
  run(simulation, 10);
  simulation.reset();
  EXPECT_EQ(waypoint(simulation).status(), WaypointStatus::kArrived);
  EXPECT_EQ(waypoint(simulation).goal_number(), 2U);
  EXPECT_EQ(waypoint(simulation).goal(), Vec2(1.0, 2.0));
  simulation.reset();  // no reading is left
  EXPECT_EQ(waypoint(simulation).goal_number(), 2U);
  command(simulation, "waypoint", GotoCommand{{3.0, 2.0}});
  EXPECT_EQ(waypoint(simulation).goal_number(), 3U);
}

TEST(Reset, BeforeFirstStep_ChangesNothing) {
  Simulation fresh(busy_room());
  Simulation reset(busy_room());
  reset.reset();
  EXPECT_EQ(reset.state_hash(), fresh.state_hash());
  run(fresh, 20);
  run(reset, 20);
  EXPECT_EQ(reset.state_hash(), fresh.state_hash());
}

// --- Switching devices off
// ---------------------------------------------------------------------

TEST(SetActive, InactiveSensor_KeepsSchedule) {
  Simulation simulation(room());
  const auto pose = id_of(simulation, "pose");
  run(simulation, 15);
  simulation.set_active(pose, false);
  EXPECT_FALSE(simulation.active(pose));
  run(simulation, 50);
  EXPECT_EQ(pose_reading(simulation, "pose").sequence, 1U);
  EXPECT_EQ(pose_reading(simulation, "odometry").sequence, 6U);
  simulation.set_active(pose, true);
  run(simulation, 4);
  EXPECT_EQ(pose_reading(simulation, "pose").sequence, 1U);
  run(simulation, 1);  // 0.7 s
  EXPECT_EQ(pose_reading(simulation, "pose").sequence, 2U);
  EXPECT_EQ(pose_reading(simulation, "pose").time_ns, 700'000'000);
}

TEST(SetActive, InactiveActuator_StopsAndRefusesCommands) {
  Simulation simulation(room());
  const auto motion = id_of(simulation, "motion");
  drive(simulation, 0.4, 0.0);
  run(simulation, 10);
  simulation.set_active(motion, false);
  EXPECT_EQ(refusal(simulation, "motion", TwistCommand{{.v_mps = 0.4}}),
            "device r1.motion is switched off: it takes no commands until it is on again");
  run(simulation, 10);
  EXPECT_NEAR(simulation.body(0).X_WB.x_m, 1.04, 1e-9);
  simulation.set_active(motion, true);
  run(simulation, 10);  // it stands until the next command
  EXPECT_NEAR(simulation.body(0).X_WB.x_m, 1.04, 1e-9);
  drive(simulation, 0.4, 0.0);
  run(simulation, 10);
  EXPECT_NEAR(simulation.body(0).X_WB.x_m, 1.08, 1e-9);

  simulation.set_active(id_of(simulation, "teleport"), false);
  EXPECT_THAT(refusal(simulation, "teleport", RotateCommand{1.0}), HasSubstr("switched off"));
}

TEST(SetActive, InactiveWaypoint_StopsAndKeepsGoal) {
  Simulation simulation(room());
  const auto id = id_of(simulation, "waypoint");
  command(simulation, "waypoint", GotoCommand{{3.0, 2.0}, 0.1, 0.4});
  run(simulation, 10);
  simulation.set_active(id, false);
  EXPECT_EQ(waypoint(simulation).status(), WaypointStatus::kStop);
  run(simulation, 10);
  EXPECT_NEAR(simulation.body(0).X_WB.x_m, 1.04, 1e-9);
  EXPECT_THAT(refusal(simulation, "waypoint", ResumeCommand{}), HasSubstr("switched off"));
  simulation.set_active(id, true);
  command(simulation, "waypoint", ResumeCommand{});
  run(simulation, 10);
  EXPECT_NEAR(simulation.body(0).X_WB.x_m, 1.08, 1e-9);
}

// As in programs for MORSE, where motion and waypoint would both control the robot.
TEST(SetActive, InactiveMotion_WaypointStillDrives) {
  Simulation simulation(room());
  simulation.set_active(id_of(simulation, "motion"), false);
  command(simulation, "waypoint", GotoCommand{{3.0, 2.0}, 0.1, 0.4});
  run(simulation, 10);
  EXPECT_NEAR(simulation.body(0).X_WB.x_m, 1.04, 1e-9);
}

TEST(SetActive, InactivePen_LeavesNoTrail) {
  Simulation simulation(room(R"("pen": {"trail": true})"));
  const auto pen = id_of(simulation, "pen");
  simulation.set_active(pen, false);
  drive(simulation, 0.5, 0.0);
  run(simulation, 100);  // to x = 1.5
  simulation.set_active(pen, true);
  run(simulation, 100);  // to x = 2
  const Canvas& canvas = simulation.canvas();
  const int row = canvas.row(2.0);
  EXPECT_EQ(canvas.pixel(canvas.column(1.25), row).value().a, 0);
  EXPECT_EQ(canvas.pixel(canvas.column(1.75), row).value().a, 255);
}

TEST(SetActive, StateHash_Included) {
  Simulation simulation(room());
  const std::uint64_t on = simulation.state_hash();
  simulation.set_active(id_of(simulation, "pose"), false);
  const std::uint64_t without_pose = simulation.state_hash();
  EXPECT_NE(without_pose, on);
  simulation.set_active(id_of(simulation, "pose"), true);
  EXPECT_EQ(simulation.state_hash(), on);
  simulation.set_active(id_of(simulation, "teleport"), false);
  EXPECT_NE(simulation.state_hash(), on);
  EXPECT_NE(simulation.state_hash(), without_pose);
}

// --- Suspending dynamics
// -----------------------------------------------------------------------

TEST(Dynamics, SuspendedWorld_StandsWhileTimeAdvances) {
  Simulation simulation(busy_room());
  drive(simulation, 0.4, 0.0);
  run(simulation, 10);
  const std::uint64_t moving = simulation.state_hash();
  ASSERT_FALSE(simulation.set_dynamics(false));
  EXPECT_NE(simulation.state_hash(), moving);
  EXPECT_FALSE(simulation.robot_dynamics(0));
  drive(simulation, 0.3, 0.0, 1);
  run(simulation, 50);
  EXPECT_NEAR(simulation.body(0).X_WB.x_m, 1.04, 1e-9);
  EXPECT_EQ(simulation.body(1).X_WB.x_m, 3.0);
  EXPECT_EQ(simulation.body(0).twist, Twist{});
  EXPECT_FALSE(simulation.body(0).stalled);
  EXPECT_EQ(pose_reading(simulation, "odometry").sequence, 6U);
  ASSERT_FALSE(simulation.set_dynamics(true));
  run(simulation, 10);  // both continue with their commands
  EXPECT_NEAR(simulation.body(0).X_WB.x_m, 1.08, 1e-9);
  EXPECT_NEAR(simulation.body(1).X_WB.x_m, 2.97, 1e-9);
}

TEST(Dynamics, SuspendedRobot_IsObstacle) {
  Simulation simulation(busy_room());
  ASSERT_FALSE(simulation.set_robot_dynamics(1, false));
  drive(simulation, 0.5, 0.0);
  run(simulation, 600);
  EXPECT_EQ(simulation.body(1).X_WB, (Pose{3.0, 2.0, kPi}));
  // Their fronts are 0.087 m ahead of their axles; 1.5 mm remain between the bodies.
  EXPECT_NEAR(simulation.body(0).X_WB.x_m, 3.0 - 2 * 0.087, 0.003);
  EXPECT_TRUE(simulation.body(0).stalled);
  EXPECT_EQ(simulation.statistics(1).collisions, 1);
  // With dynamics restored it can be pushed again, and the contact is the same.
  ASSERT_FALSE(simulation.set_robot_dynamics(1, true));
  run(simulation, 100);
  EXPECT_GT(simulation.body(1).X_WB.x_m, 3.05);
  EXPECT_EQ(simulation.statistics(1).collisions, 1);
}

TEST(Dynamics, SuspendedRobot_KeepsGoalAndCanBePlaced) {
  Simulation simulation(room());
  command(simulation, "waypoint", GotoCommand{{3.0, 2.0}, 0.1, 0.4});
  ASSERT_FALSE(simulation.set_object_dynamics("r1", false));
  run(simulation, 10);
  EXPECT_EQ(waypoint(simulation).status(), WaypointStatus::kTransit);
  EXPECT_EQ(simulation.body(0).X_WB.x_m, 1.0);
  ASSERT_FALSE(simulation.set_object_dynamics("r1", true));
  run(simulation, 10);
  EXPECT_NEAR(simulation.body(0).X_WB.x_m, 1.04, 1e-9);
  ASSERT_FALSE(simulation.set_object_dynamics("r1", false));
  command(simulation, "teleport", PlaceCommand{{2.0, 3.0, 0.0}});
  run(simulation, 10);
  EXPECT_EQ(simulation.body(0).X_WB, (Pose{2.0, 3.0, 0.0}));
}

TEST(Dynamics, MissingDynamics_Explained) {
  Simulation simulation(room("", "", R"(, "obstacles": [
      {"name": "block", "center": [2, 1], "size": [0.2, 0.2]},
      {"name": "gate", "type": "dynamic", "center": [2, 3], "size": [0.2, 0.2]}])"));
  EXPECT_THAT(simulation.set_object_dynamics("block", false).value_or(""),
              HasSubstr("block \"block\" has no dynamics"));
  EXPECT_THAT(simulation.set_object_dynamics("gate", false).value_or(""),
              HasSubstr("can be extended and retracted"));
  EXPECT_THAT(simulation.set_object_dynamics("border", false).value_or(""), HasSubstr("border"));
  EXPECT_THAT(simulation.set_object_dynamics("r7", false).value_or(""),
              HasSubstr("no robot or obstacle named \"r7\""));
  EXPECT_THAT(simulation.set_robot_dynamics(1, false).value_or(""), HasSubstr("number 1"));
  EXPECT_THAT(simulation.set_robot_dynamics(-1, false).value_or(""), HasSubstr("number -1"));
}

// --- The scene
// ---------------------------------------------------------------------------------

TEST(SceneObjects, AreAllSolids) {
  WorldDescription world = room("", "", R"(, "obstacles": [
      {"name": "block", "center": [2, 1], "size": [0.2, 0.4], "yaw_deg": 90},
      {"name": "gate", "type": "dynamic", "center": [2, 3], "size": [0.2, 0.2],
       "state": "retracted"}],
      "dock_separators": [{"name": "fin", "center": [0.1, 1], "size": [0.2, 0.02]}])");
  world.arena.walls.push_back({{{3.0, 3.0}, {3.5, 3.0}, {3.5, 3.2}, {3.0, 3.2}}});
  Simulation simulation(world);
  drive(simulation, 0.5, 0.0);
  run(simulation, 10);
  const std::vector<SceneObject> objects = simulation.scene_objects();
  ASSERT_EQ(objects.size(), 6U);
  EXPECT_EQ(objects[0].name, "r1");
  EXPECT_EQ(objects[0].kind, "robot");
  EXPECT_EQ(objects[0].pose, simulation.body(0).X_WB);
  EXPECT_NEAR(objects[0].size.x(), 0.174, 1e-12);
  EXPECT_NEAR(objects[0].size.y(), 0.162, 1e-12);
  EXPECT_TRUE(objects[0].dynamic);
  EXPECT_EQ(objects[1].name, "block");
  EXPECT_EQ(objects[1].kind, "block");
  EXPECT_NEAR(objects[1].pose.yaw_rad, 0.5 * kPi, 1e-12);
  EXPECT_EQ(objects[1].size, Vec2(0.2, 0.4));
  EXPECT_FALSE(objects[1].dynamic);
  EXPECT_TRUE(objects[1].extended);
  EXPECT_EQ(objects[2].name, "gate");
  EXPECT_TRUE(objects[2].dynamic);
  EXPECT_FALSE(objects[2].extended);
  EXPECT_EQ(objects[3].name, "fin");
  EXPECT_EQ(objects[3].kind, "separator");
  EXPECT_EQ(objects[4].kind, "border");
  EXPECT_EQ(objects[4].pose, (Pose{2.0, 2.0, 0.0}));
  EXPECT_EQ(objects[4].size, Vec2(4.0, 4.0));
  EXPECT_EQ(objects[5].kind, "wall");
  EXPECT_NEAR(objects[5].pose.x_m, 3.25, 1e-12);
  EXPECT_NEAR(objects[5].size.y(), 0.2, 1e-12);
  EXPECT_EQ(Simulation(load_world_text(R"({"arena": {"size": [2, 2], "border": false}})"))
                .scene_objects()
                .size(),
            1U);  // the default robot
}

}  // namespace
}  // namespace sim
