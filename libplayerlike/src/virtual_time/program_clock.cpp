// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "virtual_time/program_clock.h"

#include <algorithm>
#include <chrono>
#include <thread>

#include "process/end_of_program.h"

namespace playerlike {
namespace {

// The program is ended after so many sleeps beyond the end of the run. Each takes a millisecond,
// since other threads may still be working.
constexpr int kSleepsAfterEnd = 1000;

}  // namespace

void ProgramClock::begin_turns(sim::SimTime before_ns) {
  const Lock lock = lock_shortly();
  Turns::instance().set_clock(this, before_ns, now_ns());
}

void ProgramClock::end_turns(sim::SimTime before_ns) {
  const Lock lock = lock_shortly();
  Turns::instance().set_clock(nullptr, 0, before_ns);
}

// One thread runs at a time, so the effects of threads on shared data between two steps do not
// depend on the system's scheduling.
void ProgramClock::wait_for_turn(Lock& lock, const void* client, const SessionWait& wait) {
  Turns& turns = Turns::instance();
  TurnThread& self = turns.self();
  // After the end no wait takes time, but each thread gets its turn.
  for (bool waited = false; in_turns(); waited = true) {
    wait.require_open();
    const bool is_over = wait.is_over();
    if (is_over && self.state != TurnThread::State::kDetached && (waited || !over())) return;
    self.client = client;
    self.wake_ns = is_over ? 0 : wait.wake_ns();
    static_cast<void>(turns.wait(lock, self));
  }
}

bool ProgramClock::has_come(sim::SimTime wake_ns) const { return over() || now_ns() >= wake_ns; }

std::optional<sim::SimTime> ProgramClock::pass_time(sim::SimTime target_ns, bool asleep,
                                                    bool& interrupted) {
  interrupted = false;
  const ThreadId thread_id = this_thread_id();
  Lock lock = lock_for_stepping();
  if (!in_turns() || ended_by_program()) return std::nullopt;
  adopt_sessions_of(thread_id);
  const sim::SimTime wake_ns = target_ns - target_ns % step_ns();
  Turns& turns = Turns::instance();
  TurnThread& self = turns.self();
  self.wake_ns = wake_ns;
  interrupted = turns.wait(lock, self, /*interruptible=*/true) == TurnThread::Wake::kInterrupted;
  const sim::SimTime left_ns = target_ns - now_ns();
  if (interrupted) return left_ns;
  if (!over()) return in_turns() ? std::optional(left_ns) : std::nullopt;
  if (now_ns() < wake_ns) {
    if (ended_by_program()) return std::nullopt;
    sleep_after_end(lock, thread_id, asleep);
  }
  return left_ns;
}

void ProgramClock::note_timed_wait(Lock& lock, sim::SimTime left_ns) {
  if (!over() || left_ns < step_ns() || ended_by_program()) return;
  sleep_after_end(lock, this_thread_id(), /*asleep=*/true);
}

// A sleep cannot throw. A program that only sleeps is ended here. If it also reads, or has threads
// that do, they get the error, and it has some time to end by itself.
void ProgramClock::sleep_after_end(Lock& lock, ThreadId thread_id, bool asleep) {
  const auto& threads = Turns::instance().threads();
  const bool others = std::any_of(threads.begin(), threads.end(), [&](const auto& thread) {
    if (thread->thread_id == thread_id || thread->state == TurnThread::State::kDetached)
      return false;
    return thread->state != TurnThread::State::kWaits || thread->waits_for_time();
  });
  const EndRules rules = end_rules();
  if (rules.quiet && (!(rules.reported || others) || ++sleeps_after_end_ > kSleepsAfterEnd)) {
    tell_end(asleep);
    lock.unlock();
    end_program_quietly();
  }
  lock.unlock();
  std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

}  // namespace playerlike
