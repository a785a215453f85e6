// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "grade/trajectory.h"
#include "playerlike/host/report.h"
#include "sim/simulation/scene_snapshot.h"
#include "sim/world/description.h"

/// The data that `playpen plot` reads from result folders.
namespace playpen {

/// The trajectory of a robot, with what the charts show besides. All lists have one value per row
/// of trajectory.csv.
struct Track : grade::Trajectory {
  std::vector<double> path_m;  ///< length of the path so far
  /// Distance to the nearest solid object; empty if the world is unknown.
  std::vector<double> clearance_m;
};

/// A moment of a robot that the charts mark.
struct Moment {
  int robot = 0;  ///< index into RunData::tracks
  double time_s = 0.0;
};

/// A run, read from its result folder.
struct RunData {
  std::string folder;
  std::string world_name;
  playerlike::Report report;                   ///< its report.json
  std::optional<sim::WorldDescription> world;  ///< none: `world_problem` gives the reason
  std::string world_problem;                   ///< why the world is unknown
  std::vector<Track> tracks;                   ///< in the order of trajectory.csv
  std::vector<sim::CollisionMark> collisions;  ///< robots are indices into `tracks`
  std::vector<sim::GoalMark> goals;            ///< robots are indices into `tracks`
  std::vector<Moment> reached;                 ///< when goals were reached
  std::optional<bool> passed;                  ///< verdict of the grading; none: not graded
  std::vector<std::string> faults;             ///< why it has not passed
};

/// The folders of runs that a folder of the user means: the folder itself, or the runs of a folder
/// of `playpen grade`, in the order of grade.json.
/// @param skipped  gets those runs of a grade that have no results to plot.
/// @throws std::runtime_error for an unusable grade.json, or if no run of the grade has results.
[[nodiscard]] std::vector<std::string> run_folders(const std::string& folder,
                                                   std::vector<std::string>& skipped);

/// Reads trajectory.csv and report.json from a result folder, and the world that the report names.
/// A run of `playpen grade`, `playpen class` or `playpen batch` also gets the verdict and, as a
/// goal of the graded robot, the goal of the task.
/// @throws std::runtime_error naming the file or folder, the expected content and the actual
///         content.
[[nodiscard]] RunData read_run(const std::string& folder);

/// Computes the distance of each robot's body to the nearest solid object and stores it in
/// `clearance_m`. Obstacles have their initial poses; other robots have their poses at that time.
/// Does nothing if the run has no world.
void measure_clearances(RunData& run);

}  // namespace playpen
