// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "playerlike/messages/messages.h"

/// What all sessions check before a simulation, or a server, is bothered.
namespace playerlike {

/// The device as the world has it. @throws SessionError kNoSuchDevice.
const DeviceInfo& require_device(const std::vector<RobotInfo>& robots, DeviceId device);

/// Throws SessionError kBadArgument if a velocity or pose is not finite. Other commands are looked
/// at by their devices.
void require_finite(const sim::Command& command);

}  // namespace playerlike
