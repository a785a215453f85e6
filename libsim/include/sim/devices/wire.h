// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace sim {

/// The source that an input is wired to: an output or a value of a device.
struct Wire {
  std::string robot;   ///< empty: the robot of the input
  std::string device;  ///< name of the device
  int index = 0;       ///< index of its output or value, from 0
};

/// The form in world files: "ROBOT.DEVICE.INDEX", or "DEVICE.INDEX" for the same robot.
[[nodiscard]] inline std::string to_string(const Wire& wire) {
  return (wire.robot.empty() ? "" : wire.robot + ".") + wire.device + "." +
         std::to_string(wire.index);
}

}  // namespace sim
