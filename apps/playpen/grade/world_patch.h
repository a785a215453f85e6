// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "sim/world/description.h"

namespace playpen::grade {

/// Where a robot starts, in the numbers of a world file.
struct StartPose {
  double x_m = 0.0;
  double y_m = 0.0;
  int yaw_deg = 0;

  [[nodiscard]] sim::Vec2 position() const { return {x_m, y_m}; }
};

/// A value in a world file.
struct WorldValue {
  std::string pointer;  ///< JSON pointer of its place (RFC 6901), "/robots/0/pose/x"
  std::string value;    ///< as JSON
};

/// What patched_world() changes.
struct WorldPatch {
  std::size_t robot = 0;           ///< index of the robot that `start` is for
  std::optional<StartPose> start;  ///< none: as in the world
  /// Names of the extended dynamic obstacles; the others are retracted. None: as in the world.
  std::optional<std::set<std::string>> extended;
  std::vector<WorldValue> values = {};  ///< set at last, in this order
};

/// A world file in JSON.
struct JsonWorld {
  std::string text;
  sim::WorldDescription description;
};

/// Reads a world file in order to change it.
/// @param file     path; "" for the default world.
/// @param purpose  why it must be one in JSON, for the message.
/// @throws sim::ConfigError as sim::load_world() does; task/world-of-stage if it is no JSON.
[[nodiscard]] JsonWorld read_json_world(const std::string& file, const char* purpose);

/// The text of a world file with another start and other blocks. The text is complete: names of
/// other files in it are absolute, so it can be written to any folder. It loads as the same world
/// but for the changes and the names of files of robot models; comments are lost.
/// @param text   of a world file in JSON that is valid.
/// @param world  what this text describes. Its member `file` gives the folder of the other files.
/// @throws std::exception if the text is not JSON; sim::ConfigError plan/parameter for the pointer
///         of a value that leads nowhere. A missing member of an object is added.
[[nodiscard]] std::string patched_world(const std::string& text, const sim::WorldDescription& world,
                                        const WorldPatch& patch);

}  // namespace playpen::grade
