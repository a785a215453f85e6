// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "host/stepping/virtual_clock.h"

#include <algorithm>
#include <string>

#include "process/end_of_program.h"

namespace playerlike {
namespace {

// The program is ended after so many sleeps beyond the end of the run. Each takes a millisecond,
// since other threads may still be working.
constexpr int kSleepsAfterEnd = 1000;

}  // namespace

void Host::Core::VirtualClock::begin_turns(sim::SimTime before_ns) {
  const Lock lock = core_.lock_with_priority();
  Turns::instance().set_clock(this, before_ns, 0);
}

void Host::Core::VirtualClock::end_turns(sim::SimTime before_ns) {
  const Lock lock = core_.lock_with_priority();
  Turns::instance().set_clock(nullptr, 0, before_ns);
}

// One thread runs at a time, so the effects of threads on shared data between two steps do not
// depend on the system's scheduling.
void Host::Core::VirtualClock::wait_for_turn(Lock& lock, Client& client) {
  Turns& turns = Turns::instance();
  TurnThread& self = turns.self();
  // After the end no wait takes time, but each thread gets its turn.
  for (bool waited = false; core_.in_turns(); waited = true) {
    client.require_open();
    const bool is_over = core_.wait_is_over(client);
    if (is_over && self.state != TurnThread::State::kDetached && (waited || !core_.over())) return;
    self.client = &client;
    self.wake_ns = is_over ? 0 : client.wake_ns;
    static_cast<void>(turns.wait(lock, self));
  }
}

bool Host::Core::VirtualClock::step(Lock& lock) {
  if (core_.stands_still() || core_.pace_.step_limit_reached() || !core_.lockstep_.gate_open() ||
      !Turns::instance().somebody_waits_for_time()) {
    return false;
  }
  // Turns asks again after some milliseconds.
  if (core_.is_too_early()) return false;
  core_.advance(lock);
  core_.give_way(lock);
  return true;
}

// Threads that wait for data become ready before threads that sleep: a program that sleeps in one
// thread and reads in another finds the data of that time.
void Host::Core::VirtualClock::make_ready() {
  using State = TurnThread::State;
  Turns& turns = Turns::instance();
  for (const auto& client : core_.clients_) {
    for (const auto& thread : turns.threads()) {
      if (thread->state != State::kWaits || thread->client != client.get()) continue;
      if (core_.wait_is_over(*client)) turns.make_ready(*thread, TurnThread::Wake::kObjectReady);
    }
  }
  for (const auto& thread : turns.threads()) {
    if (thread->state != State::kWaits || thread->client != nullptr || !thread->wake_ns) continue;
    if (has_come(*thread->wake_ns)) turns.make_ready(*thread, TurnThread::Wake::kTime);
  }
}

bool Host::Core::VirtualClock::has_come(sim::SimTime wake_ns) const {
  return core_.over() || core_.simulation_.now_ns() >= wake_ns;
}

void Host::Core::VirtualClock::check_silent_clients() {
  if (!core_.lockstep_.gate_open()) core_.lockstep_.note_silence(WallClock::now());
}

WallClock::time_point Host::Core::VirtualClock::last_seen(const TurnThread& thread) const {
  return core_.lockstep_.last_seen(thread.thread_id, thread.seen);
}

WallClock::duration Host::Core::VirtualClock::silence_limit() const {
  return core_.lockstep_.silence_limit();
}

void Host::Core::VirtualClock::on_silent(const TurnThread& thread) {
  core_.lockstep_.note_silent_thread(thread.thread_id);
}

bool Host::Core::VirtualClock::on_blocked(const TurnThread& thread) {
  if (core_.paced() || core_.over() || !thread.starts_background || core_.mode_chosen_)
    return false;
  core_.start_pacing(
      "the program reads in the background (StartThread) while its own thread waits for "
      "something else than simulated time, the keyboard maybe: simulated time now follows the "
      "wall clock (--time lockstep decides otherwise)");
  return true;
}

std::optional<sim::SimTime> Host::Core::VirtualClock::pass_time(sim::SimTime target_ns, bool asleep,
                                                                bool& interrupted) {
  interrupted = false;
  const ThreadId thread_id = this_thread_id();
  Lock lock = core_.lock_for_stepping();
  if (!core_.in_turns() || core_.ended_by_program_) return std::nullopt;
  // A program that never reads takes part with the clients that it has created.
  for (const auto& client : core_.clients_) {
    if (client->creator == thread_id && client->owner == 0 && !client->follower) {
      core_.adopt(*client, thread_id);
    }
  }
  const sim::SimTime wake_ns = target_ns - target_ns % core_.step_ns_;
  Turns& turns = Turns::instance();
  TurnThread& self = turns.self();
  self.wake_ns = wake_ns;
  interrupted = turns.wait(lock, self, /*interruptible=*/true) == TurnThread::Wake::kInterrupted;
  const sim::SimTime left_ns = target_ns - core_.simulation_.now_ns();
  if (interrupted) return left_ns;
  if (!core_.over()) return core_.in_turns() ? std::optional(left_ns) : std::nullopt;
  if (core_.simulation_.now_ns() < wake_ns) {
    if (core_.ended_by_program_) return std::nullopt;
    sleep_after_end(lock, thread_id, asleep);
  }
  return left_ns;
}

void Host::Core::VirtualClock::note_timed_wait(Lock& lock, sim::SimTime left_ns) {
  if (!core_.over() || left_ns < core_.step_ns_ || core_.ended_by_program_) return;
  sleep_after_end(lock, this_thread_id(), /*asleep=*/true);
}

// A sleep cannot throw. A program that only sleeps is ended here. If it also reads, or has threads
// that do, they get the error, and it has some time to end by itself.
void Host::Core::VirtualClock::sleep_after_end(Lock& lock, ThreadId thread_id, bool asleep) {
  const auto& threads = Turns::instance().threads();
  const bool others = std::any_of(threads.begin(), threads.end(), [&](const auto& thread) {
    if (thread->thread_id == thread_id || thread->state == TurnThread::State::kDetached)
      return false;
    return thread->state != TurnThread::State::kWaits || thread->waits_for_time();
  });
  const RunSettings& settings = core_.settings_;
  if (settings.quiet_end &&
      (!(core_.end_reported_ || others) || ++sleeps_after_end_ > kSleepsAfterEnd)) {
    if (settings.progress && core_.log_) {
      core_.log_(sim::LogLevel::kInfo,
                 std::string("the run is over: the program was ended ") +
                     (asleep ? "while it slept" : "while it ran without calling Read()"));
    }
    lock.unlock();
    end_program_quietly();
  }
  lock.unlock();
  std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

bool Host::Core::VirtualClock::others_take_turns(ThreadId thread_id) {
  const auto& threads = Turns::instance().threads();
  return std::any_of(threads.begin(), threads.end(), [&](const auto& thread) {
    using State = TurnThread::State;
    if (thread->thread_id == thread_id) return false;
    return thread->state == State::kReady || thread->state == State::kConcurrent ||
           (thread->state == State::kWaits && thread->waits_for_time());
  });
}

}  // namespace playerlike
