// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "grade/evaluation.h"
#include "grade/report.h"
#include "grade/task.h"
#include "playerlike/host/program.h"

namespace playpen::grade {

/// What is to be graded, and how.
struct GradeSettings {
  Task task;                         ///< its worlds and seeds are those that are run
  std::vector<std::string> program;  ///< path (see playerlike::find_program()) and arguments
  int jobs = 1;                      ///< programs that run side by side, >= 1
  std::string output_folder;         ///< gets a folder WORLD_seedN for each run
  /// Of virtual time (docs/virtual_time.md): what preloads its library; empty: sleeps are real.
  playerlike::EnvironmentChanges virtual_time;
};

/// How far a grading is.
struct Progress {
  std::size_t runs = 0;
  std::size_t running = 0;
  std::size_t ended = 0;
};

/// Puts the worlds that a user named in the place of the task's: those that the task has keep what
/// it says of them, others get what holds for all.
/// @param files  paths; "" is the default world.
/// @throws sim::ConfigError if two have the same name (see world_name()).
void choose_worlds(Task& task, const std::vector<std::string>& files);

/// Runs a program on each world of a task with each seed and judges the runs. Whatever the program
/// does is a result.
///
/// A run has its own output folder, WORLD_seedN, with the usual files of a run and what the
/// program printed in program.log; results of an earlier grading are taken out of it first. While
/// it runs, its output folder lies in another one, .running-N; what is in it is moved, and judged,
/// when all processes of the run are gone.
///
/// @param on_progress  called at first, and whenever a run starts or ends, with what is known by
///                     then, if set.
/// @return all runs, also if this process was told to end meanwhile.
/// @throws sim::ConfigError for a world that can't be used or does not go with the task,
///         playerlike::ProgramError if the program can't be started, std::exception if an output
///         folder can't be prepared.
/// @note For a command's main thread, see playerlike::run_programs().
[[nodiscard]] Grade grade(
    const GradeSettings& settings,
    const std::function<void(const Progress&, const Grade&)>& on_progress = {});

}  // namespace playpen::grade
