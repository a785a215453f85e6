// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include "sim/world/description.h"

namespace sim {

/// Which way the wheels of a robot let it move.
enum class DriveKind {
  kDifferential,     ///< forward and turning, on the spot too; never sideways
  kOmnidirectional,  ///< any way and turning, independently
  kCar,              ///< along the arcs that its steering allows; B is the middle of the rear axle
};

/// What moves a robot.
struct DriveDescription {
  DriveKind kind = DriveKind::kDifferential;
  double wheel_radius_m = 0.04;          ///< [m], > 0
  double wheel_separation_m = 0.14;      ///< between the wheels' planes [m], > 0
  double wheelbase_m = 0.3;              ///< of a car: from rear to front axle [m], > 0
  double max_steering_rad = 0.6;         ///< of a car: either way, in (0, pi/2) [rad]
  double max_steering_rate_radps = 0.0;  ///< of a car, >= 0 [rad/s]; 0: no limit
};

/// A kind of robot: what does not change while it drives.
struct RobotModel {
  std::string name;
  std::string description;  ///< for people, a sentence or two
  Polygon footprint;        ///< in B, convex, counter-clockwise, 3 to 8 vertices [m]
  double height_m = 0.18;   ///< [m]
  double mass_kg = 2.0;     ///< [kg]
  DriveDescription drive;
  double max_speed_mps = 0.5;              ///< what its drive can do [m/s]
  double max_turn_rate_radps = 3.0;        ///< the same [rad/s]
  std::vector<DeviceDescription> devices;  ///< in order of name; no params: the type's defaults
  std::map<std::string, std::vector<std::string>>
      interfaces;  ///< as RobotDescription has it, for interfaces that a robot says nothing of
};

/// The S1R of SyRoTek (footprint an octagon round the axle's centre), without devices.
[[nodiscard]] RobotModel s1r_model();

/// The model that is part of this library, and that robots have unless told otherwise: the S1R
/// with laser, motion, odometry, pen and pose. Shared by all, never destroyed.
[[nodiscard]] const RobotModel& default_robot_model();

/// What a world's robots of that model are: the one of WorldDescription::models, else, for "s1r",
/// default_robot_model(); nullptr if there is none. Valid as long as the world's entry.
[[nodiscard]] const RobotModel* find_robot_model(const WorldDescription& world,
                                                 const std::string& model);

/// A model that Playpen comes with, as a file: worlds/models/NAME.json, compiled in.
struct ShippedModel {
  const char* name;
  const char* text;  ///< JSON, for io::read_world to read
};

/// All of them, in alphabetical order; "s1r" is not among them, it is the library's own.
[[nodiscard]] const std::vector<ShippedModel>& shipped_models();

/// Where a robot of the SyRoTek arena starts unless told otherwise: on the road before the docks,
/// looking along it (X_WB), with more than 3 m free ahead.
[[nodiscard]] Pose syrotek_start_pose();

/// The SyRoTek arena: 3.42 x 3.72 m, about twenty blocks, docks along its left side.
[[nodiscard]] ArenaDescription syrotek_arena();

}  // namespace sim
