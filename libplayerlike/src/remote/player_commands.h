// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "playerlike/session/device_graphics.h"
#include "sim/devices/device.h"

namespace playerlike {

/// A command in Player's protocol.
struct PlayerCommand {
  bool is_request = false;  ///< Player answers some of Playpen's commands
  std::uint8_t subtype = 0;
  std::string payload;
};

/// Converts a command for a device of an interface. @return nothing if Player has no such command.
[[nodiscard]] std::optional<PlayerCommand> to_player(unsigned interface,
                                                     const sim::Command& command);
/// Converts a drawing for a device of the interface graphics2d.
[[nodiscard]] PlayerCommand to_player(const DeviceDrawing& drawing);

}  // namespace playerlike
