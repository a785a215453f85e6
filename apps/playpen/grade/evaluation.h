// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "grade/task.h"
#include "playerlike/host/grading.h"
#include "playerlike/host/program.h"
#include "sim/core/pose.h"
#include "sim/world/description.h"
#include "sim/world/occupancy_map.h"

namespace playpen::grade {

/// What a run of a task on one world is measured against.
struct Reference {
  std::string world_file;
  std::string world;  ///< see world_name()
  std::string robot;  ///< the robot that is judged
  sim::Vec2 start = sim::Vec2::Zero();
  std::optional<double> duration_s;  ///< simulated limit [s]
  std::optional<Goal> goal;
  std::optional<double> shortest_path_m;  ///< from start to goal; none without a goal
  sim::OccupancyMap truth;                ///< empty unless the task names a map
};

/// Prepares what does not depend on the program: the true map, the shortest way to the goal.
///
/// The way is that of the robot's middle on the true map (kTruthCell_m) inflated by the radius
/// of the largest circle round the middle of its axle that lies within its outline.
///
/// @throws sim::ConfigError if the task does not go with the world: no robot of that name, a goal
///         that is not there though the thresholds need one, or that can't be reached.
[[nodiscard]] Reference make_reference(const Task& task, const TaskWorld& task_world,
                                       const sim::WorldDescription& world);

/// What was found out about a run; what is missing could not be.
struct Measures {
  std::optional<bool> reached;            ///< whether the goal was; none without a goal
  std::optional<double> goal_distance_m;  ///< from the goal, at the end [m]
  std::optional<double> coverage;         ///< see MapScore
  std::optional<double> correctness;      ///< see MapScore
  std::optional<double> path_length_m;    ///< the way that was driven [m]
  std::optional<double> shortest_path_m;  ///< that could have been [m]
  std::optional<double> path_ratio;       ///< their quotient, if the goal was reached
  std::optional<int> collisions;
  std::optional<double> least_clearance_m;
  std::optional<double> stalled_time_s;
  std::optional<double> sim_time_s;
};

/// What a program may write into its output folder: bytes of all files together.
inline constexpr std::uint64_t kMostOutput = 250'000'000;

/// How a run ended.
enum class Ending {
  kBySelf,         ///< with status 0, before the simulated time was over
  kTimeOver,       ///< with status 0, as the simulated time was over
  kBadStatus,      ///< by itself, with another status
  kSignal,         ///< a signal ended it: it crashed, or was killed
  kTimedOut,       ///< it took too long by the clock on the wall
  kTooMuchOutput,  ///< it wrote too much into its output folder
  kInterrupted,    ///< the grader was told to end
  kNotRun,         ///< the grader was told to end before
};

/// A word for an ending, as the JSON file has it: "by-itself", "time-over", "bad-status", "signal",
/// "timeout", "too-much-output", "interrupted", "not-run".
[[nodiscard]] std::string name_of(Ending ending);

/// A run and what it is worth.
struct GradedRun {
  std::string world;
  std::uint64_t seed = 0;
  std::string folder;  ///< with its results, in the grader's output folder
  Ending ending = Ending::kNotRun;
  playerlike::Grading asked;  ///< what the report must be of
  int status = 0;             ///< of the program, with kBadStatus
  std::optional<int> signal;  ///< with kSignal
  Measures measures;
  std::vector<std::string> faults;  ///< why it does not pass, a sentence each; none: it passes
  double wall_time_s = 0.0;

  [[nodiscard]] bool passed() const noexcept { return faults.empty(); }
};

/// Judges a run by what it left in its output folder. Whatever the program has done, and whatever
/// is in its files, this is a result and no error.
/// @param run  with world, seed, folder and what is asked for; the rest is filled in.
void evaluate(const Task& task, const Reference& reference, const playerlike::JobEnd& end,
              const std::filesystem::path& folder, GradedRun& run);

/// The faults that thresholds find in measures: "3 collisions, at most 0 allowed".
[[nodiscard]] std::vector<std::string> faults_of(const Thresholds& thresholds,
                                                 const Measures& measures, Ending ending);

}  // namespace playpen::grade
