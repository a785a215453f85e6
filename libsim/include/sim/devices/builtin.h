// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "sim/devices/device.h"
#include "sim/io/world_io.h"
#include "sim/world/robot_model.h"

namespace sim {

/// A row of the table of device kinds: how settings are read, and how a device is made.
struct DeviceKind : io::DeviceType {
  /// @param world_seed  seed of the run, for the device's noise stream.
  std::function<std::unique_ptr<Device>(const DeviceDescription&, const RobotDescription&,
                                        const RobotModel&, std::uint64_t world_seed)>
      create;
  /// The numeric settings as clients are told of them, SI units and radians.
  std::function<std::map<std::string, double>(const std::any& params)> properties;
  /// Those among them that also depend on the robot's model, to take the place of the ones above;
  /// empty for kinds without such.
  std::function<std::map<std::string, double>(const std::any& params, const RobotModel& model)>
      model_properties;
};

/// All kinds of device that libsim has, in order of name. Written out by hand: static libraries
/// drop objects that would register themselves.
[[nodiscard]] const std::vector<DeviceKind>& device_kinds();

/// The same, as io wants it.
[[nodiscard]] std::vector<io::DeviceType> device_types();

}  // namespace sim
