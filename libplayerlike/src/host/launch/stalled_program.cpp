// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// The part of Host::Core that watches the program: whether it lets time advance, and for how long.
#include <chrono>
#include <csignal>
#include <utility>

#include "host/core.h"
#include "host/launch/busy_alarm.h"
#include "host/stepping/virtual_clock.h"
#include "process/debugger.h"
#include "sim/core/number_text.h"

namespace playerlike {

void Host::Core::set_busy_alarm() {
  if (!paced() && !stands_still() && !progress_.first_step()) stalled_time_warning_.set_alarm();
}

void Host::Core::check_silence() {
  constexpr std::chrono::milliseconds kPeriod(100);  // of the server's calls
  const auto now = WallClock::now();
  const Lock lock = lock_with_priority();
  const auto due = std::exchange(silence_check_due_, now + kPeriod);
  // Silence matters only if clients wait for lockstep time that could advance.
  if (paced() || stands_still()) return;
  if (lockstep_.somebody_waits() || program_takes_part()) lockstep_.note_silence(now, due);
}

void Host::Core::make_stop() {
  stop_ns_.reset();
  if (settings_.stop->then == RunStop::Then::kView) {
    if (window_ || page_) pace_.set_paused(true);
  } else if (tracer_of(0) != 0) {
    static_cast<void>(raise(SIGTRAP));  // the debugger takes it
  }
}

bool Host::Core::is_debugged(Client& client) {
  if (tracer_of(0) != 0) return true;
  if (!client.find_process) return false;
  if (!client.found_process) client.found_process = client.find_process().value_or(0);
  return *client.found_process != 0 && tracer_of(*client.found_process) != 0;
}

void Host::Core::watch_program() {
  const bool alone = settings_.kept_run.empty();
  watches_program_ = true;
  tells_of_endless_run_ = alone && !simulation_.world().simulation.duration_ns;
  stalled_time_warning_.watch(alone);
}

void Host::Core::tell_of_endless_run(WallClock::time_point now) {
  const auto limit = std::chrono::duration<double>(settings_.silence_limit_s);
  if (paced() || now - progress_.first_step().value_or(now) < limit) return;
  tells_of_endless_run_ = false;
  if (!log_) return;
  log_(sim::LogLevel::kInfo,
       "this program simulates its world itself and is at " +
           sim::fixed_text(sim::to_seconds(simulation_.now_ns()), 0) +
           " s of simulated time. The world sets no duration, so this goes on until the program "
           "ends or Ctrl-C ends it. PLAYPEN_DURATION=60 sets a duration in seconds; `playpen run "
           "WORLD --duration 60 -- PROGRAM` also shows the progress and keeps the results");
}

void Host::Core::count_data_reads(Client& client, int count, bool has_data) {
  if (!client.is_programs()) return;
  bool must_check = false;
  {
    const std::lock_guard input(client.input_mutex);
    must_check = StalledTimeWarning::count_data_reads(client, now_ns(), count, has_data);
  }
  if (must_check) check_stalled_time(client);
}

void Host::Core::check_stalled_time(Client& client) {
  const Lock lock = lock_with_priority();
  const ThreadId self = this_thread_id();
  const bool others =
      in_turns() ? VirtualClock::others_take_turns(self) : lockstep_.others_may_wait(self);
  stalled_time_warning_.check(client, simulation_.now_ns(), paced() || over() || others);
}

void Host::Core::note_program_ends(int status) {
  const Lock lock = lock_with_priority();
  results_.program_status = status;
  stalled_time_warning_.dismiss_alarm();
  // A program that ends with an error status needs no advice.
  if (!paced() && !ended_ && !progress_.first_step() && status == 0)
    stalled_time_warning_.note_end();
}

}  // namespace playerlike
