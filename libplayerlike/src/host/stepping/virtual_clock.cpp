// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "host/stepping/virtual_clock.h"

#include <algorithm>
#include <string>

namespace playerlike {

/// The wait of a client in this process.
class Host::Core::VirtualClock::Wait final : public SessionWait {
 public:
  Wait(const Core& core, const Client& client) : core_(core), client_(client) {}
  [[nodiscard]] bool is_over() const override { return core_.wait_is_over(client_); }
  [[nodiscard]] std::optional<sim::SimTime> wake_ns() const override { return client_.wake_ns; }
  void require_open() const override { client_.require_open(); }

 private:
  const Core& core_;
  const Client& client_;
};

void Host::Core::VirtualClock::wait_for_turn(Lock& lock, Client& client) {
  ProgramClock::wait_for_turn(lock, &client, Wait(core_, client));
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

void Host::Core::VirtualClock::make_ready() {
  ProgramClock::make_ready(core_.clients_,
                           [this](const Client& client) { return core_.wait_is_over(client); });
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

// A program that never reads takes part with the clients that it has created.
void Host::Core::VirtualClock::adopt_sessions_of(ThreadId thread_id) {
  for (const auto& client : core_.clients_) {
    if (client->creator == thread_id && client->owner == 0 && !client->follower) {
      core_.adopt(*client, thread_id);
    }
  }
}

ProgramClock::EndRules Host::Core::VirtualClock::end_rules() const {
  return {core_.settings_.quiet_end, core_.end_reported_};
}

void Host::Core::VirtualClock::tell_end(bool asleep) {
  if (!core_.settings_.progress || !core_.log_) return;
  core_.log_(sim::LogLevel::kInfo,
             std::string("the run is over: the program was ended ") +
                 (asleep ? "while it slept" : "while it ran without calling Read()"));
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
