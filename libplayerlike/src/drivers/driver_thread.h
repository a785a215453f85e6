// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>

#include "libplayerc++/playerclient.h"
#include "playerlike/session/session.h"

namespace playerlike {

/// The thread of a driver, with its own PlayerClient. In lockstep it takes part from start() on, as
/// a follower (see Session::open_follower()).
class DriverThread {
 public:
  /// @param session  a follower; not null.
  explicit DriverThread(std::unique_ptr<Session> session);
  DriverThread(const DriverThread&) = delete;
  DriverThread& operator=(const DriverThread&) = delete;
  /// Same as end().
  ~DriverThread() { end(); }

  /// The client, for the proxies of the driver.
  [[nodiscard]] PlayerCc::PlayerClient& client() { return client_; }
  [[nodiscard]] Session& session() const;

  /// Starts the thread, and returns when it has joined the lockstep.
  /// @param round  called in that thread after each Read() of the client.
  void start(std::function<void()> round);
  /// Closes the client and ends the thread. Simulated time does not advance.
  void end();

 private:
  void run();

  PlayerCc::PlayerClient client_;
  std::function<void()> round_;
  std::mutex mutex_;
  std::condition_variable started_changed_;
  bool started_ = false;  // guarded by mutex_
  std::thread thread_;
};

}  // namespace playerlike
