// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

#include "host/client.h"

namespace playerlike {

/// How fast a run may go: its speed and pauses when it follows the wall clock, and how many steps
/// it may still make. Step number n + 1 since a moment is due n + 1 steps' time after it, so a run
/// neither drifts nor catches up. Not thread-safe: guarded by the host's mutex.
class Pace {
 public:
  using Time = WallClock::time_point;

  /// @param factor  simulated seconds a wall second, > 0.
  Pace(double step_s, double factor) : step_s_(step_s), factor_(factor) {}

  /// Whether the run follows the wall clock.
  [[nodiscard]] bool by_wall_clock() const noexcept { return by_wall_clock_; }
  [[nodiscard]] double factor() const noexcept { return factor_; }
  [[nodiscard]] bool paused() const noexcept { return paused_; }
  /// Whether the steps that may be made are limited, and whether none is left.
  [[nodiscard]] bool limited() const noexcept { return credit_.has_value(); }
  [[nodiscard]] bool used_up() const noexcept { return credit_ == 0U; }
  /// Counts the changes below, and of the limit.
  [[nodiscard]] int changes() const noexcept { return changes_; }

  void follow_wall_clock() noexcept { by_wall_clock_ = true; }
  void set_factor(double factor) {
    // From the newest step on at the new speed: nothing is caught up with, nothing lost.
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

  /// The next step is due a step's time after this.
  void begin_at(Time now) {
    base_ = now;
    done_ = 0;
  }
  [[nodiscard]] Time due() const { return base_ + after(done_ + 1); }
  /// The limit was waited for. Nothing is caught up with, but a step that is late comes at once.
  void forgive(Time now) {
    if (now > due()) begin_at(now - after(1));
  }
  /// A step is made now. Far behind (a suspended machine, a factor beyond what it can do) the run
  /// goes on from here instead of rushing after.
  void begin_step(Time now) {
    if (now - due() > std::chrono::milliseconds(200)) begin_at(now);
    ++done_;
  }
  /// Of any run: a step was made.
  void count_step() noexcept {
    if (credit_) --*credit_;
  }

 private:
  [[nodiscard]] WallClock::duration after(std::uint64_t steps) const {
    return wall(static_cast<double>(steps) * step_s_ / factor_);
  }

  const double step_s_;
  bool by_wall_clock_ = false;
  double factor_;
  bool paused_ = false;
  std::optional<std::uint64_t> credit_;  ///< steps that may still be made, if limited
  int changes_ = 0;
  Time base_{};
  std::uint64_t done_ = 0;  ///< steps since base_
};

}  // namespace playerlike
