// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <chrono>

namespace playerlike {

/// Waits for something that is expected within some microseconds, without sleeping.
///
/// Two processes that work in turn, such as a program and its server in lockstep, wake each other
/// up for each message. A processor that sleeps takes longer to wake up than a short answer takes.
/// So the thread looks again and again for a while before it sleeps. After looks in vain it sleeps
/// at once for the next waits, more of them each time, since the other process computes for longer
/// or the machine is busy.
class ShortWait {
 public:
  /// @param is_there  looks for it.
  /// @return whether it is there; if not, the caller must sleep.
  template <typename IsThere>
  [[nodiscard]] bool look(IsThere is_there) {
    if (left_out_ > 0) {
      --left_out_;
      return false;
    }
    const Clock::time_point end = Clock::now() + kLongest;
    do {
      if (is_there()) {
        pause_ = 0;
        return true;
      }
    } while (Clock::now() < end);
    pause_ = std::clamp(2 * pause_, kFirstPause, kLongestPause);
    left_out_ = pause_;
    return false;
  }

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::microseconds kLongest{150};
  // Waits that are left out after looks in vain.
  static constexpr int kFirstPause = 4;
  static constexpr int kLongestPause = 256;

  int pause_ = 0;     ///< after the last look
  int left_out_ = 0;  ///< how many of them are left
};

}  // namespace playerlike
