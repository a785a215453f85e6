// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// The waits of a socket session in virtual time; see RemoteClock.
#include <memory>
#include <string>

#include "process/thread_end.h"
#include "remote/socket_session.h"
#include "virtual_time/virtual_time.h"

namespace playerlike {

void SocketSession::take_part_in_turns(const TimeStatistics& time, std::uint64_t session) {
  if (!settings_.virtual_time || time.mode != sim::TimeMode::kLockstep) return;
  const std::shared_ptr<RemoteSimulation> simulation = sender_->simulation();
  const std::shared_ptr<RemoteClock> clock = simulation->clock_or([&] {
    return std::make_shared<RemoteClock>(
        RemoteClock::Settings{sim::from_seconds(time.step_s), simulation, settings_.silence_limit_s,
                              settings_.quiet_end});
  });
  virtual_time::attach(clock);
  if (virtual_time::attached_clock() != clock.get()) return;  // a program has one clock
  turns_ = clock->add(sender_, session, follow_.has_value(), time.sim_time_ns);
  clock_ = clock;
}

bool SocketSession::in_turns() const noexcept { return turns_ && clock_->rules(); }

void SocketSession::note_wait() const {
  if (ThreadEnd* const end = ThreadEnd::mine()) {
    end->say_goodbye(clock_, [](void* clock) {
      if (!virtual_time::process_ends()) static_cast<RemoteClock*>(clock)->thread_ended();
    });
  }
  if (turns_->follower) return;  // drivers are not threads of the program
  virtual_time::remember_thread();
  virtual_time::note_wait();
}

bool SocketSession::wait_for_data_in_turns() {
  note_wait();
  if (with_connection([this] { return clock_->wait(*turns_); }) != RemoteClock::Outcome::kOver) {
    return false;
  }
  throw_async_error();
  if (clock_->has_data(*turns_)) return true;
  clock_->note_end_reported();
  throw_finished();
}

bool SocketSession::peek_in_turns(std::chrono::milliseconds timeout, bool& result) {
  note_wait();
  return with_connection([&] { return clock_->peek(*turns_, timeout, result); }) ==
         RemoteClock::Outcome::kOver;
}

bool SocketSession::sleep_in_turns(double seconds) {
  note_wait();
  return with_connection([&] { return clock_->sleep(*turns_, sim::from_seconds(seconds)); }) ==
         RemoteClock::Outcome::kOver;
}

}  // namespace playerlike
