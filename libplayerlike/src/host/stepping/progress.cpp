// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "host/stepping/progress.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "sim/core/number_text.h"

namespace playerlike {
namespace {

std::string padded(double value, int digits, std::size_t width) {
  const std::string text = sim::fixed_text(value, digits);
  return std::string(width - std::min(width, text.size()), ' ') + text;
}

}  // namespace

bool Progress::note_step(WallClock::time_point now) {
  last_step_ = now;
  if (first_step_) return false;
  first_step_ = now;
  last_shown_ = now;
  return true;
}

void Progress::add_times(TimeStatistics& time, bool ended) const {
  if (!first_step_) return;
  const WallClock::duration passed = (ended ? last_step_ : WallClock::now()) - *first_step_;
  time.wall_time_s = std::chrono::duration<double>(passed).count();
  if (time.wall_time_s > 0.0) {
    time.real_time_factor = sim::to_seconds(time.sim_time_ns - start_ns_) / time.wall_time_s;
  }
}

void Progress::show(const TimeStatistics& time, bool last) {
  const auto now = WallClock::now();
  if (last ? !shown_ : now - last_shown_ < std::chrono::milliseconds(100)) return;
  if (isatty(STDERR_FILENO) == 0) return;
  last_shown_ = now;
  shown_ = true;
  std::fputs(('\r' + line(time) + (last ? "\n" : "")).c_str(), stderr);
  std::fflush(stderr);
}

std::string Progress::line(const TimeStatistics& time) {
  const double sim_s = sim::to_seconds(time.sim_time_ns);
  const std::string speed = sim::fixed_text(time.real_time_factor, 0) + " x real time";
  if (!time.duration_s) return padded(sim_s, 1, 9) + " s simulated, " + speed + ' ';
  constexpr std::size_t kCells = 30;
  const auto full = static_cast<std::size_t>(std::min(1.0, sim_s / *time.duration_s) * 30.0);
  const double left_s =
      time.real_time_factor > 0.0 ? (*time.duration_s - sim_s) / time.real_time_factor : 0.0;
  return '[' + std::string(full, '#') + std::string(kCells - full, '.') + "] " +
         padded(sim_s, 1, 7) + " / " + sim::fixed_text(*time.duration_s, 0) + " s simulated, " +
         speed + ", " + sim::fixed_text(std::ceil(std::max(0.0, left_s)), 0) + " s left ";
}

}  // namespace playerlike
