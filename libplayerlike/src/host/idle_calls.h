// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <map>
#include <optional>

#include "sim/core/time.h"

namespace playerlike {

/// Finds out that a program looks and commands again and again while simulated time stands still,
/// and that no thread of it is about to let time pass: it does not call Read().
///
/// Calls are counted since simulated time moved last, as shares of a limit. A program with one
/// thread is found when the limit is reached. One with several is found if its other threads have
/// slept all the time between two looks, the first at half of the limit and each further one at
/// twice the calls: a thread that is awake may still come to read. Not thread-safe.
class IdleCalls {
 public:
  /// Notes calls at a moment of simulated time.
  /// @param share  of the limit that they are, > 0.
  /// @return whether look() is to be called.
  [[nodiscard]] bool note(sim::SimTime now_ns, double share);
  /// Notes a command, the share of which depends on whether the calling thread has slept since its
  /// last one: programs send many commands in a row, but do not sleep in between.
  [[nodiscard]] bool note_command(sim::SimTime now_ns, double share, double share_after_sleep);
  /// Puts off the next look() until there are twice as many calls.
  void postpone() noexcept { next_look_ = 2.0 * used_; }
  /// Looks at the process's threads, and postpones the next look.
  /// @return whether nobody will let time pass.
  [[nodiscard]] bool look(sim::SimTime now_ns);

 private:
  using Sleepers = std::map<pid_t, std::uint64_t>;  ///< threads with how often they went to sleep

  /// The other threads; nullopt if one of them is awake.
  [[nodiscard]] static std::optional<Sleepers> sleepers();
  void begin_at(sim::SimTime now_ns);

  sim::SimTime since_ns_ = -1;
  double used_ = 0.0;  ///< share of the limit
  double next_look_ = 0.5;
  long own_sleeps_ = -1;              ///< of the calling thread at the last command; < 0: not known
  std::optional<Sleepers> sleepers_;  ///< at the last look
};

}  // namespace playerlike
