// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "host/idle_calls.h"
#include "playerlike/process/thread_id.h"
#include "playerlike/session/draw_queue.h"
#include "playerlike/session/session.h"
#include "sim/core/time.h"
#include "sim/devices/device.h"

namespace playerlike {

using WallClock = std::chrono::steady_clock;
/// Writes a warning into the run's log.
using Warn = std::function<void(const std::string&)>;

/// A number of seconds as a duration of the wall clock.
[[nodiscard]] inline WallClock::duration wall(double seconds) {
  return std::chrono::duration_cast<WallClock::duration>(std::chrono::duration<double>(seconds));
}

/// What the host knows of one session. Guarded by the host's mutex, but for what says otherwise.
struct Client {
  struct Subscription {
    DeviceId device{-1, -1};
    int count = 0;
    bool replace = true;
    bool fresh = false;  ///< replace: the device's newest reading was not taken yet
    std::vector<sim::SharedReading> queue;  ///< not replace: readings not taken yet
  };

  int number = 0;  ///< in order of connection; fixes the order of commands
  int port = 0;
  bool follower = false;  ///< see Session::open_follower()
  /// Of a server, which sees itself to what its clients may read.
  bool served = false;
  ThreadId creator = 0;                     ///< who connected it
  std::vector<Subscription> subscriptions;  ///< in order of device
  bool replace_by_default = true;
  std::uint32_t overflow = 0;
  bool has_data = false;
  sim::SimTime empty_round_ns = 0;  ///< without subscriptions: when the next round is over
  int looks = 0;                    ///< peek(0) calls in a row

  ThreadId owner = 0;       ///< who last waited; 0: nobody
  bool joined = false;      ///< takes part in the lockstep
  bool silent = false;      ///< thought for too long: does not count until it waits again
  bool waiting = false;     ///< its owner waits, and nothing has ended that yet
  bool wants_data = false;  ///< data ends the wait
  std::optional<sim::SimTime> wake_ns;  ///< the wait ends then, if set

  /// Of an EventClient: told when its wait is over. Empty: a thread waits in a call.
  std::function<void()> notify;
  std::atomic<bool> closed{false};
  std::atomic<WallClock::rep> last_seen{0};

  std::mutex input_mutex;  ///< guards the commands and idle; taken after the host's mutex
  std::vector<std::pair<DeviceId, sim::Command>> commands;
  IdleCalls idle;
  DrawQueue drawings;  ///< any thread may push; the rest under the host's mutex

  /// Whether it is a client of this process's program: neither a driver's nor a server's.
  [[nodiscard]] bool is_programs() const noexcept { return !follower && !notify; }
  /// Any thread, without the lock.
  void touch() {
    last_seen.store(WallClock::now().time_since_epoch().count(), std::memory_order_relaxed);
  }
  [[nodiscard]] WallClock::time_point seen() const {
    return WallClock::time_point(WallClock::duration(last_seen.load()));
  }
  /// Any thread, without the lock. @throws SessionError kDisconnected.
  void require_open() const {
    if (closed) throw SessionError(SessionError::Code::kDisconnected, "the connection is closed");
  }
};

}  // namespace playerlike
