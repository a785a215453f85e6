// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "playerlike/messages/messages.h"

/// What several of Player's interfaces share. Each file of the folder player_values has the
/// readings and settings of one interface in Player's form, and back. Its templates fill the
/// structs of Player's C headers (player_gripper_geom_t) as well as those of its wire protocol
/// (player::GripperGeom), which have the same fields.
namespace playerlike {

/// A text property of a device by its name: "name" and "type" of the device, and "robot", the name
/// of its robot. @return nothing for other names.
[[nodiscard]] std::optional<std::string> text_property(const RobotInfo& robot,
                                                       const DeviceInfo& device,
                                                       std::string_view name);

/// Properties of position2d by which a mirror takes charge of a robot of a Playpen server, see
/// TakeChargeRequest: a number of seconds, and a truth value that must be set before.
inline constexpr const char* kWatchdogProperty = "watchdog";
inline constexpr const char* kTakeOverProperty = "take_over";

}  // namespace playerlike
