// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim/core/pose.h"
#include "sim/simulation/scene_snapshot.h"
#include "sim/world/description.h"

/// What `playpen plot` reads from the folders of runs.
namespace playpen {

/// A robot's way through a run: lists of one length, a value for each row of trajectory.csv.
struct Track {
  std::string robot;
  std::vector<double> time_s;
  std::vector<sim::Pose> X_WB;
  std::vector<double> v_mps;
  std::vector<double> omega_radps;
  std::vector<double> path_m;       ///< length of the way so far
  std::vector<double> clearance_m;  ///< to anything solid; empty: the world is not known
};

/// A run, by its folder.
struct RunData {
  std::string folder;
  std::string world_name;
  std::optional<sim::WorldDescription> world;  ///< none: see `world_problem`
  std::string world_problem;                   ///< why the world is not known
  std::vector<Track> tracks;                   ///< in the order of trajectory.csv
  std::vector<sim::CollisionMark> collisions;  ///< robots are indexes of `tracks`
  std::vector<sim::GoalMark> goals;            ///< likewise
};

/// Reads trajectory.csv and report.json of a run's folder, and the world that the report names.
/// @throws std::runtime_error naming the file or folder, what was expected and what was found.
[[nodiscard]] RunData read_run(const std::string& folder);

/// Distances of the robots' bodies to everything solid, into the tracks' `clearance_m`. Obstacles
/// count as they are at the start, other robots where they are at the time. Does nothing without a
/// world.
void measure_clearances(RunData& run);

}  // namespace playpen
