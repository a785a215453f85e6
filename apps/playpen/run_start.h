// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "playerlike/host/run_settings.h"
#include "scratch_folder.h"

/// Runs that begin in the world as it was in a finished run: `playpen run --from OUT@T`.
namespace playpen {

/// A moment of a finished run.
struct RunMoment {
  std::string folder;   ///< of the run's results
  double time_s = 0.0;  ///< simulated time, 0..1e9; the first step at or after it counts
};

/// Description of the texts that parse_run_moment() accepts, for messages.
inline constexpr const char* kRunMomentExpected =
    "FOLDER@SECONDS, the results of a run and a simulated time, such as out/cave@31.0";

/// Parses "FOLDER@SECONDS". The folder may contain further "@". @return whether the text is valid.
[[nodiscard]] bool parse_run_moment(const std::string& text, RunMoment& moment);

/// The state of a finished run at a moment, in a temporary file.
class StartState {
 public:
  /// Makes the finished run again up to the moment.
  /// @param named_world  the world that the user names; "": none.
  /// @param settings  of the new run; receives those of the finished one that belong to its world,
  ///     and the file. A duration in it replaces the recorded one.
  /// @throws std::runtime_error if the run has no recording, ends before the moment or begins after
  ///     it, was over at the moment, or had another world; or if the new run would end before.
  /// @throws sim::ConfigError if the named world cannot be found.
  StartState(const RunMoment& moment, const std::string& named_world,
             playerlike::RunSettings& settings);

  /// The world's file; "": the default world.
  [[nodiscard]] const std::string& world_file() const noexcept { return world_file_; }
  /// The simulated time of the state [s].
  [[nodiscard]] double time_s() const noexcept { return time_s_; }

 private:
  ScratchFolder folder_;
  std::string world_file_;
  double time_s_ = 0.0;
};

/// @throws std::runtime_error if the results of the new run would replace those of the finished
///     one.
void refuse_same_folder(const RunMoment& moment, const std::string& output_folder);

}  // namespace playpen
