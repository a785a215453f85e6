// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

#include "host/stepping/client.h"
#include "sim/core/time.h"

namespace playerlike {

/// The pace of a run: speed and pauses if it follows the wall clock or people watch it, and an
/// optional limit of steps. Step n + 1 after a base time is due n + 1 step durations after it, so
/// there is no drift. Not thread-safe: guarded by the host's mutex.
class Pace {
 public:
  using Time = WallClock::time_point;

  /// @param factor  simulated seconds per wall-clock second, > 0.
  Pace(double step_s, double factor) : step_s_(step_s), factor_(factor) {}

  /// Whether the run follows the wall clock.
  [[nodiscard]] bool by_wall_clock() const noexcept { return by_wall_clock_; }
  [[nodiscard]] double factor() const noexcept { return factor_; }
  [[nodiscard]] bool paused() const noexcept { return paused_; }
  /// limited: whether the number of further steps is limited; step_limit_reached: whether none is
  /// left.
  [[nodiscard]] bool limited() const noexcept { return credit_.has_value(); }
  [[nodiscard]] bool step_limit_reached() const noexcept { return credit_ == 0U; }
  /// Number of changes of factor, pause and limit.
  [[nodiscard]] int changes() const noexcept { return changes_; }

  void follow_wall_clock() noexcept { by_wall_clock_ = true; }
  /// People watch a run in lockstep, from this simulated time on: is_too_early() delays its steps.
  void watch_from(sim::SimTime from_ns) noexcept { watched_from_ns_ = from_ns; }
  void stop_watching() noexcept { watched_from_ns_.reset(); }
  /// Whether people watch a run in lockstep at this simulated time.
  [[nodiscard]] bool watched(sim::SimTime now_ns) const noexcept {
    return watched_from_ns_ && now_ns >= *watched_from_ns_;
  }
  /// For runs in lockstep: whether the next step has to wait, because people watch or have paused
  /// the run. If not, the step begins now.
  [[nodiscard]] bool is_too_early(sim::SimTime now_ns, Time now) {
    if (!watched(now_ns) && !paused_) return false;
    if (paused_) begin_at(now);
    if (paused_ || now < due()) return true;
    begin_step(now);
    return false;
  }
  void set_factor(double factor) {
    // The base moves to the newest step, so the change neither skips nor repeats time.
    begin_at(base_ + after(done_));
    factor_ = factor;
    ++changes_;
  }
  void set_paused(bool paused) {
    paused_ = paused;
    ++changes_;
  }
  void set_limit(std::optional<std::uint64_t> steps) {
    credit_ = steps;
    ++changes_;
  }
  void add_to_limit(std::uint64_t steps) {
    if (credit_) set_limit(*credit_ + steps);
  }

  /// Sets the base: the next step is due one step duration after it.
  void begin_at(Time now) {
    base_ = now;
    done_ = 0;
  }
  [[nodiscard]] Time due() const { return base_ + after(done_ + 1); }
  /// The run has waited for the limit. The lost time is not made up for, but a step that is late is
  /// due at once.
  void skip_lost_time(Time now) {
    if (now > due()) begin_at(now - after(1));
  }
  /// A step begins now. If the run is far behind (after a suspension, or with a factor that the
  /// machine cannot reach), it does not try to catch up.
  void begin_step(Time now) {
    if (now - due() > std::chrono::milliseconds(200)) begin_at(now);
    ++done_;
  }
  /// A step was made, in any time mode.
  void count_step() noexcept {
    if (credit_) --*credit_;
  }

 private:
  [[nodiscard]] WallClock::duration after(std::uint64_t steps) const {
    return wall(static_cast<double>(steps) * step_s_ / factor_);
  }

  const double step_s_;
  bool by_wall_clock_ = false;
  std::optional<sim::SimTime> watched_from_ns_;
  double factor_;
  bool paused_ = false;
  std::optional<std::uint64_t> credit_;  ///< remaining steps, if limited
  int changes_ = 0;
  Time base_{};
  std::uint64_t done_ = 0;  ///< steps since base_
};

}  // namespace playerlike
