// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/devices/orientation.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "devices/device_kind.h"
#include "sim/world/description.h"

namespace sim {
namespace {

// An angle nearer to its goal than this is there, whatever the tolerance [rad].
constexpr double kThere_rad = 1e-9;

// The turn of an angle in a step, on the short way to its goal.
double turn_of(double now_rad, double goal_rad, double most_rad, double tolerance_rad) {
  const double rest_rad = normalize_angle(goal_rad - now_rad);
  if (std::abs(rest_rad) < std::max(tolerance_rad, kThere_rad)) return 0.0;
  return std::clamp(rest_rad, -most_rad, most_rad);
}

}  // namespace

Orientation::Orientation(std::string name, const OrientationParams& params)
    : Actuator(std::move(name), "orientation"), params_(params) {}

std::optional<std::string> Orientation::apply(const Command& command) {
  const auto* orient = std::get_if<OrientCommand>(&command);
  if (orient == nullptr) return Actuator::apply(command);
  if (!std::isfinite(orient->roll_rad) || !std::isfinite(orient->pitch_rad) ||
      !std::isfinite(orient->yaw_rad)) {
    return "a robot can be turned only to finite angles";
  }
  goal_ = *orient;
  has_goal_ = true;
  return std::nullopt;
}

void Orientation::act(RobotControl& robot) {
  if (!has_goal_) return;
  const BodyState body = robot.body();
  EulerAngles next{goal_.roll_rad, goal_.pitch_rad, goal_.yaw_rad};
  if (params_.speed_radps > 0.0) {
    const double most_rad =
        params_.speed_radps * to_seconds(robot.context().world.simulation.step_ns);
    const auto turn = [&](double now_rad, double goal_rad) {
      return turn_of(now_rad, goal_rad, most_rad, params_.tolerance_rad);
    };
    const Eigen::Vector3d turns(turn(body.elevation.roll_rad, goal_.roll_rad),
                                turn(body.elevation.pitch_rad, goal_.pitch_rad),
                                turn(body.X_WB.yaw_rad, goal_.yaw_rad));
    if (turns.isZero(0.0)) {
      has_goal_ = false;
      return;
    }
    next = {body.elevation.roll_rad, body.elevation.pitch_rad, body.X_WB.yaw_rad + turns.z()};
    if (turns.x() != 0.0 || turns.y() != 0.0 || body.elevation.roll_rad != 0.0 ||
        body.elevation.pitch_rad != 0.0) {
      const Eigen::Matrix3d R_WB = in_space(body.X_WB, body.elevation).linear();
      next = euler_angles_of(R_WB * rotation_about(turns.normalized(), turns.norm()));
    }
  } else {
    has_goal_ = false;
  }
  Pose X_WB = body.X_WB;
  X_WB.yaw_rad = normalize_angle(next.yaw_rad);
  if (X_WB.yaw_rad != body.X_WB.yaw_rad && robot.place(X_WB)) {
    has_goal_ = true;  // something is in the way: the next step tries again
    return;
  }
  robot.elevate(
      {body.elevation.z_m, normalize_angle(next.roll_rad), normalize_angle(next.pitch_rad)});
}

void Orientation::archive(StateArchive& archive) {
  Actuator::archive(archive);
  archive(has_goal_, goal_.roll_rad, goal_.pitch_rad, goal_.yaw_rad);
}

constexpr Field kOrientationSettings[] = {
    field<&OrientationParams::speed_radps>("speed_deg", "degrees/s",
                                           "maximum rate of each angle; 0: the robot turns at once")
        .within(0.0, 3600.0),
    field<&OrientationParams::tolerance_rad>("tolerance_deg", "degrees",
                                             "an angle nearer to its goal than this stays")
        .within(0.0, 180.0),
};
SIM_FIELDS(OrientationParams, kOrientationSettings)

DeviceKind orientation_kind() {
  return device_kind<Orientation, OrientationParams, void>("orientation", {});
}

}  // namespace sim
