// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include "io/stage/draft.h"
#include "io/stage/entity.h"
#include "io/stage/report.h"

namespace sim::io::stage {

/// A world of Stage as a world file of Playpen, with the files that it names.
struct Translation {
  Json world;
  std::map<std::string, std::string> files;  ///< name -> content: robot models, pictures of maps
  std::map<std::string, Place> places;  ///< JSON pointer, or name of a file -> where it is from
  std::vector<RobotDraft> robots;       ///< in the order of world["robots"]
};

/// Translates the models of a world file. Robots have no ports yet; apply_player_file() gives them
/// ports and indexes.
/// @param name  of the world if the file has none.
[[nodiscard]] Translation translate(const Entity& root, const std::string& name, Report& report);

/// Applies a configuration file of Player: ports, indexes of interfaces, drivers.
/// @param must_match  whether models that the world lacks are errors.
void apply_player_file(const Entity& config, bool must_match, Translation& translation,
                       Report& report);

/// Completes the robots and moves them to world["robots"].
void finish_robots(Translation& translation);

}  // namespace sim::io::stage
