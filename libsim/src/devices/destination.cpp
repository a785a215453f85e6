// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/devices/destination.h"

#include <Eigen/Geometry>
#include <cmath>
#include <utility>

#include "devices/device_kind.h"
#include "devices/goal.h"
#include "sim/core/math.h"
#include "sim/world/description.h"

namespace sim {

Destination::Destination(std::string name, const DestinationParams& params, bool can_move_sideways)
    : Actuator(std::move(name), "destination"),
      params_(params),
      can_move_sideways_(can_move_sideways) {}

std::optional<std::string> Destination::execute(const Command& command, RobotControl& robot) {
  const auto* go = std::get_if<GotoCommand>(&command);
  if (go == nullptr) return apply(command);
  if (auto refusal = refusal_of(*go)) return refusal;
  if (!can_move_sideways_) {
    return "the robot cannot drive straight to a point without turning: its drive is not "
           "omnidirectional";
  }
  if (!robot.acquire_motors(*this)) return "the robot has no motors to drive to a goal with";
  goal_ = *go;
  has_goal_ = is_on_way_ = true;
  return std::nullopt;
}

void Destination::act(RobotControl& robot) {
  if (!has_goal_) return;
  const BodyState& body = robot.body();
  const Pose& X_WB = body.X_WB;
  const double step_s = to_seconds(robot.context().world.simulation.step_ns);
  const Eigen::Vector3d way(goal_.goal_m.x() - X_WB.x_m, goal_.goal_m.y() - X_WB.y_m,
                            goal_.z_m.value_or(body.elevation.z_m) - body.elevation.z_m);
  const double distance_m = way.norm();
  if (distance_m <= goal_.tolerance_m) {
    if (is_on_way_) robot.drive({});
    is_on_way_ = false;
    has_goal_ = params_.remain;
    return;
  }
  is_on_way_ = true;
  const Eigen::Vector3d velocity = goal_.speed_mps / distance_m * way;
  const auto [s, c] = math::sin_cos(X_WB.yaw_rad);
  robot.drive({c * velocity.x() + s * velocity.y(), 0.0, c * velocity.y() - s * velocity.x()});
  Elevation elevation = body.elevation;
  elevation.z_m += velocity.z() * step_s;
  if (velocity.z() != 0.0) robot.elevate(elevation);
}

void Destination::placed(const Pose& /*X_WB*/) { on_motors_taken(); }

void Destination::deactivated(RobotControl& robot) {
  if (is_on_way_) robot.drive({});
  on_motors_taken();
}

void Destination::archive(StateArchive& archive) {
  Actuator::archive(archive);
  archive.fields(goal_);
  archive(has_goal_, is_on_way_);
}

constexpr Field kDestinationSettings[] = {
    field<&DestinationParams::tolerance_m>("tolerance", "m",
                                           "distance from the goal at which the robot stops")
        .above(0.0, 1000.0),
    field<&DestinationParams::speed_mps>("speed", "m/s", "on the way; the motors' limits also hold")
        .above(0.0, 20.0),
    field<&DestinationParams::remain>("remain", "",
                                      "whether a robot that is pushed away from its goal returns"),
};
SIM_FIELDS(DestinationParams, kDestinationSettings)

DeviceKind destination_kind() {
  return device_kind<DestinationParams, void>(
      "destination", {},
      [](const DeviceConstruction& construction, const DestinationParams& params) {
        return std::make_unique<Destination>(
            construction.name(), params,
            construction.model.drive.kind == DriveKind::kOmnidirectional);
      });
}

}  // namespace sim
