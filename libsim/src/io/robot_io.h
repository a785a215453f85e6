// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "io/document.h"
#include "sim/io/reader.h"
#include "sim/io/world_io.h"
#include "sim/world/robot_model.h"

/// Reading of robots: their models, and the devices that models and worlds give them.
namespace sim::io {

/// "did you mean ...?" with the known word that is nearest to `word`; empty if none is near.
[[nodiscard]] std::string did_you_mean(const std::string& word,
                                       const std::vector<std::string>& known);

/// A model's devices; devices without settings get their type's defaults. A type that is not in
/// `types` is an issue at `place`.
[[nodiscard]] std::vector<DeviceDescription> default_devices(Reader& place, const RobotModel& model,
                                                             const std::vector<DeviceType>& types);

/// Reads the member "devices" of a robot or model.
/// @param base  the inherited devices; null in the file removes one, settings change it.
/// @return sorted by name.
[[nodiscard]] std::vector<DeviceDescription> read_devices(Reader& owner,
                                                          std::vector<DeviceDescription> base,
                                                          const std::vector<DeviceType>& types);

/// Whether an entry of a robot's "drivers" is a device of libsim (amcl), which computes a reading
/// from those of other devices.
[[nodiscard]] bool is_driver_device(Reader& driver);
/// Adds the device of such an entry. Its settings are those of the device, and its name is the
/// type.
void read_driver_device(Reader& driver, std::vector<DeviceDescription>& devices,
                        const std::vector<DeviceType>& types);

/// Reads the member "interfaces" of a robot or model: the order of devices for each interface.
/// Whether a device provides the interface is not checked here; the client library knows that.
/// @param base  the order for interfaces that the member does not list; devices that do not exist
///     are removed from it.
[[nodiscard]] std::map<std::string, std::vector<std::string>> read_interfaces(
    Reader& owner, const std::vector<DeviceDescription>& devices,
    const std::map<std::string, std::vector<std::string>>& base);

/// Reads the model that a robot of a world names. It is one of shipped_models(), or a file relative
/// to the folder of the world's file if the name has a '/' or ends in ".json".
/// @param robot  the robot in the world's file; an unknown or unreadable model is an issue at its
///     "model".
/// @param world  receives the issues of the model's file, with that file's name and lines.
/// @return nullopt if the model is invalid.
[[nodiscard]] std::optional<RobotModel> read_model(Reader& robot, const std::string& name,
                                                   Reader::Document& world,
                                                   const std::vector<DeviceType>& types);

}  // namespace sim::io
