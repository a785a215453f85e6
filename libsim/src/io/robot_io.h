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

/// What is read of robots: their models, and the devices that models and worlds give them.
namespace sim::io {

/// "did you mean ...?" with the known word nearest to `word`; empty if none is near.
[[nodiscard]] std::string did_you_mean(const std::string& word,
                                       const std::vector<std::string>& known);

/// A model's devices, those without settings with their type's defaults. A type that is not among
/// `types` is an issue at `place`.
[[nodiscard]] std::vector<DeviceDescription> default_devices(Reader& place, const RobotModel& model,
                                                             const std::vector<DeviceType>& types);

/// Reads the member "devices" of a robot or model.
/// @param base  the devices that there are without it; null removes one, settings change it.
/// @return in order of name.
[[nodiscard]] std::vector<DeviceDescription> read_devices(Reader& owner,
                                                          std::vector<DeviceDescription> base,
                                                          const std::vector<DeviceType>& types);

/// Reads the member "interfaces" of a robot or model: which device has which index. Whether it has
/// the interface at all is for clients' libraries to know.
/// @param base  what holds for interfaces that are not named; devices that there are not are left
///              out of it.
[[nodiscard]] std::map<std::string, std::vector<std::string>> read_interfaces(
    Reader& owner, const std::vector<DeviceDescription>& devices,
    const std::map<std::string, std::vector<std::string>>& base);

/// Reads the model that a robot of a world names: one of shipped_models(), or, if the name has a
/// '/' or ends in ".json", a file, relative to the folder of the world's file.
/// @param robot  of the world's file; an unknown or unreadable model is an issue at its "model".
/// @param world  issues of the model's file are added here, with that file and its lines.
/// @return nullopt if it is not sound.
[[nodiscard]] std::optional<RobotModel> read_model(Reader& robot, const std::string& name,
                                                   Reader::Document& world,
                                                   const std::vector<DeviceType>& types);

}  // namespace sim::io
