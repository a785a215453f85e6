// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <csignal>
#include <functional>
#include <thread>

namespace playpen {

/// The signals that end a server: SIGINT, SIGTERM and SIGHUP. A thread of its own takes them, which
/// waits for nothing else, so they are obeyed whatever the simulation does. Signals that this
/// process ignores from the start, as under nohup, remain ignored.
///
/// The first signal asks for the end. The next one ends this process at once, except for copies of
/// the first (`timeout` sends two) and a SIGHUP after a SIGHUP.
class EndSignals {
 public:
  /// Blocks the signals in all threads that are started afterwards.
  EndSignals();
  EndSignals(const EndSignals&) = delete;
  EndSignals& operator=(const EndSignals&) = delete;
  /// The signals stay blocked: the process is about to exit with its status, which a late request
  /// to end must not change.
  ~EndSignals();

  /// Starts the thread.
  /// @param on_first  is called with the first signal; it must not wait for anything.
  /// @param on_late   is called if this object exists long after the first signal, which is after
  ///                  1.5 s unless the machine is busy; it should end the process.
  void listen(std::function<void(int)> on_first, std::function<void(int)> on_late);

  /// The number of the first signal; 0: none has arrived.
  [[nodiscard]] int first() const noexcept { return first_; }

 private:
  void watch();

  sigset_t held_{};
  sigset_t old_mask_{};
  std::function<void(int)> on_first_;
  std::function<void(int)> on_late_;
  std::atomic<int> first_{0};
  std::atomic<bool> over_{false};
  std::thread thread_;
};

}  // namespace playpen
