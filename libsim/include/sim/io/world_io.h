// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <any>
#include <string>
#include <string_view>
#include <vector>

#include "sim/io/reader.h"
#include "sim/world/description.h"
#include "sim/world/robot_model.h"

namespace sim::io {

/// What the reader needs to know about a device type: its name and how to read its settings. The
/// table of all types is sim::device_types() (sim/devices/builtin.h). It is passed to io as an
/// argument, because io must not depend on devices.
struct DeviceType {
  std::string name;
  /// Reads and checks the settings object; missing keys keep the values of `defaults`.
  std::any (*parse)(Reader& settings, const std::any& defaults) = nullptr;
  std::any (*defaults)() = nullptr;
};

/// Reads a world file. Relative names in it (maps, files of robot models) are relative to its
/// folder. The models that its robots name are stored in WorldDescription::models, except the
/// built-in one.
/// @throws ConfigError with every issue found: unreadable file, JSON syntax (with line and column),
///     trailing garbage, nesting over 32 levels, unknown keys, wrong types, values out of range,
///     duplicate names or ports, robots that overlap walls or one another. Every setting is
///     checked, however many are wrong; only a JSON syntax error ends the reading.
[[nodiscard]] WorldDescription read_world(const std::string& path,
                                          const std::vector<DeviceType>& device_types);

/// Like read_world, from text. `file` is its name in messages, and its folder is the one that map
/// names are relative to ("<memory>" for text without a file: the current folder). "{}" is the
/// default world: the SyRoTek arena with one S1R.
[[nodiscard]] WorldDescription read_world_text(std::string_view text, const std::string& file,
                                               const std::vector<DeviceType>& device_types);

/// Reads the file of a robot model (docs/robot_models.md).
/// @throws ConfigError with every issue found, like read_world().
[[nodiscard]] RobotModel read_robot_model(const std::string& path,
                                          const std::vector<DeviceType>& device_types);

/// Checks the combination of values: duplicate names or ports, poses off the floor, robots that
/// overlap obstacles, walls or one another. Empty if the world is valid.
[[nodiscard]] std::vector<ConfigIssue> check_world(const WorldDescription& world);

}  // namespace sim::io
