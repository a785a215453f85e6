// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "grade/rubric.h"
#include "playerlike/host/task_rules.h"
#include "sim/core/pose.h"
#include "sim/world/fuzz.h"

/// The implementation of `playpen grade`, without argument parsing.
namespace playpen::grade {

/// Where a robot must be when its run ends.
struct Goal {
  sim::Vec2 position = sim::Vec2::Zero();  ///< of the axle's centre in W [m]
  std::optional<double> yaw_rad;           ///< heading in W; none: any heading
  double tolerance_m = 0.1;                ///< maximum distance from `position` [m], > 0
  double yaw_tolerance_rad = 0.2618;       ///< maximum angle from `yaw_rad` [rad], > 0; 15 degrees
};

/// Conditions for passing. Missing ones are not checked.
struct Thresholds {
  std::optional<double> min_coverage;         ///< of the reachable floor, 0..1
  std::optional<double> min_correctness;      ///< of the map, 0..1
  std::optional<int> max_collisions;          ///< >= 0
  std::optional<double> min_clearance_m;      ///< of the robot's outline from anything solid [m]
  std::optional<double> min_path_length_m;    ///< [m]
  std::optional<double> max_path_length_m;    ///< [m]
  std::optional<double> min_distance_m;       ///< between places, without movements on the spot [m]
  std::optional<double> min_visited_area_m2;  ///< of the floor that the robot has been on [m^2]
  std::optional<double> max_path_ratio;  ///< driven length to the shortest possible length, >= 1
  std::optional<double> max_sim_time_s;  ///< [s]
  std::optional<double> max_stalled_time_s;  ///< [s]
  bool must_reach = false;                   ///< the robot must reach the goal
  bool must_end = false;            ///< the program must end before the simulated time is over
  std::optional<double> min_score;  ///< points of the robot from the world's controller
  bool must_pass = false;           ///< the controller must end the run with the verdict "passed"
};

/// A world of a task, and its own settings.
struct TaskWorld {
  std::string file;  ///< path of the file; "": the default world
  /// additional arguments for the program, after those of the task
  std::vector<std::string> arguments;
  std::optional<Goal> goal;  ///< instead of the task's
};

/// A task, as described by its file.
struct Task {
  std::string name;  ///< the file's name without .task.json
  std::string file;  ///< path of the file
  std::string description;
  std::vector<TaskWorld> worlds;  ///< at least one; their names without folders differ
  std::vector<std::uint64_t> seeds{1, 2, 3, 4, 5};  ///< at least one, all different
  std::optional<double> duration_s;  ///< simulated limit; none: that of the world [s]
  double timeout_s = 120.0;          ///< wall-clock limit [s]
  std::vector<std::string> arguments;
  std::optional<Goal> goal;
  std::string robot;      ///< name of the robot that is graded; "": the world's first
  std::string map_layer;  ///< name of the layer that holds the program's map; "": none
  /// What the program may use; none: everything. Its robots are those named by the file, or none:
  /// the graded robot.
  std::optional<playerlike::MayUse> may_use;
  Thresholds thresholds;
  std::vector<RubricItem> rubric;  ///< empty: none, see rubric_of()
};

/// Suffix of task files.
inline constexpr std::string_view kTaskSuffix = ".task.json";

/// The name of a world in tables and folders: the name of its file without folder and extension;
/// "default" for "".
[[nodiscard]] std::string world_name(const std::string& world_file);

/// Reads a task file. Names of worlds in it are relative to its folder.
/// @throws sim::ConfigError with every issue of the file (docs/errors.md).
[[nodiscard]] Task read_task(const std::string& path);

/// Reads the section "fuzz" of a task file into that of its world: the task's keys replace the
/// world's. @throws sim::ConfigError as read_task().
void read_fuzz(const std::string& path, sim::FuzzDescription& fuzz);

/// Reads a task from text. `file` is the name in messages; worlds are relative to its folder.
[[nodiscard]] Task read_task_text(std::string_view text, const std::string& file);

}  // namespace playpen::grade
