// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>

#include "drivers/goal_thread.h"
#include "libCCMorse/LocalDriver.h"
#include "playerlike/messages/messages.h"

namespace playerlike {

class ClientCore;

/// The robot of a position2d device; null for an address of the world.
/// @throws SessionError kNoSuchDevice.
[[nodiscard]] const RobotInfo* robot_of_position(ClientCore& core, std::uint32_t position);

}  // namespace playerlike

namespace CCMorse {

/// What a kind of driver adds to LocalDriver.
struct LocalDriver::Start {
  /// Settings for a robot, null if it is unknown. @throws PlayerError kBadArgument.
  std::function<playerlike::GoalDriverSettings(const playerlike::RobotInfo* robot)> settings;
};

}  // namespace CCMorse
