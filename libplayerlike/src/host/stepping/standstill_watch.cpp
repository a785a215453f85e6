// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "host/stepping/standstill_watch.h"

#include <chrono>

#include "process/debugger.h"
#include "process/system_threads.h"
#include "sim/core/number_text.h"
#include "sim/core/time.h"

namespace playerlike {
std::optional<std::string> StandstillWatch::look(const KeptRun& run) {
  if (told_) return std::nullopt;
  const KeptRun::Progress now = run.progress();
  const auto cpu = processor_time(now.process);
  // A debugger steps slowly, and its user sees where the program is.
  const bool stands = tracer_of(now.process) == 0 && run.phase() == KeptRun::Phase::kRunning &&
                      now.steps > 0 && now == last_;
  if (!cpu || !stands) {
    last_ = now;
    last_cpu_ = cpu.value_or(std::chrono::nanoseconds::zero());
    return std::nullopt;
  }
  if (std::chrono::duration<double>(*cpu - last_cpu_).count() < limit_s_) return std::nullopt;
  told_ = true;
  return "the program has computed for " + sim::rounded_text(limit_s_, 6) +
         " s of processor time without calling Read(), and simulated time stands still at " +
         sim::fixed_text(sim::to_seconds(now.now_ns), 2) +
         " s. If this is an endless loop: Ctrl-C ends the run with its results, and `gdb -p " +
         std::to_string(now.process) + "` shows where the program is";
}

}  // namespace playerlike
