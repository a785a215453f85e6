// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "sim/devices/coordinates.h"
#include "sim/devices/device.h"

namespace sim {

/// Settings of the teleport actuator: the coordinates of its messages in MORSE's protocol.
struct TeleportParams : CoordinateParams {};

/// Moves its robot to another place at once.
///
/// Takes PlaceCommand, TranslateCommand and RotateCommand. Afterwards the robot is at rest: the
/// motors' last twist is discarded, and a waypoint device in transit stops. Localisation shows the
/// new pose. Odometry does not change, since no wheel has turned. A pen's trail has a gap. The next
/// step determines contacts anew. The distance does not count as path length.
///
/// Numbers that are not finite, and poses off the floor or inside an obstacle, a wall or another
/// robot, are refused with a reason; the robot then stays where it is.
class Teleport final : public Actuator {
 public:
  Teleport(std::string name, const TeleportParams& params);

  std::optional<std::string> execute(const Command& command, RobotControl& robot) override;
};

}  // namespace sim
