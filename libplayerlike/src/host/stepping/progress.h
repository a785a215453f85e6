// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "host/stepping/client.h"
#include "playerlike/messages/messages.h"

namespace playerlike {

/// Measures a run's wall-clock time and shows its progress on the terminal. Not thread-safe:
/// guarded by the host's mutex.
class Progress {
 public:
  /// @param start_ns  simulated time at which the run begins.
  explicit Progress(sim::SimTime start_ns = 0) : start_ns_(start_ns) {}

  /// A step begins. @return whether it is the first.
  bool note_step(WallClock::time_point now);
  /// When the first step began; nullopt before.
  [[nodiscard]] std::optional<WallClock::time_point> first_step() const { return first_step_; }
  /// The last step has ended.
  void note_end() { last_step_ = WallClock::now(); }
  /// Sets wall_time_s and real_time_factor.
  /// @param ended  no step will follow.
  void add_times(TimeStatistics& time, bool ended) const;

  /// Shows the line if standard error is a terminal and at least 0.1 s have passed since the last
  /// time.
  /// @param last  the run is over: the line stays, if there is one.
  void show(const TimeStatistics& time, bool last);
  /// The line, e.g. "[######........]     1.2 / 2 s simulated, 300 x real time, 0 s left ".
  [[nodiscard]] static std::string line(const TimeStatistics& time);

 private:
  sim::SimTime start_ns_;
  std::optional<WallClock::time_point> first_step_;
  WallClock::time_point last_step_;
  WallClock::time_point last_shown_;
  bool shown_ = false;
};

}  // namespace playerlike
