// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include "sim/io/world_io.h"

namespace sim::io {

/// A world of Stage as files of Playpen.
struct ImportedWorld {
  std::string world;                         ///< JSON: a world file
  std::map<std::string, std::string> files;  ///< name -> content, beside the world file: robot
                                             ///< models and pictures of maps
  std::vector<std::string> notes;  ///< "FILE:LINE: TEXT": what was left out or means something else
};

/// Translates a world file of Stage 3 or 4 (docs/coming_from_stage.md).
///
/// read_world() reads such a file in the same way, so both give the same world.
/// @param path    a world file, or a configuration file of Player that names one.
/// @param config  a configuration file of Player for the world; "": the one in the same folder
/// whose
///     `worldfile` is the world, if there is one.
/// @throws ConfigError with the places in the user's files.
[[nodiscard]] ImportedWorld import_stage_world(const std::string& path, const std::string& config,
                                               const std::vector<DeviceType>& device_types);

}  // namespace sim::io
