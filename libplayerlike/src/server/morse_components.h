// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "playerlike/messages/messages.h"
#include "sim/devices/localization.h"
#include "sim/simulation/simulation.h"

/// What MORSE's clients see of a world: components, and the objects that their streams carry
/// (docs/morse.md).
namespace playerlike::server {

/// Which way a component's stream goes, as seen from the simulation.
enum class StreamDirection {
  kNone,  ///< it has none
  kIn,    ///< clients write what the device is to do
  kOut,   ///< clients read what the sensor tells
};

/// A part of a robot, as MORSE calls it: one of its devices, or its robot_properties.
struct MorseComponent {
  std::string name;             ///< "r1.pose"
  std::string type;             ///< of the device, "pose"; or "robot_properties"
  std::string_view class_name;  ///< as `details` tells the type: MORSE's own where it has such a
                                ///< thing, "Pose"
  StreamDirection stream = StreamDirection::kNone;
  int robot = 0;                   ///< index
  std::optional<DeviceId> device;  ///< none: robot_properties
};

/// All components of all robots: the robots' in their order, each robot's devices in theirs, then
/// its robot_properties, unless a device of the world has that name.
[[nodiscard]] std::vector<MorseComponent> morse_components(const std::vector<RobotInfo>& robots);

/// The object that a sensor's stream carries for a reading. Lengths in m, angles in rad, times in
/// s of simulated time.
/// @param level  of an odometry device; none for all others.
[[nodiscard]] nlohmann::json morse_record(const sim::Reading& reading,
                                          std::optional<sim::OdometryLevel> level);

/// The same for robot_properties: the robot as the world describes it.
[[nodiscard]] nlohmann::json morse_properties_record(const RobotInfo& robot, sim::SimTime now_ns);

/// The level of an odometry device; nullopt for any other.
[[nodiscard]] std::optional<sim::OdometryLevel> odometry_level(const sim::Simulation& simulation,
                                                               DeviceId device);

/// What a line written to a device's stream tells it to do; keys that it does not need are ignored.
/// @param type  of the device: "motion", "waypoint" or "teleport".
/// @throws protocol::ProtocolError naming the key, what was expected and what was found.
[[nodiscard]] sim::Command morse_command(const MorseComponent& component,
                                         const nlohmann::json& object,
                                         const sim::Simulation& simulation);

/// A world's box as MORSE's get_scene_objects has it: [children, position, quaternion].
[[nodiscard]] nlohmann::json morse_scene_object(const sim::SceneObject& object);

}  // namespace playerlike::server
