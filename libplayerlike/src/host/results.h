// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "host/client.h"
#include "host/kept_writer.h"
#include "host/outputs.h"
#include "host/recorder.h"
#include "host/run_log.h"

namespace playerlike {

/// The results of a run: report, pictures, film, trajectory and logs in its output folder, and the
/// data that complete them if the program dies. Not thread-safe: guarded by the host's mutex.
class Results {
 public:
  /// @param settings, simulation  must outlive this object.
  /// @param time  returns the run's statistics.
  /// @param commands  of the clients.
  /// @param mirror  of the real robots; null: there are none.
  /// @throws std::runtime_error if the output folder cannot be created.
  Results(const RunSettings& settings, sim::Simulation& simulation,
          std::function<TimeStatistics()> time, Warn warn, const CommandBook& commands,
          const Mirror* mirror = nullptr);

  /// Must be called after each step.
  void observe();
  /// Updates the data that remain if the program dies.
  void keep(WallClock::time_point now);
  /// The run is over, no step follows; the results are still to be written.
  void begin_end() noexcept { set_phase(KeptRun::Phase::kEnded); }
  /// Writes all results once. A failure is logged as a warning.
  void write();

  /// Records a goal that a client announces for a robot. @param place  goal in W [m].
  void note_goal(int robot, const sim::Vec2& place, double tolerance_m) {
    recorder_->goals().note(robot, place, tolerance_m, simulation_.now_ns());
  }

  /// Records that something was refused to the program now; see Permissions. This is kept at once,
  /// because a program that does not expect it may die of it.
  void note_refusal(const std::string& what);

  /// See KeptRun::note_conflict().
  [[nodiscard]] bool conflict_noted() const noexcept { return kept_ && kept_->conflict_noted(); }

  [[nodiscard]] sim::SceneSnapshot scene() const { return recorder_->scene(simulation_); }

  std::map<int, RunLog> logs;  ///< by port; the logs that clients have asked for

  // Why the run ends, for the report.
  int end_request = 0;  ///< the signal that requested the end; 0: none
  bool window_closed = false;
  bool real_robot_lost = false;  ///< and the world says that this ends the run
  std::optional<int> program_status;

 private:
  void keep_report(WallClock::time_point now);
  [[nodiscard]] std::string report_now() const;
  [[nodiscard]] RunEnd reason_of_end() const;
  void set_phase(KeptRun::Phase phase) noexcept;

  const RunSettings& settings_;
  sim::Simulation& simulation_;
  const std::function<TimeStatistics()> time_;
  const Warn warn_;
  const Mirror* const mirror_;
  std::unique_ptr<Recorder> recorder_;
  std::unique_ptr<KeptWriter> kept_;                ///< null unless the settings name a file
  WallClock::time_point last_looks_{};              ///< when keep_looks() was last called
  std::uint64_t kept_events_ = 0;                   ///< number of arena events at that time
  std::optional<WallClock::time_point> last_kept_;  ///< when the report was last written
  bool write_failure_warned_ = false;               ///< about files that cannot be written
};

}  // namespace playerlike
