// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/devices/teleport.h"

#include <cmath>
#include <utility>

#include "devices/device_kind.h"
#include "devices/modifiers.h"

namespace sim {

Teleport::Teleport(std::string name, const TeleportParams&)
    : Actuator(std::move(name), "teleport") {}

std::optional<std::string> Teleport::execute(const Command& command, RobotControl& robot) {
  Pose X_WB = robot.body().X_WB;
  if (const auto* place = std::get_if<PlaceCommand>(&command)) {
    X_WB = place->pose;
  } else if (const auto* translate = std::get_if<TranslateCommand>(&command)) {
    X_WB.x_m += translate->offset_m.x();
    X_WB.y_m += translate->offset_m.y();
  } else if (const auto* rotate = std::get_if<RotateCommand>(&command)) {
    X_WB.yaw_rad += rotate->yaw_rad;
  } else {
    return apply(command);
  }
  if (!std::isfinite(X_WB.x_m) || !std::isfinite(X_WB.y_m) || !std::isfinite(X_WB.yaw_rad)) {
    return "a robot can be put only where all of x, y and heading are finite numbers";
  }
  X_WB.yaw_rad = normalize_angle(X_WB.yaw_rad);
  auto refusal = robot.place(X_WB);
  if (const auto* place = std::get_if<PlaceCommand>(&command); place != nullptr && !refusal) {
    const Elevation& now = robot.body().elevation;
    robot.elevate({place->z_m.value_or(now.z_m), place->roll_rad.value_or(now.roll_rad),
                   place->pitch_rad.value_or(now.pitch_rad)});
  }
  return refusal;
}

constexpr Modifier kTeleportModifiers[] = {
    kUtmModifier<TeleportParams>, kNedModifier<TeleportParams>, kFeetModifier<TeleportParams>,
    kEcefModifier<TeleportParams>, kGeodeticModifier<TeleportParams>};

constexpr Field kTeleportSettings[] = {
    modifiers_field<kTeleportModifiers>(),
};
SIM_FIELDS(TeleportParams, kTeleportSettings)

DeviceKind teleport_kind() { return device_kind<Teleport, TeleportParams, void>("teleport", {}); }

}  // namespace sim
