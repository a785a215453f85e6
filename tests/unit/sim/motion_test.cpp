// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// The kinds of drive, and the motors' own heading and position control.
#include "sim/devices/motion.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <utility>

#include "physics/feasible_twist.h"
#include "sim/devices/localization.h"
#include "sim/simulation/simulation.h"

namespace sim {
namespace {

using testing::HasSubstr;
constexpr double kPi = std::numbers::pi;

/// A robot of 0.4 x 0.2 m in an empty room of 20 x 20 m, with limits that are never reached.
WorldDescription room(const DriveDescription& drive, const Pose& pose,
                      const MotionParams& motion = {}) {
  auto model = std::make_shared<RobotModel>();
  model->name = "test";
  model->footprint = {{-0.2, -0.1}, {0.2, -0.1}, {0.2, 0.1}, {-0.2, 0.1}};
  model->drive = drive;
  WorldDescription world;
  world.arena.size = {20.0, 20.0};
  world.models["test"] = std::move(model);
  RobotDescription robot;
  robot.name = "r1";
  robot.model = "test";
  robot.pose = pose;
  robot.port = 6665;
  MotionParams params = motion;
  params.max_speed_mps = 2.0;
  params.max_turn_rate_radps = 4.0;
  robot.devices = {{"motion", "motion", params},
                   {"odometry", "odometry", OdometryParams{}},
                   {"pose", "pose", PoseParams{}}};
  world.robots.push_back(std::move(robot));
  return world;
}

DriveDescription drive_of(DriveKind kind) {
  DriveDescription drive;
  drive.kind = kind;
  return drive;
}

constexpr int kMotionDevice = 0;
constexpr int kOdometryDevice = 1;
constexpr int kPoseDevice = 2;

void command(Simulation& simulation, const Command& what) {
  const auto refusal = simulation.apply({0, kMotionDevice}, what);
  ASSERT_FALSE(refusal.has_value()) << *refusal;
}

void run(Simulation& simulation, double seconds) {
  for (int i = 0; i < static_cast<int>(std::lround(seconds * 100.0)); ++i) simulation.step();
}

Pose pose_of(const Simulation& simulation) { return simulation.body(0).X_WB; }

void expect_near(const Pose& pose, const Pose& expected, double tolerance) {
  EXPECT_NEAR(pose.x_m, expected.x_m, tolerance);
  EXPECT_NEAR(pose.y_m, expected.y_m, tolerance);
  EXPECT_NEAR(normalize_angle(pose.yaw_rad - expected.yaw_rad), 0.0, tolerance);
}

// --- Omnidirectional

TEST(OmnidirectionalDrive, SideSpeed_StraightToSide) {
  Simulation simulation(room(drive_of(DriveKind::kOmnidirectional), {10.0, 10.0, 0.0}));
  command(simulation, TwistCommand{{.lateral_mps = 0.5}});
  run(simulation, 2.0);
  expect_near(pose_of(simulation), {10.0, 11.0, 0.0}, 1e-9);
  EXPECT_DOUBLE_EQ(simulation.body(0).twist.lateral_mps, 0.5);
  EXPECT_FALSE(simulation.body(0).stalled);
}

TEST(OmnidirectionalDrive, WholeTwist_FollowsArc) {
  Simulation simulation(room(drive_of(DriveKind::kOmnidirectional), {10.0, 10.0, 0.0}));
  command(simulation, TwistCommand{{.v_mps = 0.3, .omega_radps = 1.0, .lateral_mps = 0.4}});
  run(simulation, 2.0);
  // The integral of (0.3, 0.4) rotated by t from 0 to 2:
  // x = 0.3 sin 2 - 0.4 (1 - cos 2), y = 0.3 (1 - cos 2) + 0.4 sin 2.
  const double x = 0.3 * std::sin(2.0) - 0.4 * (1.0 - std::cos(2.0));
  const double y = 0.3 * (1.0 - std::cos(2.0)) + 0.4 * std::sin(2.0);
  expect_near(pose_of(simulation), {10.0 + x, 10.0 + y, 2.0}, 1e-9);
  // Its odometry, which starts at zero, measures all of it.
  const auto& odometry = dynamic_cast<const Odometry&>(simulation.device(0, kOdometryDevice));
  expect_near(odometry.reading().pose, {x, y, 2.0}, 1e-9);
  EXPECT_NEAR(odometry.reading().path_length_m, 0.5 * 0.1, 1e-9);  // since the last reading
}

TEST(OmnidirectionalDrive, Wall_SlidesAlong) {
  // It extends 0.1 m to its left, so it reaches the wall y = 20 at y = 19.9, after 0.25 s.
  Simulation simulation(room(drive_of(DriveKind::kOmnidirectional), {10.0, 19.8, 0.0}));
  command(simulation, TwistCommand{{.v_mps = 0.3, .lateral_mps = 0.4}});
  run(simulation, 2.0);
  EXPECT_NEAR(pose_of(simulation).x_m, 10.6, 0.005);
  EXPECT_NEAR(pose_of(simulation).y_m, 19.9, 0.002);
  EXPECT_NEAR(pose_of(simulation).yaw_rad, 0.0, 0.01);
  EXPECT_TRUE(simulation.body(0).stalled);  // it cannot move farther to its left
}

TEST(FeasiblePlanarTwist, Wall_RemovesComponentIntoIt) {
  // A wall on the left touched at two corners, levers +-0.2 m: no motion to the left, no turning.
  const std::vector<TwistConstraint> wall = {{0.0, 0.2, 0.0, 1.0}, {0.0, -0.2, 0.0, 1.0}};
  const Twist along = feasible_planar_twist({0.3, 0.0, 0.4}, 2.0, 0.1, wall);
  EXPECT_NEAR(along.v_mps, 0.3, 1e-9);
  EXPECT_NEAR(along.lateral_mps, 0.0, 1e-9);
  EXPECT_NEAR(along.omega_radps, 0.0, 1e-9);
  const Twist away = feasible_planar_twist({0.3, 0.0, -0.4}, 2.0, 0.1, wall);
  EXPECT_EQ(away, (Twist{0.3, 0.0, -0.4}));
  // One corner with lever r. The least change of m l^2 + I w^2 from l0 with l + r w = 0 is w = -l0
  // r / (I / m + r^2), l = -r w. Here I / m = 0.05 and r = 0.2, so w = -0.4 * 0.2 / 0.09.
  const Twist turned = feasible_planar_twist({0.0, 0.0, 0.4}, 2.0, 0.1, {{0.0, 0.2, 0.0, 1.0}});
  EXPECT_NEAR(turned.omega_radps, -0.4 * 0.2 / 0.09, 1e-9);
  EXPECT_NEAR(turned.lateral_mps, 0.2 * 0.4 * 0.2 / 0.09, 1e-9);
  // A corner of three walls permits no motion.
  const Twist none = feasible_planar_twist(
      {0.5, 1.0, 0.5}, 2.0, 0.1, {{1.0, 0.0, 0.0, 0.0}, {0.0, 0.0, 0.0, 1.0}, {0.0, 1.0, 0.0}});
  EXPECT_NEAR(none.v_mps, 0.0, 1e-9);
  EXPECT_NEAR(none.lateral_mps, 0.0, 1e-9);
  EXPECT_NEAR(none.omega_radps, 0.0, 1e-9);
}

// --- Car

DriveDescription car(double max_steering_rate_radps = 0.0) {
  DriveDescription drive = drive_of(DriveKind::kCar);
  drive.wheelbase_m = 0.5;
  drive.max_steering_rad = 0.5;
  drive.max_steering_rate_radps = max_steering_rate_radps;
  return drive;
}

TEST(CarDrive, TurnCircle_WheelbaseOverTangent) {
  Simulation simulation(room(car(), {10.0, 10.0, 0.0}));
  command(simulation, CarCommand{1.0, 0.3});
  const double radius = 0.5 / std::tan(0.3);
  run(simulation, 2.0);
  // 2 m along the circle whose centre is straight to the left of B at the start.
  const double angle = 2.0 / radius;
  expect_near(pose_of(simulation),
              {10.0 + radius * std::sin(angle), 10.0 + radius * (1.0 - std::cos(angle)), angle},
              1e-9);
  // In reverse with the same steering it drives back along the circle.
  command(simulation, CarCommand{-1.0, 0.3});
  run(simulation, 2.0);
  expect_near(pose_of(simulation), {10.0, 10.0, 0.0}, 1e-9);
}

TEST(CarDrive, SteeringAngleAndRate_Limited) {
  Simulation simulation(room(car(0.5), {10.0, 10.0, 0.0}));
  command(simulation, CarCommand{0.1, 2.0});
  const auto& motion = dynamic_cast<const Motion&>(simulation.device(0, kMotionDevice));
  run(simulation, 0.5);
  EXPECT_NEAR(motion.steering_rad(), 0.25, 1e-12);  // 0.5 rad/s for 0.5 s
  run(simulation, 1.0);
  EXPECT_NEAR(motion.steering_rad(), 0.5, 1e-12);
}

TEST(CarDrive, SteeringCommands_AngleAndFrontWheelSpeed) {
  DriveDescription drive = car();
  drive.steering_commands = true;
  Simulation simulation(room(drive, {10.0, 10.0, 0.0}));
  const std::vector<Command> commands = {TwistCommand{{.v_mps = 0.8, .omega_radps = 0.4}},
                                         CarCommand{0.8, 0.4}};
  for (const Command& one : commands) {
    command(simulation, one);
    run(simulation, 0.5);
    // Stage: v cos(s) forward, turning at v sin(s) / wheelbase.
    EXPECT_NEAR(simulation.body(0).twist.v_mps, 0.8 * std::cos(0.4), 1e-9);
    EXPECT_NEAR(simulation.body(0).twist.omega_radps, 0.8 * std::sin(0.4) / 0.5, 1e-9);
    const auto& motion = dynamic_cast<const Motion&>(simulation.device(0, kMotionDevice));
    EXPECT_NEAR(motion.steering_rad(), 0.4, 1e-12);
    const auto present = std::get<CarCommand>(motion.present_command());
    EXPECT_NEAR(present.v_mps, 0.8, 1e-12);
    EXPECT_NEAR(present.steering_rad, 0.4, 1e-12);
  }
}

TEST(CarDrive, TurnRate_BySteering) {
  Simulation simulation(room(car(), {10.0, 10.0, 0.0}));
  command(simulation,
          TwistCommand{
              {.v_mps = 1.0, .omega_radps = 0.8, .lateral_mps = 0.7}});  // it cannot move sideways
  run(simulation, 1.0);
  EXPECT_NEAR(simulation.body(0).twist.v_mps, 1.0, 1e-9);
  EXPECT_NEAR(simulation.body(0).twist.omega_radps, 0.8, 1e-9);
  EXPECT_NEAR(simulation.body(0).twist.lateral_mps, 0.0, 1e-9);
  command(simulation, TwistCommand{{.omega_radps = 0.8}});  // it cannot turn on the spot either
  run(simulation, 1.0);
  EXPECT_EQ(simulation.body(0).twist, Twist{});
  // the maximum turn rate is 0.1 tan(0.5) / 0.5
  command(simulation, TwistCommand{{.v_mps = 0.1, .omega_radps = 3.0}});
  run(simulation, 1.0);
  EXPECT_NEAR(simulation.body(0).twist.omega_radps, 0.1 * std::tan(0.5) / 0.5, 1e-9);
}

TEST(CarDrive, Wall_StallsWithoutSliding) {
  // Faces the wall x = 20 at 45 degrees; its corner (0.2, -0.1) touches first.
  Simulation simulation(room(car(), {19.0, 10.0, kPi / 4.0}));
  command(simulation, CarCommand{1.0, 0.0});
  run(simulation, 2.0);
  const Pose first = pose_of(simulation);
  EXPECT_NEAR(first.x_m + 0.3 * std::cos(kPi / 4.0), 20.0, 0.005);
  EXPECT_NEAR(first.yaw_rad, kPi / 4.0, 0.01);
  EXPECT_TRUE(simulation.body(0).stalled);
  run(simulation, 2.0);
  expect_near(pose_of(simulation), first, 1e-3);
}

TEST(FeasibleShare, LargestThatAllConstraintsAllow) {
  const Twist target{1.0, 0.5, 0.0};
  EXPECT_EQ(feasible_share(target, {}), target);
  EXPECT_EQ(feasible_share(target, {{1.0, 0.0, 2.0}}), target);
  const Twist half = feasible_share(target, {{1.0, 0.0, 0.5}, {1.0, 1.0, 1.0}});
  EXPECT_DOUBLE_EQ(half.v_mps, 0.5);
  EXPECT_DOUBLE_EQ(half.omega_radps, 0.25);
  EXPECT_EQ(feasible_share(target, {{1.0, 0.0, 0.0}}).v_mps, 0.0);
}

// --- Differential

TEST(DifferentialDrive, OffsetAxle_TurnsAboutAxle) {
  for (const bool suspended_before : {false, true}) {
    WorldDescription world = room(drive_of(DriveKind::kDifferential), {10.0, 10.0, 0.0});
    auto model = std::make_shared<RobotModel>(*world.models["test"]);
    model->footprint = {{-0.3, -0.1}, {0.1, -0.1}, {0.1, 0.1}, {-0.3, 0.1}};
    world.models["test"] = std::move(model);
    Simulation simulation(std::move(world));
    if (suspended_before) {
      ASSERT_FALSE(simulation.set_robot_dynamics(0, false).has_value());
      ASSERT_FALSE(simulation.set_robot_dynamics(0, true).has_value());
    }
    command(simulation, TwistCommand{{.omega_radps = 1.0}});
    run(simulation, 2.0);
    expect_near(pose_of(simulation), {10.0, 10.0, 2.0}, 1e-5);
    command(simulation, TwistCommand{{.v_mps = 0.5, .omega_radps = 1.0}});  // a circle of 0.5 m
    run(simulation, 2.0);
    expect_near(pose_of(simulation),
                {10.0 + 0.5 * (std::sin(4.0) - std::sin(2.0)),
                 10.0 + 0.5 * (std::cos(2.0) - std::cos(4.0)), 4.0},
                1e-5);
  }
}

TEST(DifferentialDrive, SideSpeed_IgnoredAndSteeringUsesLength) {
  Simulation simulation(load_world_text(
      R"({"arena": {"size": [4, 4]}, "robots": [{"pose": {"x": 2, "y": 2, "yaw_deg": 0}}]})"));
  const int motion = simulation.find_device(0, "motion").value();
  ASSERT_FALSE(simulation.apply({0, motion}, TwistCommand{{.v_mps = 0.1, .lateral_mps = 0.5}}));
  run(simulation, 1.0);
  expect_near(pose_of(simulation), {2.1, 2.0, 0.0}, 1e-9);
  ASSERT_FALSE(simulation.apply({0, motion}, CarCommand{0.1, 0.3}));
  run(simulation, 0.1);
  // The S1R is 0.174 m long.
  EXPECT_NEAR(simulation.body(0).twist.omega_radps, 0.1 * std::tan(0.3) / 0.174, 1e-9);
}

// --- Heading

TEST(HeadingControl, ApproachesExponentiallyAndHolds) {
  Simulation simulation(room({}, {10.0, 10.0, 0.0}));
  command(simulation, HeadingCommand{0.2, 0.0, 0.5});
  run(simulation, 1.0);
  // Each step of 0.01 s reduces the error at a rate of 2 /s: 0.5 * 0.98^100.
  EXPECT_NEAR(0.5 - pose_of(simulation).yaw_rad, 0.5 * std::pow(0.98, 100), 1e-9);
  EXPECT_NEAR(simulation.body(0).twist.v_mps, 0.2, 1e-9);
  run(simulation, 9.0);
  EXPECT_NEAR(pose_of(simulation).yaw_rad, 0.5, 1e-6);
}

TEST(HeadingControl, ShortWay_WithinLimits) {
  Simulation simulation(room({}, {10.0, 10.0, -3.0}));
  command(simulation, HeadingCommand{0.0, 0.0, 1.0});
  simulation.step();
  // From -3 to 1 the shorter turn is -(2 pi - 4) = -2.28 rad: more than the motors' 4 rad/s permit.
  EXPECT_NEAR(simulation.body(0).twist.omega_radps, -4.0, 1e-9);
}

TEST(HeadingControl, FrameOfNamedDevice_Used) {
  Simulation simulation(room({}, {10.0, 10.0, 2.0}));
  command(simulation, HeadingCommand{0.0, 0.0, 0.5, kOdometryDevice});  // reads 0 at the start
  run(simulation, 10.0);
  EXPECT_NEAR(pose_of(simulation).yaw_rad, 2.5, 1e-6);
  // A program may change the pose that this device reports.
  ASSERT_FALSE(simulation.apply({0, kPoseDevice}, SetPoseCommand{{0.0, 0.0, 0.0}}));
  command(simulation, HeadingCommand{0.0, 0.0, 0.25, kPoseDevice});
  run(simulation, 10.0);
  EXPECT_NEAR(pose_of(simulation).yaw_rad, 2.75, 1e-6);
  const auto refusal = simulation.apply({0, kMotionDevice}, HeadingCommand{0.1, 0.0, 0.0, 0});
  EXPECT_THAT(refusal.value_or(""), HasSubstr("no localisation device"));
}

// --- Position

struct Goal {
  const char* what;
  Pose pose;
};

class EachDrive : public testing::TestWithParam<DriveKind> {};
INSTANTIATE_TEST_SUITE_P(All, EachDrive,
                         testing::Values(DriveKind::kDifferential, DriveKind::kOmnidirectional,
                                         DriveKind::kCar),
                         [](const auto& kind) {
                           return std::string(kind.param == DriveKind::kCar ? "Car"
                                              : kind.param == DriveKind::kDifferential
                                                  ? "Differential"
                                                  : "Omnidirectional");
                         });

TEST_P(EachDrive, GoalsAround_ReachedAndStands) {
  for (const Goal& goal :
       {Goal{"ahead", {12.0, 10.0, 1.0}}, Goal{"ahead to the left", {12.0, 11.5, -2.0}},
        Goal{"within its turning circle", {10.1, 10.6, 0.0}}, Goal{"abeam", {10.0, 8.0, 3.0}},
        Goal{"behind", {8.0, 10.2, 0.0}}, Goal{"close behind", {9.8, 9.9, 1.0}}}) {
    for (const double acceleration : {0.0, 1.0}) {
      MotionParams params;
      params.max_acceleration_mps2 = acceleration;
      params.max_turn_acceleration_radps2 = 4.0 * acceleration;
      DriveDescription drive = GetParam() == DriveKind::kCar ? car(2.0) : drive_of(GetParam());
      Simulation simulation(room(drive, {10.0, 10.0, 0.0}, params));
      command(simulation, PositionCommand{goal.pose, 1.0, 2.0});
      double fastest = 0.0;
      for (int i = 0; i < 3000; ++i) {
        simulation.step();
        const Twist& twist = simulation.body(0).twist;
        fastest = std::max(fastest, std::hypot(twist.v_mps, twist.lateral_mps));
      }
      // The two components of the speed have separate ramps, so a turning robot may slightly exceed
      // the limit.
      EXPECT_LE(fastest, acceleration == 0.0 ? 1.0 + 1e-9 : 1.02);
      EXPECT_NEAR(pose_of(simulation).x_m, goal.pose.x_m, 0.011) << goal.what << acceleration;
      EXPECT_NEAR(pose_of(simulation).y_m, goal.pose.y_m, 0.011) << goal.what << acceleration;
      if (GetParam() != DriveKind::kCar) {
        EXPECT_NEAR(normalize_angle(pose_of(simulation).yaw_rad - goal.pose.yaw_rad), 0.0, 0.011)
            << goal.what << acceleration;
      }
      EXPECT_EQ(simulation.body(0).twist, Twist{}) << goal.what << acceleration;
    }
  }
}

// The direction to these goals is within 78 degrees of the heading, and there is enough room for
// the curve.
TEST(CarDrive, GoalOnPath_ReachedWithHeading) {
  for (const double rate_radps : {0.0, 2.0}) {
    for (const Goal& goal :
         {Goal{"beside its way", {14.0, 11.0, 0.0}}, Goal{"turned further", {13.0, 11.5, 1.0}},
          Goal{"turned back", {14.0, 11.5, -0.3}}, Goal{"straight ahead", {12.0, 10.0, 0.0}},
          Goal{"behind it", {6.0, 11.0, 0.0}}, Goal{"behind it, turned", {6.5, 9.0, 0.4}}}) {
      Simulation simulation(room(car(rate_radps), {10.0, 10.0, 0.0}));
      command(simulation, PositionCommand{goal.pose, 1.0, 2.0});
      run(simulation, 30.0);
      EXPECT_EQ(simulation.body(0).twist, Twist{}) << goal.what;
      EXPECT_NEAR((pose_of(simulation).position() - goal.pose.position()).norm(), 0.0, 0.011)
          << goal.what;
      // The rest of the error, which decreases with the distance down to the tolerance of 1 cm.
      EXPECT_NEAR(normalize_angle(pose_of(simulation).yaw_rad - goal.pose.yaw_rad), 0.0, 0.02)
          << goal.what;
    }
  }
}

// From all sides and with all headings: the robot seeks the goal's heading where possible, and
// always reaches the point.
TEST(CarDrive, AnyHeading_GoalReached) {
  for (int i = 0; i < 48; ++i) {
    const double where = 2.0 * kPi / 8.0 * (i % 8);
    const int round = i / 8;
    const double heading = 2.0 * kPi / 6.0 * round - kPi;
    const Pose goal{10.0 + 2.5 * std::cos(where), 10.0 + 2.5 * std::sin(where), heading};
    Simulation simulation(room(car(2.0), {10.0, 10.0, 0.0}));
    command(simulation, PositionCommand{goal, 1.0, 2.0});
    run(simulation, 60.0);
    EXPECT_EQ(simulation.body(0).twist, Twist{}) << i;
    EXPECT_NEAR((pose_of(simulation).position() - goal.position()).norm(), 0.0, 0.011) << i;
  }
}

TEST(PositionControl, Duration_MatchesLaw) {
  Simulation simulation(room({}, {10.0, 10.0, 0.0}));
  command(simulation, PositionCommand{{12.0, 10.0, 0.0}, 0.5});
  // 0.5 m/s until 0.25 m are left (3.5 s), then exponential decay at 2 /s: 0.25 e^(-2 t).
  run(simulation, 3.5);
  EXPECT_NEAR(pose_of(simulation).x_m, 11.75, 1e-9);
  run(simulation, 1.0);
  EXPECT_NEAR(12.0 - pose_of(simulation).x_m, 0.25 * std::pow(0.98, 100), 1e-9);
}

TEST(PositionControl, FrameOfNamedDevice_Used) {
  Simulation simulation(room({}, {10.0, 10.0, kPi / 2.0}));
  command(simulation, PositionCommand{{1.0, 0.5, 0.0}, 0.0, 0.0, kOdometryDevice});
  run(simulation, 20.0);
  // 1 m along the robot's initial x axis, which is W's y axis, and 0.5 m to its left.
  expect_near(pose_of(simulation), {9.5, 11.0, kPi / 2.0}, 0.011);
}

TEST(PositionControl, OtherCommandMotorsAndPlacement_EndIt) {
  Simulation simulation(room({}, {10.0, 10.0, 0.0}));
  const PositionCommand far{{15.0, 10.0, 0.0}};
  command(simulation, far);
  run(simulation, 0.5);
  command(simulation, TwistCommand{{.omega_radps = 0.5}});
  run(simulation, 0.5);
  EXPECT_EQ(simulation.body(0).twist.v_mps, 0.0);
  EXPECT_NEAR(simulation.body(0).twist.omega_radps, 0.5, 1e-9);

  command(simulation, far);
  run(simulation, 0.5);
  command(simulation, MotorEnableCommand{false});
  command(simulation, far);  // ignored: the motors are off
  command(simulation, MotorEnableCommand{true});
  run(simulation, 0.5);
  EXPECT_EQ(simulation.body(0).twist, Twist{});

  command(simulation, far);
  run(simulation, 0.5);
  simulation.set_active({0, kMotionDevice}, false);
  simulation.set_active({0, kMotionDevice}, true);
  run(simulation, 0.5);
  EXPECT_EQ(simulation.body(0).twist, Twist{});
}

TEST(PositionControl, State_Included) {
  Simulation one(room({}, {10.0, 10.0, 0.0}));
  Simulation two(room({}, {10.0, 10.0, 0.0}));
  EXPECT_EQ(one.state_hash(), two.state_hash());
  command(one, PositionCommand{{15.0, 10.0, 0.0}});
  command(two, PositionCommand{{15.0, 10.5, 0.0}});
  EXPECT_NE(one.state_hash(), two.state_hash());
}

// A robot that is told to continue its present command does not change its motion.
TEST(Motion, PresentCommand_Continues) {
  for (const Command& what : std::initializer_list<Command>{
           TwistCommand{{.v_mps = 0.3, .omega_radps = 0.2}}, HeadingCommand{0.3, 0.0, 2.0},
           CarCommand{0.3, 0.2}, PositionCommand{{12.0, 11.0, 1.0}, 0.5, 1.0}}) {
    for (const DriveKind kind : {DriveKind::kDifferential, DriveKind::kCar}) {
      Simulation one(room(kind == DriveKind::kCar ? car() : drive_of(kind), {10.0, 10.0, 0.0}));
      Simulation two(room(kind == DriveKind::kCar ? car() : drive_of(kind), {10.0, 10.0, 0.0}));
      for (Simulation* simulation : {&one, &two}) {
        command(*simulation, what);
        run(*simulation, 1.0);
      }
      const auto& motion = dynamic_cast<const Motion&>(two.device(0, kMotionDevice));
      command(two, Command(motion.present_command()));
      for (Simulation* simulation : {&one, &two}) run(*simulation, 2.0);
      expect_near(pose_of(one), pose_of(two), 1e-9);
    }
  }
}

}  // namespace
}  // namespace sim
