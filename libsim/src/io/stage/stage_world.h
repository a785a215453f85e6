// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "sim/io/world_io.h"

namespace sim::io {

/// Whether a file is one of Stage's or Player's, judged by its extension and its first character.
[[nodiscard]] bool is_stage_file(const std::string& path, std::string_view text);

namespace stage {

/// Reads a world file of Stage, or a configuration file of Player that names one.
/// @throws ConfigError with the places in the user's files.
[[nodiscard]] WorldDescription read_world(const std::string& path, const std::string& text,
                                          const std::vector<DeviceType>& types);

}  // namespace stage
}  // namespace sim::io
