// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "session/player_values.h"

namespace playerlike {

std::optional<std::string> text_property(const RobotInfo& robot, const DeviceInfo& device,
                                         std::string_view name) {
  if (name == "name") return device.name;
  if (name == "type") return device.type;
  if (name == "robot") return robot.name;
  return std::nullopt;
}

}  // namespace playerlike
