// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Depth camera, destination, hand, and the arm's trajectories and inverse kinematics.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "sim/core/error.h"
#include "sim/devices/actarray.h"
#include "sim/devices/arm_kinematics.h"
#include "sim/devices/depth_camera.h"
#include "sim/devices/hand.h"
#include "sim/simulation/simulation.h"

namespace sim {
namespace {

using testing::Each;
using testing::HasSubstr;
using testing::Optional;

constexpr double kPi = std::numbers::pi;

// A room of 20 x 20 m with a robot at its middle, which looks along x; 50 steps are a second.
WorldDescription room_with(const std::string& devices, const std::string& obstacles = "",
                           const std::string& model = "omni") {
  return load_world_text(
      R"({"simulation": {"step": 0.02}, "arena": {"size": [20, 20], "obstacles": [)" + obstacles +
      R"(]}, "robots": [{"name": "r1", "model": ")" + model +
      R"(", "pose": {"x": 10, "y": 10}, "devices": {"laser": null, )" + devices + "}}]}");
}

// Settings of motors that take any speed at once.
std::string motors_with(const std::string& more = "") {
  return R"("motion": {"max_speed": 2, "max_turn_rate_deg": 200, "max_acceleration": 0,
                       "max_turn_acceleration_deg": 0)" +
         more + "}, ";
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

std::optional<std::string> send(Simulation& simulation, const std::string& name,
                                const Command& command) {
  return simulation.apply(id_of(simulation, name), command);
}

// --- depth_camera

// A camera 0.5 m above the floor, with a focal length of 50 pixels.
constexpr const char* kDepthCamera =
    R"("eye": {"type": "depth_camera", "image": [100, 80], "field_of_view_deg": 90, "height": 0.5,
       "range_min": 0.2, "range_max": 8})";

double depth_at(const DepthCameraReading& reading, int column, int row) {
  return reading.depths_m.at(static_cast<std::size_t>(row * reading.width + column));
}

TEST(DepthCamera, FloorSidesAndTops_Measured) {
  Simulation simulation(
      room_with(kDepthCamera,
                R"({"name": "high", "center": [13, 11], "size": [1, 1], "height": 2},
                   {"name": "low", "center": [13, 9], "size": [2, 1], "height": 0.25})"));
  step(simulation, 20);
  const DepthCameraReading& reading = device<DepthCamera>(simulation, "eye").reading();
  ASSERT_EQ(reading.depths_m.size(), 8000U);
  EXPECT_NEAR(reading.focal_px, 50.0, 1e-9);
  EXPECT_NEAR(reading.centre_px, 40.0, 1e-9);
  // The side of "high" is 2.5 m ahead in all columns that see it, left of the middle.
  EXPECT_NEAR(depth_at(reading, 30, 20), 2.5, 1e-9);
  EXPECT_NEAR(depth_at(reading, 35, 45), 2.5, 1e-9);
  // The floor in row r: focal * 0.5 / (r + 0.5 - 40).
  EXPECT_NEAR(depth_at(reading, 50, 60), 25.0 / 20.5, 1e-9);
  EXPECT_NEAR(depth_at(reading, 50, 79), 25.0 / 39.5, 1e-9);
  // The side of "low" is 2 m ahead; its top is 0.25 m below the lens.
  EXPECT_NEAR(depth_at(reading, 74, 50), 2.0, 1e-9);
  EXPECT_NEAR(depth_at(reading, 74, 44), 12.5 / 4.5, 1e-9);
  // Nothing above the horizon, and no floor beyond the range.
  EXPECT_EQ(depth_at(reading, 90, 10), 0.0);
  EXPECT_EQ(depth_at(reading, 50, 41), 0.0);
}

TEST(DepthCamera, Noise_StaysInRange) {
  Simulation simulation(room_with(
      R"("eye": {"type": "depth_camera", "field_of_view_deg": 90, "height": 0.5, "noise": 0.05,
         "range_min": 0.5, "range_max": 3})",
      R"({"name": "high", "center": [12, 10], "size": [2, 6], "height": 2})"));
  step(simulation, 20);
  const auto& depths = device<DepthCamera>(simulation, "eye").reading().depths_m;
  double sum = 0.0;
  double squares = 0.0;
  int count = 0;
  for (int row = 0; row < 30; ++row) {  // rows above the horizon show the wall, 1 m ahead
    for (int column = 0; column < 80; ++column) {
      const double error = depths.at(static_cast<std::size_t>(row * 80 + column)) - 1.0;
      sum += error;
      squares += error * error;
      ++count;
    }
  }
  // Four standard errors.
  EXPECT_NEAR(sum / count, 0.0, 4.0 * 0.05 / std::sqrt(count));
  EXPECT_NEAR(std::sqrt(squares / count), 0.05, 4.0 * 0.05 / std::sqrt(2.0 * count));
  EXPECT_THAT(depths,
              Each(testing::AnyOf(0.0, testing::AllOf(testing::Ge(0.5), testing::Le(3.0)))));
}

TEST(DepthCamera, SwappedRanges_Refused) {
  EXPECT_THROW(static_cast<void>(
                   room_with(R"("eye": {"type": "depth_camera", "range_min": 3, "range_max": 2})")),
               ConfigError);
}

// --- destination

TEST(Destination, Straight_WithoutTurning) {
  Simulation simulation(room_with(motors_with() + R"("go": {"type": "destination"})"));
  EXPECT_EQ(send(simulation, "go", GotoCommand{{10.0, 11.0}, 0.1, 0.4, 0.3}), std::nullopt);
  step(simulation, 50);  // 1 s
  const BodyState& body = simulation.body(0);
  // 0.4 m along (0, 1, 0.3), within a step.
  const double length = std::hypot(1.0, 0.3);
  EXPECT_NEAR(body.X_WB.y_m, 10.0 + 0.4 / length, 0.01);
  EXPECT_NEAR(body.X_WB.x_m, 10.0, 1e-6);
  EXPECT_NEAR(body.X_WB.yaw_rad, 0.0, 1e-6);
  EXPECT_NEAR(body.elevation.z_m, 0.4 * 0.3 / length, 0.01);
  step(simulation, 200);
  const double missing = std::hypot(11.0 - body.X_WB.y_m, 0.3 - body.elevation.z_m);
  EXPECT_LE(missing, 0.1);
  EXPECT_GE(missing, 0.08);
  EXPECT_EQ(body.twist.lateral_mps, 0.0);
}

TEST(Destination, Remain_Returns) {
  Simulation simulation(
      room_with(motors_with() + R"("go": {"type": "destination", "remain": true})"));
  EXPECT_EQ(send(simulation, "go", GotoCommand{{10.2, 10.0}, 0.1, 0.4}), std::nullopt);
  step(simulation, 100);
  EXPECT_LE(std::abs(simulation.body(0).X_WB.x_m - 10.2), 0.1);
  // Another command to the motors ends its control.
  EXPECT_EQ(send(simulation, "motion", TwistCommand{{.v_mps = 0.3}}), std::nullopt);
  step(simulation, 100);
  EXPECT_GT(simulation.body(0).X_WB.x_m, 10.5);
}

TEST(Destination, InvalidGoals_Refused) {
  Simulation simulation(room_with(R"("go": {"type": "destination"})"));
  EXPECT_THAT(send(simulation, "go", GotoCommand{{1.0, 1.0}, 0.1, -1.0}),
              Optional(HasSubstr("speed")));
  EXPECT_TRUE(send(simulation, "go", StopCommand{}).has_value());
  Simulation wheels(room_with(R"("go": {"type": "destination"})", "", "s1r"));
  EXPECT_THAT(send(wheels, "go", GotoCommand{{1.0, 1.0}, 0.1, 1.0}),
              Optional(HasSubstr("omnidirectional")));
}

// --- motion

TEST(SpeedLoss, SlowsRobotByConstant) {
  Simulation simulation(
      room_with(motors_with(R"(, "speed_loss": 0.1, "turn_loss_deg": 18)") + R"("pose": {})"));
  EXPECT_EQ(send(simulation, "motion", TwistCommand{{.v_mps = 0.3, .lateral_mps = 0.4}}),
            std::nullopt);
  step(simulation, 2);
  // The speed is 0.5 - 0.1, in the same direction.
  EXPECT_NEAR(simulation.body(0).twist.v_mps, 0.24, 1e-6);
  EXPECT_NEAR(simulation.body(0).twist.lateral_mps, 0.32, 1e-6);
  EXPECT_EQ(send(simulation, "motion", TwistCommand{{.v_mps = -0.05, .omega_radps = 1.0}}),
            std::nullopt);
  step(simulation, 2);
  EXPECT_EQ(simulation.body(0).twist.v_mps, 0.0);
  EXPECT_NEAR(simulation.body(0).twist.omega_radps, 1.0 - 0.1 * kPi, 1e-6);
}

// --- hand

constexpr const char* kCups =
    R"({"name": "near", "center": [10.6, 10], "size": [0.1, 0.1], "height": 0.2, "portable": true,
        "tags": ["Graspable"]},
       {"name": "nearer", "center": [10.5, 10.3], "size": [0.1, 0.1], "height": 0.2,
        "portable": true, "tags": ["Graspable"]},
       {"name": "plain", "center": [10.4, 10], "size": [0.1, 0.1], "height": 0.2,
        "portable": true})";

TEST(Hand, NearestInCone_Gripped) {
  Simulation simulation(room_with(
      motors_with() + R"("hand": {"x": 0.2, "z": 0.1, "angle_deg": 60, "distance": 0.5})", kCups));
  step(simulation, 20);
  const auto& hand = device<Hand>(simulation, "hand");
  EXPECT_EQ(hand.reading().near, "near");  // "nearer" is beside the cone, "plain" has no tag
  EXPECT_EQ(send(simulation, "hand", GripCommand{GripCommand::Action::kClose}), std::nullopt);
  step(simulation, 20);
  EXPECT_EQ(hand.reading().held, "near");
  EXPECT_EQ(hand.held(simulation.world(), 0), "near");
  // It goes with the robot.
  EXPECT_EQ(send(simulation, "motion", TwistCommand{{.v_mps = -0.4}}), std::nullopt);
  step(simulation, 50);
  EXPECT_NEAR(simulation.world().arena.obstacles[0].center.x(), 10.2, 0.02);
  EXPECT_EQ(send(simulation, "hand", GripCommand{GripCommand::Action::kOpen}), std::nullopt);
  EXPECT_EQ(hand.held(simulation.world(), 0), "");
  EXPECT_EQ(simulation.world().arena.obstacles[0].carried_by, -1);
}

TEST(Hand, NothingGripped_Explained) {
  Simulation simulation(room_with(R"("hand": {"distance": 0.3})", kCups));
  EXPECT_THAT(send(simulation, "hand", GripCommand{GripCommand::Action::kClose}),
              Optional(HasSubstr("within reach")));
  EXPECT_EQ(send(simulation, "hand", GripCommand{GripCommand::Action::kOpen}), std::nullopt);
  EXPECT_THAT(send(simulation, "hand", GripCommand{GripCommand::Action::kStore}),
              Optional(HasSubstr("opened and closed")));
}

TEST(Hand, ReachFromEndOfArm) {
  // An upright arm of 0.3 m on a base at 0.1 m: its hand looks upwards.
  const std::string arm =
      R"("arm": {"type": "actarray", "pitch_deg": -90, "height": 0.1,
                 "joints": [{"axis": "-y", "length": 0.3}]},
         "hand": {"on": "arm", "distance": 0.4, "angle_deg": 60})";
  Simulation simulation(room_with(arm, kCups));
  step(simulation, 20);
  EXPECT_EQ(device<Hand>(simulation, "hand").reading().near, "");
  // The arm turns forwards.
  EXPECT_EQ(send(simulation, "arm", JointCommand{JointCommand::Mode::kPlace, 0, {-0.5 * kPi}}),
            std::nullopt);
  step(simulation, 20);
  EXPECT_EQ(device<Hand>(simulation, "hand").reading().near, "near");
}

// --- trajectories

constexpr const char* kArm =
    R"("arm": {"type": "actarray", "pitch_deg": -90, "height": 0.3, "joints": [
         {"axis": "-y", "length": 0.4, "min_deg": -170, "max_deg": 170, "speed_max_deg": 360},
         {"axis": "-y", "length": 0.3, "min_deg": -170, "max_deg": 170, "speed_max_deg": 360},
         {"axis": "-y", "length": 0.2, "min_deg": -170, "max_deg": 170, "speed_max_deg": 360}]})";

TEST(Trajectory, Points_PassedAtTheirTimes) {
  Simulation simulation(room_with(kArm));
  step(simulation, 10);
  const auto& arm = device<ActArray>(simulation, "arm");
  TrajectoryCommand command;
  command.times_s = {1.0, 2.0};
  command.positions = {0.5, 0.0, -0.2, 0.5, 1.0, 0.0};
  EXPECT_EQ(send(simulation, "arm", command), std::nullopt);
  EXPECT_TRUE(arm.on_trajectory());
  step(simulation, 25);
  EXPECT_NEAR(arm.positions()[0], 0.25, 1e-9);
  EXPECT_NEAR(arm.positions()[2], -0.1, 1e-9);
  step(simulation, 25);
  EXPECT_NEAR(arm.positions()[0], 0.5, 1e-9);
  step(simulation, 25);
  EXPECT_NEAR(arm.positions()[1], 0.5, 1e-9);
  EXPECT_FALSE(arm.at_rest());
  step(simulation, 25);
  EXPECT_NEAR(arm.positions()[1], 1.0, 1e-9);
  EXPECT_FALSE(arm.on_trajectory());
  EXPECT_TRUE(arm.at_rest());
}

TEST(Trajectory, WaitsForStartAndEndsWithOtherCommand) {
  Simulation simulation(room_with(kArm));
  const auto& arm = device<ActArray>(simulation, "arm");
  TrajectoryCommand command;
  command.start_s = 1.0;
  command.times_s = {1.0};
  command.positions = {1.0, 0.0, 0.0};
  EXPECT_EQ(send(simulation, "arm", command), std::nullopt);
  step(simulation, 50);
  EXPECT_EQ(arm.positions()[0], 0.0);
  step(simulation, 25);
  EXPECT_NEAR(arm.positions()[0], 0.5, 1e-9);
  EXPECT_EQ(send(simulation, "arm", JointCommand{JointCommand::Mode::kSpeed, -1, {0.0}}),
            std::nullopt);
  EXPECT_FALSE(arm.on_trajectory());
  step(simulation, 50);
  // It brakes from 1 rad/s at half of its maximum acceleration, pi rad/s^2.
  EXPECT_NEAR(arm.positions()[0], 0.5 + 1.0 / kPi, 1e-9);
}

TEST(Trajectory, MaximumSpeed_Kept) {
  Simulation simulation(room_with(kArm));
  const auto& arm = device<ActArray>(simulation, "arm");
  EXPECT_EQ(send(simulation, "arm", TrajectoryCommand{{}, {0.0}, {2.0, 0.0, 0.0}}), std::nullopt);
  step(simulation, 5);  // 0.1 s at 2 pi rad/s
  EXPECT_NEAR(arm.positions()[0], 0.2 * kPi, 1e-9);
  EXPECT_TRUE(arm.on_trajectory());
  step(simulation, 50);
  EXPECT_NEAR(arm.positions()[0], 2.0, 1e-9);
  EXPECT_FALSE(arm.on_trajectory());
}

TEST(Trajectory, Invalid_Refused) {
  Simulation simulation(room_with(kArm));
  const auto refusal = [&](const TrajectoryCommand& command) {
    return send(simulation, "arm", command);
  };
  EXPECT_THAT(refusal({}), Optional(HasSubstr("points")));
  EXPECT_THAT(refusal({{}, {1.0}, {0.0}}), Optional(HasSubstr("3 positions")));
  EXPECT_THAT(refusal({{}, {2.0, 1.0}, std::vector<double>(6)}), Optional(HasSubstr("ascending")));
  EXPECT_THAT(refusal({{}, {-1.0}, std::vector<double>(3)}), Optional(HasSubstr("ascending")));
  EXPECT_THAT(refusal({{}, {std::nan("")}, std::vector<double>(3)}), testing::Ne(std::nullopt));
  EXPECT_THAT(refusal({{}, {1e10}, std::vector<double>(3)}), Optional(HasSubstr("1e9")));
}

TEST(Trajectory, Snapshot_Continues) {
  Simulation one(room_with(kArm));
  EXPECT_EQ(send(one, "arm", TrajectoryCommand{0.1, {1.0}, {1.0, -1.0, 0.5}}), std::nullopt);
  step(one, 20);
  Simulation other(room_with(kArm));
  other.restore(one.save());
  step(one, 60);
  step(other, 60);
  EXPECT_EQ(one.state_hash(), other.state_hash());
  EXPECT_NEAR(device<ActArray>(other, "arm").positions()[0], 1.0, 1e-9);
}

// --- inverse kinematics

// An arm that stands upright at rest: joints about y, with the links of kArm.
ActArrayParams upright_arm() {
  ActArrayParams arm;
  arm.height_m = 0.3;
  arm.pitch_rad = -0.5 * kPi;
  for (const double length_m : {0.4, 0.3, 0.2}) {
    JointParams& joint = arm.joints.emplace_back();
    joint.axis = JointAxis::kY;
    joint.length_m = length_m;
    joint.min_rad = -3.0;
    joint.max_rad = 3.0;
  }
  return arm;
}

TEST(SolveArm, KnownPositions_FoundPose) {
  const ActArrayParams arm = upright_arm();
  const std::vector<double> wanted = {0.4, 0.7, -0.5};
  const Eigen::Isometry3d X_BE = arm_frames(arm, wanted).back();
  const std::vector<double> found = solve_arm(arm, {0.1, 0.2, 0.0}, X_BE, 1.5);
  const Eigen::Isometry3d X_BF = arm_frames(arm, found).back();
  EXPECT_NEAR((X_BF.translation() - X_BE.translation()).norm(), 0.0, 1e-5);
  EXPECT_NEAR((X_BF.linear() - X_BE.linear()).norm(), 0.0, 1e-5);
}

TEST(SolveArm, TooFar_ReachesTowards) {
  const ActArrayParams arm = upright_arm();
  Eigen::Isometry3d X_BE = arm_frames(arm, {kPi / 2, 0.0, 0.0}).back();
  X_BE.translation() += Eigen::Vector3d(0.5, 0.0, 0.0);
  const std::vector<double> found = solve_arm(arm, {1.0, 0.3, 0.2}, X_BE, 1.5);
  // Stretched towards the target.
  const Eigen::Vector3d end = arm_frames(arm, found).back().translation();
  EXPECT_NEAR(end.x(), 0.9, 1e-3);
  EXPECT_NEAR(end.z(), 0.3, 1e-2);
}

TEST(SolveArm, Limits_Kept) {
  ActArrayParams arm = upright_arm();
  arm.joints[0].max_rad = 0.3;
  arm.joints[0].min_rad = -0.3;
  const Eigen::Isometry3d X_BE = arm_frames(arm, {1.0, 0.0, 0.0}).back();
  const std::vector<double> found = solve_arm(arm, {0.0, 0.0, 0.0}, X_BE, 0.0);
  EXPECT_NEAR(found[0], 0.3, 1e-6);
  EXPECT_GT(found[1], 0.0);
}

TEST(SolveArm, LinearJoints_Extended) {
  ActArrayParams arm;
  arm.height_m = 0.3;
  JointParams& joint = arm.joints.emplace_back();
  joint.type = JointType::kLinear;
  joint.axis = JointAxis::kX;
  joint.length_m = 0.1;
  joint.max_m = 0.5;
  Eigen::Isometry3d X_BE = Eigen::Isometry3d::Identity();
  X_BE.translation() = Eigen::Vector3d(0.35, 0.0, 0.3);
  EXPECT_NEAR(solve_arm(arm, {0.0}, X_BE, 1.0)[0], 0.25, 1e-6);
}

}  // namespace
}  // namespace sim
