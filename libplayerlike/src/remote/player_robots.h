// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "playerlike/messages/messages.h"
#include "protocol/player_structs.h"

/// Descriptions of a Player server's devices for clients: its robot is the one that proxies and
/// MORSE-like devices see.
namespace playerlike {

/// A device as a Player server lists it.
struct ListedDevice {
  player::Devaddr address;
  std::string driver;
};

/// The type of device whose readings an interface becomes, e.g. "odometry" for position2d; null if
/// Playpen has no device for it.
[[nodiscard]] const char* device_type_of(unsigned interface) noexcept;

/// Describes a server's devices as one robot. Its sizes, and the devices' properties, are unknown
/// until complete_device().
/// @param name  of the robot.
[[nodiscard]] RobotInfo describe_player_robot(const std::string& name, int port,
                                              const std::vector<ListedDevice>& devices);

/// Sends a request without fields to the device. @return the payload of the answer; nothing if the
/// device has no such answer.
using AskDevice = std::function<std::optional<std::string>(std::uint8_t subtype)>;

/// Requests a device's geometry and settings and writes them into its properties, and into those of
/// the robot. The device must be open.
/// @throws protocol::ProtocolError if an answer cannot be understood; what ask() throws.
void complete_device(unsigned interface, const AskDevice& ask, RobotInfo& robot,
                     DeviceInfo& device);

/// As far as a ranger's data contain its geometry and settings.
void complete_ranger(const player::RangerGeom* geometry, const player::RangerConfig* config,
                     DeviceInfo& device);

}  // namespace playerlike
