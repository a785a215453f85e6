// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "sim/devices/device.h"

namespace sim {

/// Settings of the teleport actuator: it has none.
struct TeleportParams {};

/// Puts its robot somewhere else at once, without a way in between.
///
/// Takes PlaceCommand, TranslateCommand and RotateCommand. The robot is then at rest there: its
/// motors' last twist is forgotten and a waypoint in transit stops. Localisation shows the new
/// pose; odometry notices nothing, as no wheel has turned; a pen's trail has a gap; contacts are
/// found anew in the next step; the way is not counted.
/// Refused, with a sentence, are numbers that are not finite and a place off the floor, in an
/// obstacle, a wall or another robot; the robot then stays where it is.
class Teleport final : public Actuator {
 public:
  Teleport(std::string name, const TeleportParams& params);

  std::optional<std::string> execute(const Command& command, RobotControl& robot) override;
};

}  // namespace sim
