// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <string>

#include "playerlike/messages/messages.h"
#include "session/player_values/poses.h"
#include "sim/core/math.h"
#include "sim/devices/device.h"
#include "sim/devices/localization.h"

/// @file
/// Player's interface position2d.
namespace playerlike {

template <typename Data, MaybeConst<sim::PoseReading> Measured, typename Same>
void same_values(Data& data, Measured& measured, Same same) {
  same(data.pos, measured.pose);
  same(data.vel, measured.twist);
  same(data.stall, measured.stalled);
}

template <typename Command, MaybeConst<sim::TwistCommand> Drive, typename Same>
void same_values(Command& command, Drive& drive, Same same) {
  same(command.vel, drive.twist);
}

template <typename Command, MaybeConst<sim::CarCommand> Drive, typename Same>
void same_values(Command& command, Drive& drive, Same same) {
  same(command.velocity, drive.v_mps);
  same(command.angle, drive.steering_rad);
}

/// The message has no speed to the side.
template <typename Command, MaybeConst<sim::HeadingCommand> Drive, typename Same>
void same_values(Command& command, Drive& drive, Same same) {
  same(command.velocity, drive.v_mps);
  same(command.angle, drive.yaw_rad);
}

/// The command for a goal and the greatest speeds on the way to it.
/// @param frame  the device that measures the pose.
template <typename Pose2d>
[[nodiscard]] sim::PositionCommand position_command(const Pose2d& goal, const Pose2d& speeds,
                                                    int frame) {
  return {normalized_pose(goal), sim::math::hypot(speeds.px, speeds.py), std::abs(speeds.pa),
          frame};
}

/// The place of the robot's centre.
template <typename Pose3d>
[[nodiscard]] Pose3d center_of(const RobotInfo& robot) {
  return {robot.center_m.x(), robot.center_m.y(), 0.0, 0.0, 0.0, 0.0};
}

/// The error of a command to a robot without motors.
[[nodiscard]] inline SessionError no_motors(const RobotInfo& robot) {
  return {SessionError::Code::kNotAvailable,
          "robot " + robot.name + " has no motors (a device of type \"motion\") in this world"};
}

}  // namespace playerlike
