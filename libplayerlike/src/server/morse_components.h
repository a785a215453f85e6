// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "playerlike/messages/messages.h"
#include "sim/devices/gps.h"
#include "sim/devices/localization.h"
#include "sim/simulation/simulation.h"

/// The view of a world for MORSE's clients: components and the objects in their streams
/// (docs/morse.md).
namespace playerlike::server {

/// The direction of a component's stream, seen from the simulation.
enum class StreamDirection {
  kNone,  ///< the component has no stream
  kIn,    ///< clients write commands for the device
  kOut,   ///< clients read the sensor
};

/// A component in MORSE's sense: a device of a robot, or a robot's robot_properties.
struct MorseComponent {
  std::string name;             ///< "r1.pose"
  std::string type;             ///< of the device, "pose"; or "robot_properties"
  std::string_view class_name;  ///< in answers to `details`: MORSE's own, if any, such as "Pose"
  StreamDirection stream = StreamDirection::kNone;
  int robot = 0;                   ///< index
  std::optional<DeviceId> device;  ///< none: this is robot_properties
};

/// All components, in the order of the robots: for each robot its devices in order, then
/// robot_properties, unless a device has that name. A device that is carried by another one has its
/// name in between: "r1.ptu.camera".
[[nodiscard]] std::vector<MorseComponent> morse_components(const std::vector<RobotInfo>& robots,
                                                           const sim::Simulation& simulation);

/// What the world says of the form of a device's messages.
struct StreamFormat {
  std::optional<sim::OdometryLevel> odometry;  ///< of an odometry device
  sim::GpsLevel gps = sim::GpsLevel::kExtended;
  sim::CoordinateParams coordinates;
  double field_of_view_rad = 0.0;  ///< of a camera; on a head, the head's may differ
};
[[nodiscard]] StreamFormat stream_format(const sim::Simulation& simulation, DeviceId device);

/// The object that a sensor's stream carries for a reading. Lengths in m, angles in rad, times in s
/// of simulated time.
[[nodiscard]] nlohmann::json morse_record(const sim::Reading& reading, const StreamFormat& format);

/// The object that the stream of robot_properties carries: the robot as the world describes it.
[[nodiscard]] nlohmann::json morse_properties_record(const RobotInfo& robot, sim::SimTime now_ns);

/// The command in a line that a client writes to a device's stream; ignores keys that the command
/// does not use.
/// @param component  with a stream of direction kIn.
/// @throws protocol::ProtocolError that names the key, the expected value and the value found.
[[nodiscard]] sim::Command morse_command(const MorseComponent& component,
                                         const nlohmann::json& object,
                                         const sim::Simulation& simulation);

/// An obstacle in the format of MORSE's get_scene_objects: [children, position, quaternion].
[[nodiscard]] nlohmann::json morse_scene_object(const sim::SceneObject& object);

}  // namespace playerlike::server
