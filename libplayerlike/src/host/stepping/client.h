// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "host/stepping/polling_detector.h"
#include "playerlike/process/thread_id.h"
#include "playerlike/session/draw_queue.h"
#include "playerlike/session/session.h"
#include "sim/core/time.h"
#include "sim/devices/device.h"

namespace playerlike {

using WallClock = std::chrono::steady_clock;
/// Logs a warning of the run.
using Warn = std::function<void(const std::string&)>;

/// Converts seconds to a duration of the wall clock.
[[nodiscard]] inline WallClock::duration wall(double seconds) {
  return std::chrono::duration_cast<WallClock::duration>(std::chrono::duration<double>(seconds));
}

/// The host's state of a session. The host's mutex guards it unless stated otherwise.
struct Client {
  struct Subscription {
    DeviceId device{-1, -1};
    int count = 0;
    bool replace = true;
    std::vector<sim::SharedReading> unread;  ///< not taken yet; if `replace`, at most one
  };

  int number = 0;  ///< in order of connection; determines the order of commands
  int port = 0;
  bool follower = false;  ///< see Session::open_follower()
  bool onlooker = false;  ///< see EventRole::kOnlooker; also what acts for an onlooker
  /// Belongs to a server, which checks itself what its clients may read.
  bool served = false;
  ThreadId creator = 0;  ///< the thread that connected it
  ThreadId process = 0;  ///< see CreationOrder
  /// See EventClient::set_process_search(); empty: it belongs to this process.
  std::function<std::optional<int>()> find_process;
  std::optional<int> found_process;         ///< what it has found; 0: nothing
  std::vector<Subscription> subscriptions;  ///< in order of device
  bool replace_by_default = true;
  std::uint32_t overflow = 0;
  bool has_data = false;
  bool overruled = false;  ///< it was warned that another client has taken over its robot
  std::string lost_robot;  ///< that the connection to a real robot is lost, until it was told
  sim::SimTime empty_round_ns = 0;  ///< without subscriptions: end of the present round
  int zero_peeks = 0;               ///< consecutive calls of peek(0)

  ThreadId owner = 0;       ///< the thread that waited last; 0: none
  bool joined = false;      ///< takes part in the lockstep
  bool silent = false;      ///< exceeded the silence limit: not counted until it waits again
  bool waiting = false;     ///< its owner waits, and the wait is not over
  bool wants_data = false;  ///< data end the wait
  std::optional<sim::SimTime> wake_ns;  ///< if set, this time ends the wait
  /// Of a program in virtual time at a server: it waits with this session for all of its threads.
  bool takes_turns = false;
  /// ... and data of these sessions end the wait, too.
  std::vector<std::shared_ptr<const Client>> waits_for;

  /// Of an EventClient: called when its wait is over. Empty: a thread waits inside of a call.
  std::function<void()> notify;
  std::atomic<bool> closed{false};
  std::atomic<WallClock::rep> last_seen{0};

  /// Guards the commands and the detector; locked after the host's mutex.
  std::mutex input_mutex;
  std::vector<std::pair<DeviceId, sim::Command>> commands;
  PollingDetector polling_detector;
  DrawQueue drawings;  ///< any thread may push; the host's mutex guards the rest

  /// Whether it belongs to this process's program, not to a driver or a server.
  [[nodiscard]] bool is_programs() const noexcept { return !follower && !onlooker && !notify; }
  /// Any thread, without the mutex.
  void touch(WallClock::time_point now = WallClock::now()) {
    last_seen.store(now.time_since_epoch().count(), std::memory_order_relaxed);
  }
  [[nodiscard]] WallClock::time_point seen() const {
    return WallClock::time_point(WallClock::duration(last_seen.load()));
  }
  /// Any thread, without the mutex. @throws SessionError kDisconnected.
  void require_open() const {
    if (closed) throw SessionError(SessionError::Code::kDisconnected, "the connection is closed");
  }
};

}  // namespace playerlike
