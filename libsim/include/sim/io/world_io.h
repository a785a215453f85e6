// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <any>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/io/reader.h"
#include "sim/world/description.h"
#include "sim/world/robot_model.h"

namespace sim::io {

/// What the reader must know of a kind of device: its name, and how its settings are read.
/// The table of all kinds is sim::device_types() (sim/devices/builtin.h); io is handed it, since
/// arrows run from devices to io.
struct DeviceType {
  std::string name;
  /// Reads the settings object (keys left out keep `defaults`), checks ranges.
  std::function<std::any(Reader& settings, const std::any& defaults)> parse;
  std::function<std::any()> defaults;
};

/// Reads a world file. Relative names in it (maps, files of robot models) are relative to its
/// folder. The models that its robots name end up in WorldDescription::models, but for the
/// library's own.
/// @throws ConfigError with every issue found: unreadable file, JSON syntax (with line and
///         column), trailing garbage, nesting over 32 levels, unknown keys, wrong types, values
///         out of range, duplicate names or ports, robots that overlap walls or one another.
///         Every setting is looked at, however many are wrong; only broken JSON ends the reading.
[[nodiscard]] WorldDescription read_world(const std::string& path,
                                          const std::vector<DeviceType>& device_types);

/// As read_world, from text; `file` is what messages call it and whose folder maps lie in
/// ("<memory>" for text that comes from no file: the current folder). "{}" is the default world:
/// the SyRoTek arena with one S1R.
[[nodiscard]] WorldDescription read_world_text(std::string_view text, const std::string& file,
                                               const std::vector<DeviceType>& device_types);

/// Reads the file of a robot model (docs/robot_models.md).
/// @throws ConfigError with every issue found, as read_world().
[[nodiscard]] RobotModel read_robot_model(const std::string& path,
                                          const std::vector<DeviceType>& device_types);

/// Issues that no single value shows: duplicate names or ports, poses off the floor, robots that
/// overlap obstacles, walls or one another. Empty if the world is sound.
[[nodiscard]] std::vector<ConfigIssue> check_world(const WorldDescription& world);

}  // namespace sim::io
