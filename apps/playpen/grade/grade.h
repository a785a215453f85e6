// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "grade/evaluation.h"
#include "grade/report.h"
#include "grade/task.h"
#include "playerlike/host/program.h"

namespace playpen::grade {

/// Settings of a grading.
struct GradeSettings {
  Task task;                            ///< its worlds and seeds are run
  std::vector<std::string> program;     ///< path (see playerlike::find_program()) and arguments
  int jobs = 1;                         ///< number of programs that run in parallel, >= 1
  std::string output_folder;            ///< gets a folder WORLD_seedN for each run
  std::optional<sim::Realism> realism;  ///< level of realism; empty: that of each world
  bool virtual_time = true;             ///< false: sleeps are real (docs/virtual_time.md)
  /// What programs need for virtual time and to find libraries, besides what the run needs.
  playerlike::EnvironmentChanges environment = {};
  std::string working_folder = {};  ///< of the programs; "": that of this process
  /// Words before the program: a command that runs it in a sandbox; empty: none.
  std::vector<std::string> launcher = {};
};

/// Progress of a grading.
struct Progress {
  std::size_t runs = 0;
  std::size_t running = 0;
  std::size_t ended = 0;
};

/// Replaces the task's worlds by those that the user named. Worlds that the task contains keep the
/// task's settings for them; other worlds get the settings for all worlds.
/// @param files  paths; "" is the default world.
/// @throws sim::ConfigError if two have the same name (see world_name()).
void choose_worlds(Task& task, const std::vector<std::string>& files);

/// Runs a program on each world of a task with each seed and grades the runs. Whatever the program
/// does gives a result.
///
/// Each run has its own output folder, WORLD_seedN, with the usual files of a run and the program's
/// output in program.log. Results of an earlier grading are removed from it first. During the run,
/// the output folder is inside another one, .running-N. When all processes of the run have ended,
/// the grader moves its content and grades it.
///
/// @param on_progress  called at the start, and whenever a run starts or ends, with the current
///        progress, if set.
/// @return all runs, also if this process was told to stop meanwhile.
/// @throws sim::ConfigError for a world that can't be used or does not match the task,
///         playerlike::ProgramError if the program can't be started, std::exception if an output
///         folder can't be prepared.
/// @note Call it from a command's main thread, see playerlike::run_programs().
[[nodiscard]] Grade grade(
    const GradeSettings& settings,
    const std::function<void(const Progress&, const Grade&)>& on_progress = {});

}  // namespace playpen::grade
