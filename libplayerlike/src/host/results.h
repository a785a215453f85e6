// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

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

/// What a run leaves behind: report, pictures, film, trajectory and logs in its output folder, and
/// what follows it while it runs, for when the program dies.
/// Not thread-safe: guarded by the host's mutex.
class Results {
 public:
  /// @param settings, simulation  must live as long as this.
  /// @param time  tells the run's figures.
  /// @throws std::runtime_error if the output folder cannot be made.
  Results(const RunSettings& settings, sim::Simulation& simulation,
          std::function<TimeStatistics()> time, Warn warn);

  /// A step was made.
  void observe();
  /// Lets what is left when the program dies follow the run.
  void keep(WallClock::time_point now);
  /// The run is over: no step follows. What it leaves is still to be written.
  void begin_end() noexcept { set_phase(KeptRun::Phase::kEnded); }
  /// Writes all results, once. What fails is a warning.
  void write();

  /// A client says where a robot is to drive. @param place  in W [m].
  void note_goal(int robot, const sim::Vec2& place, double tolerance_m) {
    recorder_->goals().note(robot, place, tolerance_m, simulation_.now_ns());
  }

  [[nodiscard]] sim::SceneSnapshot scene() const { return recorder_->scene(simulation_); }

  std::map<int, RunLog> logs;  ///< by port; those that somebody has asked for

  // Why the run ends, for the report.
  int end_request = 0;  ///< the signal that asked for it; 0: none
  bool window_closed = false;
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
  std::unique_ptr<Recorder> recorder_;
  std::unique_ptr<KeptWriter> kept_;                ///< none unless the settings name one
  WallClock::time_point last_looks_{};              ///< when kept_ last got what rarely changes
  std::optional<WallClock::time_point> last_kept_;  ///< when the report was last written
  bool keeping_told_ = false;                       ///< that they cannot be written
};

}  // namespace playerlike
