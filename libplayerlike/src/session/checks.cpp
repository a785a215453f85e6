// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "session/checks.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <variant>

namespace playerlike {

const DeviceInfo& require_device(const std::vector<RobotInfo>& robots, DeviceId device) {
  for (const RobotInfo& robot : robots) {
    for (const DeviceInfo& info : robot.devices) {
      if (info.id == device) return info;
    }
  }
  throw SessionError(SessionError::Code::kNoSuchDevice,
                     "the world has no device " + std::to_string(device.device) + " of robot " +
                         std::to_string(device.robot));
}

void require_finite(const sim::Command& command) {
  const auto finite = [](std::initializer_list<double> values) {
    return std::all_of(values.begin(), values.end(), [](double x) { return std::isfinite(x); });
  };
  bool good = true;
  if (const auto* twist = std::get_if<sim::TwistCommand>(&command)) {
    good = finite({twist->twist.v_mps, twist->twist.omega_radps, twist->twist.lateral_mps});
  } else if (const auto* pose = std::get_if<sim::SetPoseCommand>(&command)) {
    good = finite({pose->pose.x_m, pose->pose.y_m, pose->pose.yaw_rad});
  }
  if (good) return;
  throw SessionError(SessionError::Code::kBadArgument,
                     "a command holds a value that is not a finite number");
}

}  // namespace playerlike
