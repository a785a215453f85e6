// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/core/pose.h"

/// Grading of client programs: what `playpen grade` does, behind its arguments.
namespace playpen::grade {

/// Where a robot is to be when its run is over.
struct Goal {
  sim::Vec2 position = sim::Vec2::Zero();  ///< of the axle's centre in W [m]
  std::optional<double> yaw_rad;           ///< heading in W; none: any will do
  double tolerance_m = 0.1;                ///< greatest distance from `position` [m], > 0
  double yaw_tolerance_rad = 0.2618;       ///< greatest turn from `yaw_rad` [rad], > 0; 15 degrees
};

/// What a run must be like to pass. What is left out is not judged.
struct Thresholds {
  std::optional<double> min_coverage;        ///< of the reachable floor, 0..1
  std::optional<double> min_correctness;     ///< of the map, 0..1
  std::optional<int> max_collisions;         ///< >= 0
  std::optional<double> min_clearance_m;     ///< of the robot's outline from anything solid [m]
  std::optional<double> min_path_length_m;   ///< [m]
  std::optional<double> max_path_length_m;   ///< [m]
  std::optional<double> max_path_ratio;      ///< path length to the shortest possible one, >= 1
  std::optional<double> max_sim_time_s;      ///< [s]
  std::optional<double> max_stalled_time_s;  ///< [s]
  bool must_reach = false;                   ///< the goal
  bool must_end = false;                     ///< by itself, before the simulated time is over
};

/// A world of a task, and what is particular to it.
struct TaskWorld {
  std::string file;                    ///< a path; "": the default world
  std::vector<std::string> arguments;  ///< for the program, after those of the task
  std::optional<Goal> goal;            ///< instead of the task's
};

/// A task, as its file describes it.
struct Task {
  std::string name;  ///< the file's name without .task.json
  std::string file;  ///< where it was read from
  std::string description;
  std::vector<TaskWorld> worlds;  ///< at least one, their names without folders all different
  std::vector<std::uint64_t> seeds{1, 2, 3, 4, 5};  ///< at least one, all different
  std::optional<double> duration_s;  ///< simulated limit; none: that of the world [s]
  double timeout_s = 120.0;          ///< limit of wall time [s]
  std::vector<std::string> arguments;
  std::optional<Goal> goal;
  std::string robot;      ///< name of the robot that is judged; "": the world's first
  std::string map_layer;  ///< name of the layer that holds the program's map; "": none
  Thresholds thresholds;
};

/// What the names of task files end in.
inline constexpr std::string_view kTaskSuffix = ".task.json";

/// A name that stands for a world in tables and folders: that of its file without folder and
/// ending; "default" for "".
[[nodiscard]] std::string world_name(const std::string& world_file);

/// Reads a task file. Names of worlds in it are relative to its folder.
/// @throws sim::ConfigError with every issue of the file (docs/errors.md).
[[nodiscard]] Task read_task(const std::string& path);

/// As read_task(), from text; `file` is what messages call it and whose folder worlds lie in.
[[nodiscard]] Task read_task_text(std::string_view text, const std::string& file);

}  // namespace playpen::grade
