// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "drivers/driver_thread.h"

#include <utility>

#include "proxies/link.h"
#include "virtual_time/program_threads.h"
#include "virtual_time/virtual_time.h"

namespace playerlike {

DriverThread::DriverThread(std::unique_ptr<Session> session) : client_(std::move(session)) {}

Session& DriverThread::session() const {
  return PlayerCc::detail::CoreAccess::get(client_)->session();
}

void DriverThread::start(std::function<void()> round) {
  round_ = std::move(round);
  const virtual_time::Inside inside;  // this is not the program's own thread
  // The caller, and with it simulated time, must not continue before the thread has joined.
  std::unique_lock lock(mutex_);
  const StartsOwnThreads starts;
  thread_ = std::thread([this] { run(); });
  started_changed_.wait(lock, [this] { return started_; });
}

void DriverThread::end() {
  if (!thread_.joinable()) return;
  PlayerCc::detail::CoreAccess::get(client_)->close();  // the thread's next call fails and ends it
  const virtual_time::Inside inside;                    // the thread ends without simulated time
  thread_.join();
}

void DriverThread::run() {
  try {
    session().request(JoinRequest{});
    {
      const std::lock_guard lock(mutex_);
      started_ = true;
    }
    started_changed_.notify_all();
    while (true) {
      client_.Read();
      round_();
    }
  } catch (const PlayerCc::PlayerError&) {
    // The run is over, or the driver is being destroyed.
  } catch (const SessionError&) {
    // The run is over or the driver is being destroyed, before the first round.
  }
  const std::lock_guard lock(mutex_);
  started_ = true;
  started_changed_.notify_all();
}

}  // namespace playerlike
