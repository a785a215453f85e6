// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "batch/units.h"
#include "grade/evaluation.h"
#include "playerlike/host/program.h"

namespace playpen::batch {

/// How a process runs units.
struct UnitRunSettings {
  std::filesystem::path out;                   ///< folder of the batch
  int jobs = 1;                                ///< programs that run side by side, >= 1
  playerlike::EnvironmentChanges environment;  ///< of the programs, besides what the run needs
  /// Words before a program that runs it in a sandbox; no words: none.
  std::function<std::vector<std::string>(const Condition& condition)> launcher;
};

/// What has been done.
struct UnitProgress {
  std::size_t all = 0;    ///< units to run
  std::size_t ended = 0;  ///< of them
  std::size_t known = 0;  ///< units that had results before
};

/// The folder of a unit's results: OUT/units/ID. It appears with all of its content, when the unit
/// has run.
[[nodiscard]] std::filesystem::path folder_of(const std::filesystem::path& out, const Unit& unit);

/// The results of a unit; nullopt: it has not run.
[[nodiscard]] std::optional<grade::GradedRun> read_unit(const std::filesystem::path& out,
                                                        const Unit& unit);

/// Removes the results of a unit, so that it runs again.
void forget_unit(const std::filesystem::path& out, const Unit& unit);

/// Runs units that have no results yet.
///
/// Any number of processes on any number of machines may do so at once, in a folder that they
/// share, also with the same units: each has a folder of its own, HOST-PROCESS in the folder
/// "work", and the first that ends a unit gives it its results. A process that is killed leaves
/// nothing but its folder, which the next one on that machine removes.
///
/// @param units  indices into Batch::units.
/// @param on_progress  called at the start, and whenever a run ends.
/// @return whether all have results; false: a signal told this process to end.
/// @throws sim::ConfigError for a world that can't be used or does not match the task,
///         playerlike::ProgramError if a program can't be started, std::exception if a folder or
///         file can't be written.
/// @note Call it from a command's main thread, see playerlike::run_programs().
[[nodiscard]] bool run_units(const Batch& batch, const std::vector<std::size_t>& units,
                             const UnitRunSettings& settings,
                             const std::function<void(const UnitProgress&)>& on_progress = {});

}  // namespace playpen::batch
