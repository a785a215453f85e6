// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "sim/world/description.h"

namespace sim {

/// How a robot's wheels let it move.
enum class DriveKind {
  kDifferential,     ///< forward and turning, also on the spot; never sideways
  kOmnidirectional,  ///< in any direction and turning, independently
  kCar,              ///< along the arcs of its steering; B is at the middle of the rear axle
};

/// The drive of a robot.
struct DriveDescription {
  DriveKind kind = DriveKind::kDifferential;
  /// Of a car: commands give the speed of its front wheels, and TwistCommand's turn rate is their
  /// angle [rad], as in Stage. Otherwise the speed is that of B, and a turn rate is a turn rate.
  bool steering_commands = false;
  double wheel_radius_m = 0.04;          ///< [m]
  double wheel_separation_m = 0.14;      ///< between the wheels' planes [m]
  double wheelbase_m = 0.3;              ///< of a car: distance of the axles [m]
  double max_steering_rad = 0.6;         ///< of a car: to either side [rad]
  double max_steering_rate_radps = 0.0;  ///< of a car [rad/s]; 0: no limit
};

/// A part of a robot that is higher than its body. Sensors see it; nothing collides with it.
struct Superstructure {
  Polygon outline;        ///< in B, convex, counter-clockwise, 3 to 8 vertices [m]
  double height_m = 0.0;  ///< of its top above the floor, greater than that of the body [m]
  double bottom_m = 0.0;  ///< lasers, sonars and other sensors of distances look under it below
                          ///< this height, [0, height_m) [m]
};

/// A type of robot: the properties that do not change while it drives.
struct RobotModel {
  std::string name;
  std::string description;  ///< for people, a sentence or two
  Polygon footprint;        ///< in B, convex, counter-clockwise, 3 to 8 vertices [m]; with parts:
                            ///< the convex outline around them, of any number of vertices
  /// Of a body that is not convex: at least two, each like a footprint; they may overlap. Empty:
  /// the footprint is the body.
  std::vector<Polygon> parts;
  double height_m = 0.18;                       ///< of the body [m]
  std::vector<Superstructure> superstructures;  ///< what sensors see above `height_m`
  bool solid = true;     ///< false: nothing collides with its body; sensors see it
  double mass_kg = 2.0;  ///< [kg]
  DriveDescription drive;
  double max_speed_mps = 0.5;              ///< maximum speed of its drive [m/s]
  double max_turn_rate_radps = 3.0;        ///< maximum turn rate of its drive [rad/s]
  std::vector<DeviceDescription> devices;  ///< sorted by name; no params: the type's defaults
  std::map<std::string, std::vector<std::string>>
      interfaces;  ///< like RobotDescription::interfaces, for interfaces that the robot does not
                   ///< list
};

/// The convex outlines that together are the body of a model, in B [m].
[[nodiscard]] inline std::span<const Polygon> body_parts(const RobotModel& model) {
  return model.parts.empty() ? std::span(&model.footprint, 1) : std::span(model.parts);
}

/// The S1R of SyRoTek, without devices. Its footprint is an octagon around the axle's centre.
[[nodiscard]] RobotModel s1r_model();

/// The built-in model, which robots have by default: the S1R with laser, motion, odometry, pen and
/// pose. One shared object, never destroyed.
[[nodiscard]] const RobotModel& default_robot_model();

/// Looks up the model of that name: the entry in WorldDescription::models, or default_robot_model()
/// for "s1r" without an entry; nullptr if there is none. Valid as long as the world's entry.
[[nodiscard]] const RobotModel* find_robot_model(const WorldDescription& world,
                                                 const std::string& model);

/// A robot model shipped with Playpen: the text of worlds/models/NAME.json, compiled in.
struct ShippedModel {
  const char* name;
  const char* text;  ///< JSON, for io::read_world to read
};

/// All shipped models in alphabetical order, without "s1r", which is built in.
[[nodiscard]] const std::vector<ShippedModel>& shipped_models();

/// Default start pose X_WB of a robot in the SyRoTek arena: on the road in front of the docks,
/// facing along it, with more than 3 m free ahead.
[[nodiscard]] Pose syrotek_start_pose();

/// The SyRoTek arena: 3.42 x 3.72 m, about twenty blocks, docks along its left side.
[[nodiscard]] ArenaDescription syrotek_arena();

}  // namespace sim
