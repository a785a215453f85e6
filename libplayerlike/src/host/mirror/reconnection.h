// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "host/mirror/real_link.h"

namespace playerlike {

/// Connects to a real robot again, in a thread of its own, until it succeeds. Any thread may call
/// the members.
class Reconnection {
 public:
  /// Time between two attempts, and limit of each step of an attempt [s].
  static constexpr double kPause_s = 0.25;
  static constexpr double kAttempt_s = 0.75;

  /// Makes a connection. It throws SessionError if that fails.
  using Connect = std::function<std::unique_ptr<RealLink>()>;

  explicit Reconnection(Connect connect);
  Reconnection(const Reconnection&) = delete;
  Reconnection& operator=(const Reconnection&) = delete;
  /// Ends the attempts.
  ~Reconnection();

  /// Takes the connection; null: there is none yet.
  [[nodiscard]] std::unique_ptr<RealLink> take();

 private:
  void attempt() noexcept;

  const Connect connect_;
  std::mutex mutex_;  // guards the members below
  std::condition_variable changed_;
  std::unique_ptr<RealLink> link_;
  bool stopping_ = false;
  std::thread thread_;
};

}  // namespace playerlike
