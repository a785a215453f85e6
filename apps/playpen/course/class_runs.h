// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "course/build.h"
#include "course/class_result.h"
#include "course/submission.h"
#include "grade/task.h"
#include "playerlike/host/program.h"
#include "sim/world/description.h"

namespace playpen::course {

/// Settings of the grading of a class.
struct ClassSettings {
  std::vector<grade::Task> tasks;       ///< at least one, with different names
  std::vector<Submission> submissions;  ///< see find_submissions()
  std::vector<Submission> baselines;    ///< programs that everybody knows, such as the template
  std::string output_folder;
  std::string version;  ///< of Playpen
  int jobs = 1;         ///< processes that run side by side, >= 1
  BuildSettings build;
  std::optional<sim::Realism> realism;  ///< empty: that of each world
  bool individual = false;              ///< whether each submission has conditions of its own
  bool isolated = true;                 ///< whether the launchers make sandboxes
  playerlike::EnvironmentChanges environment;  ///< of the programs, besides what the run needs
  /// Words before a program that runs it in a sandbox; no words: none.
  /// @param task    that it runs on.
  /// @param source  the folder of the submission's sources, which the program may read.
  std::function<std::vector<std::string>(const grade::Task& task, const std::string& source)>
      launcher;
};

/// What is being done.
struct ClassProgress {
  enum class Step { kBuild, kRun };
  Step step = Step::kBuild;
  std::string task;     ///< of the runs
  std::size_t all = 0;  ///< what has to be done in this step, without what was done earlier
  std::size_t ended = 0;
  std::size_t running = 0;
  std::size_t known = 0;  ///< what an earlier call has done
};

/// Compiles and grades all submissions. Whatever they do gives a result.
///
/// What is done is not done again: the results of a build and of each run are kept in the output
/// folder with the fingerprint of all that they depend on (docs/class.md). So this function can be
/// called again after it was interrupted or killed.
///
/// @param on_progress  called at the start of a step, and whenever a process starts or ends.
/// @throws sim::ConfigError for a world that can't be used or does not match its task,
///         std::exception if a folder or file of the output can't be written.
/// @note Call it from a command's main thread, see playerlike::run_programs().
[[nodiscard]] ClassResult grade_class(
    const ClassSettings& settings,
    const std::function<void(const ClassProgress&)>& on_progress = {});

}  // namespace playpen::course
