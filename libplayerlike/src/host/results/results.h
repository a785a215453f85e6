// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "host/results/disk_room.h"
#include "host/results/kept_writer.h"
#include "host/results/outputs.h"
#include "host/results/recorder.h"
#include "host/results/recording_writer.h"
#include "host/results/run_log.h"
#include "host/stepping/client.h"
#include "playerlike/host/report.h"

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
  /// Prepares the results of the run, and returns a function that writes them. The function does
  /// not need the host's mutex; it must be called once, and this object must outlive it. A failure
  /// is logged as a warning.
  /// @param layers  a copy of the simulation's layers; needed if there is an output folder.
  [[nodiscard]] std::function<void()> prepare(std::optional<sim::LayerStack> layers);
  /// Takes the writing of the results away from this object, unless it has begun: it then writes
  /// none. Needs no mutex. @return whether the caller shall write them.
  [[nodiscard]] bool take_over() noexcept { return !claimed_.exchange(true); }

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

  /// Notes the signal that requested the end, if it is the first one. Needs no mutex.
  void note_end_request(int signal) noexcept {
    int none = 0;
    end_request_.compare_exchange_strong(none, signal);
  }

  /// A client has taken readings, for the recording.
  void note_read(const Client& client,
                 const std::vector<std::pair<DeviceId, sim::SharedReading>>& taken);

  std::map<int, RunLog> logs;  ///< by port; the logs that clients have asked for

  // Why the run ends, for the report.
  bool window_closed = false;
  bool real_robot_lost = false;  ///< and the world says that this ends the run
  std::optional<int> program_status;

 private:
  struct Last;

  void write(Last* last);
  void keep_report(WallClock::time_point now);
  /// Holds the room for a last report that is somewhat longer than this one.
  void hold_room_for(const std::string& report);
  [[nodiscard]] std::string report_now() const;
  [[nodiscard]] RunEnd reason_of_end() const;
  void set_phase(KeptRun::Phase phase) noexcept;

  const RunSettings& settings_;
  sim::Simulation& simulation_;
  const std::function<TimeStatistics()> time_;
  const Warn warn_;
  const Mirror* const mirror_;
  DiskRoom report_room_;  ///< for the last report: trajectory, film and logs may fill the disk
  std::unique_ptr<Recorder> recorder_;
  std::unique_ptr<RecordingWriter> recording_;      ///< null: the run is not recorded
  std::unique_ptr<KeptWriter> kept_;                ///< null unless the settings name a file
  WallClock::time_point last_looks_{};              ///< when keep_looks() was last called
  std::uint64_t kept_events_ = 0;                   ///< number of arena events at that time
  std::optional<WallClock::time_point> last_kept_;  ///< when the report was last written
  bool write_failure_warned_ = false;               ///< about files that cannot be written
  std::atomic<int> end_request_{0};                 ///< the signal; 0: none
  std::atomic<bool> claimed_{false};                ///< see take_over()
};

}  // namespace playerlike
