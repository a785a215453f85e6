// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace sim {

/// What an input is wired to: one of the outputs, or values, of a device.
struct Wire {
  std::string robot;   ///< empty: the input's own robot
  std::string device;  ///< its name
  int index = 0;       ///< which of its outputs or values, from 0
};

/// As world files name it: "ROBOT.DEVICE.INDEX", or "DEVICE.INDEX" for the own robot.
[[nodiscard]] inline std::string to_string(const Wire& wire) {
  return (wire.robot.empty() ? "" : wire.robot + ".") + wire.device + "." +
         std::to_string(wire.index);
}

}  // namespace sim
