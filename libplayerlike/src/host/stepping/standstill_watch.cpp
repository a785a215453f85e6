// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "host/stepping/standstill_watch.h"

#include <sys/types.h>
#include <time.h>

#include "sim/core/number_text.h"
#include "sim/core/time.h"

namespace playerlike {
namespace {

/// Processor time of all threads of a process so far [s]; nullopt: there is no such process.
std::optional<double> cpu_time_s(pid_t process) {
  clockid_t clock{};
  timespec time{};
  if (clock_getcpuclockid(process, &clock) != 0 || clock_gettime(clock, &time) != 0) {
    return std::nullopt;
  }
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace

std::optional<std::string> StandstillWatch::look(const KeptRun& run) {
  if (told_) return std::nullopt;
  const KeptRun::Progress now = run.progress();
  const std::optional<double> cpu_s = cpu_time_s(now.process);
  const bool stands = run.phase() == KeptRun::Phase::kRunning && now.steps > 0 && now == last_;
  if (!cpu_s || !stands) {
    last_ = now;
    last_cpu_s_ = cpu_s.value_or(0.0);
    return std::nullopt;
  }
  if (*cpu_s - last_cpu_s_ < limit_s_) return std::nullopt;
  told_ = true;
  return "the program has computed for " + sim::rounded_text(limit_s_, 6) +
         " s of processor time without calling Read(), and simulated time stands still at " +
         sim::fixed_text(sim::to_seconds(now.now_ns), 2) +
         " s. If this is an endless loop: Ctrl-C ends the run with its results, and `gdb -p " +
         std::to_string(now.process) + "` shows where the program is";
}

}  // namespace playerlike
