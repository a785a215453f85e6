// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include "sim/world/description.h"

namespace sim {

/// A kind of robot: what does not change while it drives.
struct RobotModel {
  std::string name;
  Polygon footprint;                       ///< in B, convex, counter-clockwise, 3 to 8 vertices [m]
  double height_m = 0.18;                  ///< [m]
  double mass_kg = 2.0;                    ///< [kg]
  double wheel_radius_m = 0.04;            ///< [m]
  double wheel_separation_m = 0.14;        ///< between the wheels' planes [m]
  double max_speed_mps = 0.5;              ///< [m/s]
  double max_turn_rate_radps = 3.0;        ///< [rad/s]
  std::vector<DeviceDescription> devices;  ///< with default settings, in order of name
  std::map<std::string, std::vector<std::string>>
      interfaces;  ///< as RobotDescription has it, for interfaces that a robot says nothing of
};

/// The S1R of SyRoTek (DESIGN: footprint an octagon round the axle's centre), without devices.
[[nodiscard]] RobotModel s1r_model();

/// The model of that name, or nullptr. Devices are those the model carries by default.
[[nodiscard]] const RobotModel* find_robot_model(const std::string& name);

/// Names of all models, in alphabetical order.
[[nodiscard]] std::vector<std::string> robot_model_names();

/// Where a robot of the SyRoTek arena starts unless told otherwise: on the road before the docks,
/// looking along it (X_WB), with more than 3 m free ahead.
[[nodiscard]] Pose syrotek_start_pose();

/// The SyRoTek arena: 3.42 x 3.72 m, about twenty blocks, docks along its left side.
[[nodiscard]] ArenaDescription syrotek_arena();

}  // namespace sim
