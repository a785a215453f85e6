// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/devices/actarray.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sim/core/degrees.h"
#include "sim/core/error.h"
#include "sim/core/fields.h"
#include "sim/core/state_archive.h"
#include "sim/devices/builtin.h"
#include "sim/devices/robot_snapshot.h"
#include "sim/simulation/simulation.h"
#include "temporary_folder.h"

namespace sim {
namespace {

using testing::HasSubstr;
using testing::SizeIs;
using Mode = JointCommand::Mode;
using Setting = JointSettingCommand::Setting;

constexpr double kPi = std::numbers::pi;
/// Bound for rounding errors of a movement of some hundred steps.
constexpr double kRounding = 1e-9;

// --- the profile

/// Position and speed at a time on the way from 0 at rest to `distance` > 0, by the closed formulas
/// of a trapezoid (or triangle) of speed.
JointMotion on_trapezoid(double distance, double speed, double acceleration, double t_s) {
  const double peak = std::min(speed, std::sqrt(acceleration * distance));
  const double ramp_s = peak / acceleration;
  const double total_s = distance / peak + ramp_s;
  if (t_s >= total_s) return {distance, 0.0};
  if (t_s > total_s - ramp_s) {
    const double left_s = total_s - t_s;
    return {distance - 0.5 * acceleration * left_s * left_s, acceleration * left_s};
  }
  if (t_s > ramp_s) return {peak * (t_s - 0.5 * ramp_s), peak};
  return {0.5 * acceleration * t_s * t_s, acceleration * t_s};
}

TEST(AdvanceToGoal, TrapezoidalSpeed_IndependentOfStepSize) {
  // 0.7 m at most 0.5 m/s and 1 m/s^2: 0.5 s up, 0.9 s at full speed, 0.5 s down. 0.1 m: a triangle
  // of 2 sqrt(0.1) s, whose peak is 0.316 m/s.
  for (const double distance : {0.7, 0.1}) {
    for (const double side : {1.0, -1.0}) {
      for (const double dt_s : {0.01, 0.037, 0.4}) {
        JointMotion stepped;
        for (double t_s = dt_s; t_s < 2.5; t_s += dt_s) {
          stepped = advance_to_goal(stepped, side * distance, 0.5, 1.0, dt_s);
          const JointMotion formula = on_trapezoid(distance, 0.5, 1.0, t_s);
          EXPECT_NEAR(stepped.position, side * formula.position, kRounding);
          EXPECT_NEAR(stepped.speed, side * formula.speed, kRounding);
          const JointMotion whole = advance_to_goal({}, side * distance, 0.5, 1.0, t_s);
          EXPECT_NEAR(whole.position, side * formula.position, kRounding);
        }
        EXPECT_EQ(stepped.position, side * distance);  // exactly at the goal
        EXPECT_EQ(stepped.speed, 0.0);
      }
    }
  }
}

TEST(AdvanceToGoal, OppositeMovement_BrakesFirst) {
  // At -0.4 m/s and 1 m/s^2 it stops after 0.4 s at -0.08 m; from there 0.58 m to 0.5 m.
  for (const double t_s : {0.2, 0.4, 0.7, 1.2, 3.0}) {
    const JointMotion made = advance_to_goal({0.0, -0.4}, 0.5, 0.5, 1.0, t_s);
    const double position = t_s <= 0.4 ? -0.4 * t_s + 0.5 * t_s * t_s
                                       : -0.08 + on_trapezoid(0.58, 0.5, 1.0, t_s - 0.4).position;
    EXPECT_NEAR(made.position, position, kRounding) << t_s;
  }
}

TEST(AdvanceToGoal, TooFast_Brakes) {
  // From 1 m/s to 0.5 m/s in 0.5 s over 0.375 m, then 0.5 s at 0.5 m/s.
  const JointMotion made = advance_to_goal({0.0, 1.0}, 2.0, 0.5, 1.0, 1.0);
  EXPECT_NEAR(made.position, 0.375 + 0.25, kRounding);
  EXPECT_NEAR(made.speed, 0.5, kRounding);
}

TEST(AdvanceToGoal, TooLateToStop_Returns) {
  // At 1 m/s and 1 m/s^2 it stops after 1 s at 0.5 m. Back to 0.1 m: 0.5 s up and 0.15 m left.
  EXPECT_NEAR(advance_to_goal({0.0, 1.0}, 0.1, 0.5, 1.0, 1.0).position, 0.5, kRounding);
  const JointMotion back = advance_to_goal({0.0, 1.0}, 0.1, 0.5, 1.0, 1.5);
  EXPECT_NEAR(back.position, 0.5 - on_trapezoid(0.4, 0.5, 1.0, 0.5).position, kRounding);
  EXPECT_EQ(advance_to_goal({0.0, 1.0}, 0.1, 0.5, 1.0, 9.0).position, 0.1);
}

TEST(AdvanceToGoal, AtGoal_Stays) {
  const JointMotion made = advance_to_goal({0.3, 0.0}, 0.3, 0.5, 1.0, 1.0);
  EXPECT_EQ(made.position, 0.3);
  EXPECT_EQ(made.speed, 0.0);
}

TEST(AdvanceWithCurrent, SpeedApproachesProportionalValue) {
  const JointTravel travel{-9.0, 0.0, 9.0, 0.0, 1.0, 2.0, 4.0, 4.0};
  // Half of the current: 1 rad/s with a time constant of 0.5 s. Speed 1 - exp(-2 t), position
  // t - (1 - exp(-2 t)) / 2.
  JointMotion made;
  for (int i = 0; i < 30; ++i) made = advance_with_current(made, 0.5, travel, 0.01);
  EXPECT_NEAR(made.speed, 1.0 - std::exp(-0.6), kRounding);
  EXPECT_NEAR(made.position, 0.3 - 0.5 * (1.0 - std::exp(-0.6)), kRounding);
  // Without current friction stops it: from 1 rad/s it moves 0.5 rad more.
  made = advance_with_current({0.0, 1.0}, 0.0, travel, 20.0);
  EXPECT_NEAR(made.position, 0.5, kRounding);
  EXPECT_NEAR(made.speed, 0.0, kRounding);
}

// --- kinematics

TEST(ArmPoints, FollowAxesAndOrientations) {
  ActArrayParams arm;
  arm.X_BA = {0.1, 0.2, 0.5 * kPi};  // the arm points to the left
  arm.height_m = 0.3;
  arm.joints.resize(3);
  arm.joints[0].length_m = 1.0;
  arm.joints[1].axis = JointAxis::kMinusY;  // positive: upwards
  arm.joints[1].length_m = 2.0;
  arm.joints[2].type = JointType::kLinear;
  arm.joints[2].axis = JointAxis::kX;
  arm.joints[2].pitch_rad = -0.5 * kPi;  // upwards relative to the second link
  arm.joints[2].length_m = 0.25;
  const auto expect = [](const std::array<double, 3>& p, double x, double y, double z) {
    EXPECT_NEAR(p[0], x, 1e-12);
    EXPECT_NEAR(p[1], y, 1e-12);
    EXPECT_NEAR(p[2], z, 1e-12);
  };
  const auto rest = arm_points_m(arm, {});
  ASSERT_THAT(rest, SizeIs(4));
  expect(rest[0], 0.1, 0.2, 0.3);
  expect(rest[1], 0.1, 1.2, 0.3);
  expect(rest[2], 0.1, 3.2, 0.3);
  expect(rest[3], 0.1, 3.2, 0.55);
  // The first joint turns to the right, back to the robot's front; the second one lifts its link by
  // 90 degrees, so the third link points backwards, 0.5 + 0.25 m long.
  const auto moved = arm_points_m(arm, {-0.5 * kPi, 0.5 * kPi, 0.5});
  expect(moved[1], 1.1, 0.2, 0.3);
  expect(moved[2], 1.1, 0.2, 2.3);
  expect(moved[3], 0.35, 0.2, 2.3);
}

// --- the device

/// A robot with two rotary joints, of which the first has a brake, and a linear one.
constexpr const char* kJoints =
    R"("frequency": 100, "joints": [
         {"speed_deg": 30, "speed_max_deg": 60, "acceleration_deg": 60,
          "acceleration_max_deg": 120, "min_deg": -90, "max_deg": 120, "home_deg": 0,
          "brake": true, "current_max": 2},
         {"min_deg": -45, "max_deg": 45},
         {"type": "linear", "axis": "x", "min": 0, "max": 0.2, "home": 0.05, "speed": 0.05,
          "speed_max": 0.1, "acceleration": 0.1, "acceleration_max": 0.2}])";

WorldDescription world_with(const std::string& settings) {
  return load_world_text(R"({"arena": {"size": [2, 2]}, "robots": [{"name": "r1",
      "pose": {"x": 1, "y": 1}, "devices": {"actarray": {)" +
                         settings + "}}}]}");
}

struct Rig {
  explicit Rig(const std::string& settings = kJoints)
      : simulation(world_with(settings)), id{0, simulation.find_device(0, "actarray").value()} {}

  void run(int steps) {
    for (int i = 0; i < steps; ++i) simulation.step();
  }
  std::optional<std::string> move(Mode mode, int joint, std::vector<double> values) {
    return simulation.apply(id, JointCommand{mode, joint, std::move(values)});
  }
  std::optional<std::string> set(Setting setting, double value, int joint = -1) {
    return simulation.apply(id, JointSettingCommand{setting, joint, value});
  }
  [[nodiscard]] const ActArrayReading& reading() const {
    return dynamic_cast<const ActArray&>(simulation.device(0, id.device)).reading();
  }
  [[nodiscard]] const JointReading& joint(std::size_t i) const { return reading().joints.at(i); }

  Simulation simulation;
  Simulation::DeviceId id;
};

TEST(ActArray, StartsAtHomeWithPower) {
  Rig rig;
  rig.run(1);
  ASSERT_THAT(rig.reading().joints, SizeIs(3));
  EXPECT_TRUE(rig.reading().is_powered);
  EXPECT_EQ(rig.joint(0).position, 0.0);
  EXPECT_EQ(rig.joint(2).position, 0.05);
  for (const JointReading& joint : rig.reading().joints) {
    EXPECT_EQ(joint.state, JointState::kIdle);
    EXPECT_EQ(joint.speed, 0.0);
    EXPECT_EQ(joint.current_a, 0.0);
  }
  EXPECT_NEAR(rig.joint(0).speed_setting, 30 * kDegrees, 1e-12);
  EXPECT_EQ(rig.joint(2).acceleration_setting, 0.1);
}

TEST(ActArray, PositionCommand_FollowsTrapezoid) {
  Rig rig;
  ASSERT_EQ(rig.move(Mode::kPosition, 0, {kPi / 4}), std::nullopt);
  // 45 degrees at 30 degrees/s and 60 degrees/s^2: 2 s in all.
  for (int i = 1; i <= 199; ++i) {
    rig.run(1);
    const JointMotion formula = on_trapezoid(45 * kDegrees, 30 * kDegrees, 60 * kDegrees, 0.01 * i);
    ASSERT_NEAR(rig.joint(0).position, formula.position, kRounding);
    ASSERT_NEAR(rig.joint(0).speed, formula.speed, kRounding);
    ASSERT_EQ(rig.joint(0).state, JointState::kMoving);
  }
  EXPECT_NEAR(rig.joint(0).acceleration, -60 * kDegrees, 1e-6);
  rig.run(2);
  EXPECT_EQ(rig.joint(0).position, kPi / 4);
  EXPECT_EQ(rig.joint(0).speed, 0.0);
  EXPECT_EQ(rig.joint(0).state, JointState::kIdle);
  EXPECT_EQ(rig.joint(1).position, 0.0);  // the others have not moved
}

TEST(ActArray, GoalBeyondLimit_Clamped) {
  Rig rig;
  ASSERT_EQ(rig.move(Mode::kPosition, 0, {9.0, -9.0, 9.0}), std::nullopt);
  rig.run(1000);
  EXPECT_NEAR(rig.joint(0).position, 120 * kDegrees, 1e-12);
  EXPECT_NEAR(rig.joint(1).position, -45 * kDegrees, 1e-12);
  EXPECT_EQ(rig.joint(2).position, 0.2);
  for (const JointReading& joint : rig.reading().joints) EXPECT_EQ(joint.state, JointState::kIdle);
}

TEST(ActArray, SpeedCommand_StallsAtLimit) {
  Rig rig;
  ASSERT_EQ(rig.move(Mode::kSpeed, 0, {-0.2, 0.0, 0.03}), std::nullopt);
  rig.run(100);
  // 0.2 rad/s is reached after 0.191 s: 0.2 (1 - 0.0955) rad.
  EXPECT_NEAR(rig.joint(0).speed, -0.2, kRounding);
  EXPECT_NEAR(rig.joint(0).position, -0.2 * (1.0 - 0.5 * 0.2 / (60 * kDegrees)), kRounding);
  EXPECT_EQ(rig.joint(1).state, JointState::kIdle);
  EXPECT_EQ(rig.joint(0).state, JointState::kMoving);
  rig.run(900);
  EXPECT_EQ(rig.joint(0).position, -90 * kDegrees);
  EXPECT_EQ(rig.joint(0).state, JointState::kStalled);
  EXPECT_EQ(rig.joint(0).current_a, -2.0);  // it pushes with its maximum
  EXPECT_EQ(rig.joint(2).position, 0.2);
  EXPECT_EQ(rig.joint(2).state, JointState::kStalled);
  // Away from the limit again.
  ASSERT_EQ(rig.move(Mode::kSpeed, 0, {9.0}), std::nullopt);
  rig.run(100);
  EXPECT_NEAR(rig.joint(0).speed, 60 * kDegrees, kRounding);  // the joint's maximum
  EXPECT_EQ(rig.joint(0).state, JointState::kMoving);
}

TEST(ActArray, SpeedZero_BrakesToRest) {
  Rig rig;
  ASSERT_EQ(rig.move(Mode::kSpeed, 0, {0.5}), std::nullopt);
  rig.run(100);
  const double position = rig.joint(0).position;
  ASSERT_EQ(rig.move(Mode::kSpeed, 0, {0.0}), std::nullopt);
  rig.run(100);
  EXPECT_NEAR(rig.joint(0).position, position + 0.5 * 0.5 * 0.5 / (60 * kDegrees), kRounding);
  EXPECT_EQ(rig.joint(0).speed, 0.0);
  EXPECT_EQ(rig.joint(0).state, JointState::kIdle);
}

TEST(ActArray, Home_ByJointOrWhole) {
  Rig rig;
  ASSERT_EQ(rig.move(Mode::kPosition, 0, {0.3, 0.3, 0.15}), std::nullopt);
  rig.run(500);
  ASSERT_EQ(rig.move(Mode::kHome, 2, {}), std::nullopt);
  rig.run(500);
  EXPECT_EQ(rig.joint(2).position, 0.05);
  EXPECT_EQ(rig.joint(0).position, 0.3);
  ASSERT_EQ(rig.move(Mode::kHome, -1, {}), std::nullopt);
  rig.run(500);
  EXPECT_EQ(rig.joint(0).position, 0.0);
  EXPECT_EQ(rig.joint(1).position, 0.0);
}

TEST(ActArray, OneValue_MovesAllJoints) {
  Rig rig;
  ASSERT_EQ(rig.move(Mode::kPosition, -1, {0.1}), std::nullopt);
  rig.run(500);
  for (const JointReading& joint : rig.reading().joints) EXPECT_EQ(joint.position, 0.1);
}

TEST(ActArray, Current_Pushes) {
  Rig rig;
  // Half of 2 A: towards half of 60 degrees/s, with a time constant of 60/120 s.
  ASSERT_EQ(rig.move(Mode::kCurrent, 0, {1.0}), std::nullopt);
  rig.run(50);
  EXPECT_NEAR(rig.joint(0).speed, 30 * kDegrees * (1.0 - std::exp(-1.0)), kRounding);
  EXPECT_EQ(rig.joint(0).current_a, 1.0);
  EXPECT_EQ(rig.joint(0).state, JointState::kMoving);
  rig.run(1000);
  EXPECT_EQ(rig.joint(0).position, 120 * kDegrees);
  EXPECT_EQ(rig.joint(0).state, JointState::kStalled);
  EXPECT_EQ(rig.joint(0).current_a, 1.0);
  // More than the maximum counts as the maximum: -2 A.
  ASSERT_EQ(rig.move(Mode::kCurrent, 0, {-50.0}), std::nullopt);
  rig.run(10);
  EXPECT_EQ(rig.joint(0).current_a, -2.0);
  EXPECT_LT(rig.joint(0).position, 120 * kDegrees);
  ASSERT_EQ(rig.move(Mode::kCurrent, 0, {0.0}), std::nullopt);
  rig.run(3000);
  EXPECT_NEAR(rig.joint(0).speed, 0.0, kRounding);
}

TEST(ActArray, SpeedAndAcceleration_ApplyToLaterMovements) {
  Rig rig;
  ASSERT_EQ(rig.move(Mode::kPosition, 0, {1.0}), std::nullopt);
  ASSERT_EQ(rig.set(Setting::kSpeed, -0.2, 0), std::nullopt);  // the sign is ignored
  ASSERT_EQ(rig.set(Setting::kAcceleration, 0.4, 0), std::nullopt);
  rig.run(60);
  EXPECT_NEAR(rig.joint(0).speed, 30 * kDegrees, kRounding);  // the movement that has begun
  EXPECT_EQ(rig.joint(0).speed_setting, 0.2);
  ASSERT_EQ(rig.move(Mode::kPosition, 0, {-1.0}), std::nullopt);
  rig.run(600);
  EXPECT_NEAR(rig.joint(0).speed, -0.2, kRounding);
  ASSERT_EQ(rig.set(Setting::kSpeed, 1e6), std::nullopt);  // of all joints, at most the maximum
  rig.run(1);
  EXPECT_NEAR(rig.joint(0).speed_setting, 60 * kDegrees, 1e-12);
  EXPECT_EQ(rig.joint(2).speed_setting, 0.1);
}

TEST(ActArray, WeakerBraking_StaysWithinLimits) {
  Rig rig;
  ASSERT_EQ(rig.move(Mode::kSpeed, 2, {0.1}), std::nullopt);
  rig.run(190);
  ASSERT_EQ(rig.set(Setting::kAcceleration, 0.001, 2), std::nullopt);
  ASSERT_EQ(rig.move(Mode::kPosition, 2, {0.19}), std::nullopt);
  double farthest = 0.0;
  for (int i = 0; i < 300; ++i) {
    rig.run(1);
    farthest = std::max(farthest, rig.joint(2).position);
  }
  EXPECT_EQ(farthest, 0.2);  // it hits the end of its travel, then returns slowly
  EXPECT_LT(rig.joint(2).position, 0.2);
}

TEST(ActArray, NoPower_StandsStill) {
  Rig rig;
  ASSERT_EQ(rig.move(Mode::kPosition, 0, {1.0}), std::nullopt);
  rig.run(50);
  ASSERT_EQ(rig.set(Setting::kPower, 0.0), std::nullopt);
  rig.run(1);
  const double position = rig.joint(0).position;
  EXPECT_FALSE(rig.reading().is_powered);
  EXPECT_EQ(rig.joint(0).state, JointState::kIdle);
  EXPECT_EQ(rig.move(Mode::kPosition, 0, {0.0}), std::nullopt);  // ignored
  rig.run(50);
  ASSERT_EQ(rig.set(Setting::kPower, 1.0), std::nullopt);
  rig.run(50);
  EXPECT_EQ(rig.joint(0).position, position);  // it has forgotten the command
  ASSERT_EQ(rig.move(Mode::kPosition, 0, {0.0}), std::nullopt);
  rig.run(500);
  EXPECT_EQ(rig.joint(0).position, 0.0);
}

TEST(ActArray, NoPower_HoldsJointsWithBrake) {
  Rig rig;
  ASSERT_EQ(rig.move(Mode::kPosition, 0, {1.0, 0.4, 0.1}), std::nullopt);
  rig.run(50);
  ASSERT_EQ(rig.set(Setting::kBrakes, 1.0), std::nullopt);
  rig.run(500);
  EXPECT_EQ(rig.joint(0).state, JointState::kBraked);
  EXPECT_LT(rig.joint(0).position, 0.5);
  EXPECT_EQ(rig.joint(1).position, 0.4);
  const double held = rig.joint(0).position;
  EXPECT_EQ(rig.move(Mode::kHome, -1, {}), std::nullopt);  // the others go home
  rig.run(500);
  EXPECT_EQ(rig.joint(0).position, held);
  EXPECT_EQ(rig.joint(1).position, 0.0);
  ASSERT_EQ(rig.set(Setting::kBrakes, 0.0), std::nullopt);
  ASSERT_EQ(rig.move(Mode::kHome, 0, {}), std::nullopt);
  rig.run(500);
  EXPECT_EQ(rig.joint(0).position, 0.0);
}

TEST(ActArray, InvalidCommands_Refused) {
  Rig rig;
  const std::string no_joint = "device actarray has 3 joints, counted from 0; there is no joint ";
  EXPECT_EQ(rig.move(Mode::kPosition, 3, {0.1}), no_joint + "3");
  EXPECT_EQ(rig.move(Mode::kPosition, -2, {0.1}), no_joint + "-2");
  EXPECT_EQ(rig.move(Mode::kSpeed, 1, {0.1, 0.1, 0.1}), no_joint + "3");
  EXPECT_EQ(rig.move(Mode::kHome, 7, {}), no_joint + "7");
  EXPECT_EQ(rig.set(Setting::kSpeed, 1.0, 3), no_joint + "3");
  EXPECT_THAT(rig.move(Mode::kPosition, 0, {}).value_or(""), HasSubstr("has 0 values"));
  EXPECT_THAT(rig.move(Mode::kPosition, -1, {1, 2}).value_or(""), HasSubstr("has 2 values"));
  EXPECT_THAT(rig.move(Mode::kHome, 0, {1}).value_or(""), HasSubstr("none to go home"));
  EXPECT_THAT(rig.move(Mode::kPosition, 0, {std::nan("")}).value_or(""), HasSubstr("not finite"));
  EXPECT_THAT(rig.set(Setting::kSpeed, 0.0, 0).value_or(""), HasSubstr("cannot be set to 0"));
  EXPECT_THAT(rig.set(Setting::kAcceleration, 0.0).value_or(""), HasSubstr("acceleration"));
  EXPECT_THAT(rig.simulation.apply(rig.id, GripCommand{}).value_or(""), HasSubstr("actarray"));
  rig.run(10);
  for (const JointReading& joint : rig.reading().joints) EXPECT_EQ(joint.state, JointState::kIdle);
  Rig plain(R"("joints": [{}])");
  EXPECT_EQ(plain.set(Setting::kBrakes, 1.0), "no joint of device actarray has a brake");
  EXPECT_EQ(plain.set(Setting::kBrakes, 0.0), std::nullopt);
}

TEST(ActArray, Snapshot_Continues) {
  Rig rig;
  ASSERT_EQ(rig.set(Setting::kSpeed, 0.3, 0), std::nullopt);
  ASSERT_EQ(rig.move(Mode::kPosition, 0, {1.0}), std::nullopt);
  ASSERT_EQ(rig.move(Mode::kSpeed, 1, {-0.3}), std::nullopt);
  ASSERT_EQ(rig.move(Mode::kCurrent, 2, {0.7}), std::nullopt);
  rig.run(77);
  const auto snapshot = rig.simulation.save();
  const auto go_on = [](Rig& any) {
    std::vector<double> seen;
    for (int i = 0; i < 400; ++i) {
      any.run(1);
      for (const JointReading& joint : any.reading().joints) {
        seen.insert(seen.end(), {joint.position, joint.speed, joint.current_a});
      }
    }
    return seen;
  };
  Rig other;
  other.run(5);
  other.simulation.restore(snapshot);
  EXPECT_EQ(rig.simulation.state_hash(), other.simulation.state_hash());
  EXPECT_EQ(go_on(rig), go_on(other));
  EXPECT_EQ(rig.simulation.state_hash(), other.simulation.state_hash());
}

TEST(ActArray, SnapshotOfOtherLimits_Refused) {
  Rig rig(R"("joints": [{"max_deg": 80}])");
  Rig other(R"("joints": [{"max_deg": 81}])");
  EXPECT_THROW(other.simulation.restore(rig.simulation.save()), SnapshotError);
}

TEST(ActArray, Scene_ShowsLinksFromAbove) {
  Rig rig(R"("pose": {"x": 0.05}, "joints": [{"length": 0.2}, {"length": 0.1, "axis": "-y"}])");
  ASSERT_EQ(rig.move(Mode::kPosition, 0, {kPi / 2, kPi / 2}), std::nullopt);
  rig.run(500);
  const RobotSnapshot shot = rig.simulation.robot_snapshot(0);
  ASSERT_THAT(shot.arms, SizeIs(1));
  ASSERT_THAT(shot.arms[0], SizeIs(3));
  EXPECT_LT((shot.arms[0][0] - Vec2(0.05, 0.0)).norm(), 1e-12);
  EXPECT_LT((shot.arms[0][1] - Vec2(0.05, 0.2)).norm(), 1e-12);  // to the left
  EXPECT_LT((shot.arms[0][2] - Vec2(0.05, 0.2)).norm(), 1e-12);  // upright
}

// --- settings

TEST(ActArraySettings, HaveDefaults) {
  Rig rig("");
  rig.run(10);
  EXPECT_THAT(rig.reading().joints, SizeIs(default_joints().size()));
  const JointTravel rotary = travel_of({});
  EXPECT_EQ(rotary.min, -0.5 * kPi);
  EXPECT_EQ(rotary.max, 0.5 * kPi);
  EXPECT_EQ(rotary.home, 0.0);
  EXPECT_EQ(rotary.speed, 0.25 * kPi);
  JointParams slide;
  slide.type = JointType::kLinear;
  const JointTravel linear = travel_of(slide);
  EXPECT_EQ(linear.centre, 0.05);
  EXPECT_EQ(linear.home, 0.05);
  EXPECT_EQ(linear.acceleration, 0.1);
}

TEST(ActArraySettings, ListedAsProperties) {
  const WorldDescription world = world_with(kJoints);
  const DeviceKind* kind = find_device_kind("actarray");
  const auto& devices = world.robots[0].devices;
  const auto arm = std::ranges::find(devices, "actarray", &DeviceDescription::name);
  ASSERT_NE(arm, devices.end());
  const auto properties = kind->model_properties(arm->params, RobotModel{});
  EXPECT_EQ(properties.at("count"), 3.0);
  EXPECT_EQ(properties.at("type_2"), 1.0);
  EXPECT_EQ(properties.at("axis_0"), 2.0);
  EXPECT_EQ(properties.at("brake_0"), 1.0);
  EXPECT_NEAR(properties.at("max_0"), 120 * kDegrees, 1e-12);
  EXPECT_NEAR(properties.at("centre_0"), 15 * kDegrees, 1e-12);
  EXPECT_EQ(properties.at("home_2"), 0.05);
  EXPECT_EQ(kind->model_properties({}, RobotModel{}).at("count"), 5.0);
}

TEST(ActArraySettings, JointSettings_OnPage) {
  const std::string page = test_support::read_bytes(PLAYPEN_SOURCE_DIR "/docs/devices/actarray.md");
  for (const Field& field : fields_of<JointParams>().fields) {
    EXPECT_THAT(page, HasSubstr('`' + std::string(field.name) + '`'));
  }
}

struct Wrong {
  const char* settings;
  const char* id;
  const char* pointer;
  const char* expected;
};

TEST(ActArraySettings, InvalidSettings_RefusedWithReason) {
  const std::string device = "/robots/0/devices/actarray";
  const Wrong cases[] = {
      {R"("joints": [{}, {"min": 0}])", "device/joint-unit", "/joints/1",
       "rotary joint in degrees"},
      {R"("joints": [{"type": "linear", "speed_deg": 3}])", "device/joint-unit", "/joints/0",
       "linear joint in metres"},
      {R"("joints": [{"min_deg": 100}])", "device/joint-range", "/joints/0", "minimum"},
      {R"("joints": [{"home_deg": 100}])", "device/joint-range", "/joints/0",
       "a home of a joint between -90 degrees and 90 degrees"},
      {R"("joints": [{"centre_deg": -100}])", "device/joint-range", "/joints/0", "a centre"},
      {R"("joints": [{"type": "linear", "speed": 1}])", "device/joint-range", "/joints/0",
       "a speed of a joint of at most 0.1 m/s"},
      {R"("joints": [{"acceleration_deg": 200}])", "device/joint-range", "/joints/0",
       "an acceleration of a joint of at most 180 degrees/s^2"},
      {R"("joints": [{"length": -1}])", "world/out-of-range", "/joints/0/length", ""},
      {R"("joints": [{"axis": "w"}])", "world/unknown-value", "/joints/0/axis", ""},
      {R"("joints": [{"lenght": 1}])", "world/unknown-key", "/joints/0/lenght", ""},
  };
  for (const Wrong& wrong : cases) {
    try {
      static_cast<void>(world_with(wrong.settings));
      ADD_FAILURE() << "was read: " << wrong.settings;
    } catch (const ConfigError& error) {
      ASSERT_THAT(error.issues(), SizeIs(1)) << wrong.settings;
      EXPECT_EQ(error.issues()[0].id, wrong.id) << wrong.settings;
      EXPECT_EQ(error.issues()[0].pointer, device + wrong.pointer);
      EXPECT_THAT(error.issues()[0].expected, HasSubstr(wrong.expected));
    }
  }
}

}  // namespace
}  // namespace sim
