// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "grade/trajectory.h"
#include "playerlike/host/prepared_program.h"
#include "playerlike/host/report.h"

namespace playpen::fuzz {

/// How programs are run.
struct RunnerSettings {
  std::vector<std::string> program;            ///< path and arguments
  playerlike::EnvironmentChanges environment;  ///< beside that of the runs
  std::filesystem::path folder;                ///< for files of the runs; exists
  std::size_t jobs = 1;                        ///< programs that run side by side, >= 1
  double duration_s = 30.0;                    ///< simulated, of each run [s]
  double limit_s = 20.0;  ///< processor time of each run; beyond it hangs. Also if it waits for as
                          ///< long by the wall clock [s]
  /// Whether a signal has asked this process to end: runs are then killed. May be empty.
  std::function<bool()> is_interrupted;
};

/// What a run gave.
struct RunResult {
  playerlike::ProgramEnd end;
  bool hangs = false;                           ///< the limit of time ended it
  std::optional<playerlike::Report> report;     ///< none: it wrote none
  std::vector<grade::Trajectory> trajectories;  ///< by robot; empty without a report
  std::string printed;                          ///< the last of it
};

/// Reads what a run has written into its output folder. @return without a report if there is no
/// whole one.
[[nodiscard]] RunResult result_in(const std::filesystem::path& folder);

/// Runs a program in many worlds, in copies of processes that were started once. Not thread-safe.
class Runner {
 public:
  /// @throws playerlike::ProgramError as PreparedProgram.
  explicit Runner(RunnerSettings settings);
  ~Runner();
  Runner(const Runner&) = delete;
  Runner& operator=(const Runner&) = delete;

  /// Runs the program once in each world, side by side.
  /// @param worlds  texts of world files.
  /// @param is_over  asked between runs: whether to start no further one.
  /// @return results in the order of the worlds; none of those that were not started or were
  ///     interrupted.
  /// @throws playerlike::ProgramError if a prepared process has died.
  [[nodiscard]] std::vector<std::optional<RunResult>> run(
      const std::vector<std::string>& worlds, const std::function<bool()>& is_over = {});
  /// Runs so far that have ended.
  [[nodiscard]] std::size_t count() const noexcept { return count_; }
  [[nodiscard]] const RunnerSettings& settings() const noexcept { return settings_; }

 private:
  struct Slot;
  void start(Slot& slot, const std::string& world);
  [[nodiscard]] std::optional<RunResult> poll(Slot& slot);

  RunnerSettings settings_;
  std::vector<std::unique_ptr<Slot>> slots_;
  std::size_t count_ = 0;
};

}  // namespace playpen::fuzz
