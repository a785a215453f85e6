// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "grade/task.h"
#include "sim/core/pose.h"

/// Individual conditions: worlds of equal difficulty with other numbers, for each student
/// (docs/grading.md).
namespace playpen::grade {

/// Limits of "equal difficulty".
struct DifficultyLimits {
  /// Greatest relative difference of the length of the shortest path to the goal.
  static constexpr double kPath = 0.1;
  /// Greatest relative difference of the floor that the robot's centre can reach: no room is shut
  /// or open that is not so in the task.
  static constexpr double kFloor = 0.02;
  /// In a world with a controller, greatest length of the path between the two starts [m].
  static constexpr double kBesideStart_m = 0.3;
  /// The least distance of the axle's centre from solids is that of the task's start, but it need
  /// not be more than the radius that the robot needs to turn on the spot, and this [m].
  static constexpr double kTurning_m = 0.05;
  /// Likewise, the distance from another robot need not be more than this [m].
  static constexpr double kFromRobots_m = 0.5;
};

/// A world of a task as one student gets it.
struct IndividualWorld {
  std::string text;  ///< a complete world file; names of other files in it are absolute
  sim::Pose start;   ///< of the judged robot
  std::set<std::string>
      extended;                 ///< names of the dynamic obstacles that are extended at the start
  bool has_own_start = false;   ///< false: no other start was found; the start is the task's
  bool has_own_blocks = false;  ///< false: the blocks are the task's
  /// For the student: "par_intro: start at (0.45, 1.20), heading 90 degrees".
  std::string sentence;
};

/// Derives a student's world from a world of a task: another start of the judged robot and, if the
/// world has no controller, another choice of as many extended blocks.
///
/// The difficulty is equal within DifficultyLimits:
/// - with a goal, the length of the shortest path to it (see make_reference()) is;
/// - the area that the robot's centre can reach is;
/// - in a world with a controller, the start is close to the task's and in no other trap, and the
///   blocks are the task's, because timers and traps depend on them;
/// - the distances from solids and from other robots are at least those limits, so that the robot
///   can turn on the spot.
///
/// Starts are drawn at random and rejected until one fits. Equal arguments give equal results.
/// @param student  any text that is unique in the class.
/// @throws sim::ConfigError if the world cannot be used, does not match the task (as
///     make_reference()), or is not a file in JSON ("task/world-of-stage").
[[nodiscard]] IndividualWorld individual_world(const Task& task, const TaskWorld& world,
                                               std::string_view student);

/// The seeds of a student's runs: as many as the task's, all different, from 1 to 999999999. Equal
/// arguments give equal seeds.
[[nodiscard]] std::vector<std::uint64_t> individual_seeds(const Task& task,
                                                          std::string_view student);

/// A task as one student gets it.
struct IndividualTask {
  Task task;  ///< with the student's worlds and seeds
  /// For the student: one sentence for each world, and one for the seeds.
  std::vector<std::string> sentences;
};

/// Writes a student's worlds into a folder, which is made if needed, as WORLD.json.
/// @throws as individual_world(); std::runtime_error if a file cannot be written.
[[nodiscard]] IndividualTask individual_task(const Task& task, std::string_view student,
                                             const std::string& folder);

}  // namespace playpen::grade
