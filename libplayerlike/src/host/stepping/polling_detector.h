// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <map>
#include <optional>

#include "sim/core/time.h"

namespace playerlike {

/// Detects a program that polls and commands repeatedly while simulated time stands still, with no
/// thread that is about to call Read().
///
/// Each call since the last advance of simulated time adds a weight, a fraction of a limit. A
/// program with one thread is detected at the limit. With several threads, check() is called at
/// half of the limit and then each time the count has doubled. The program is detected if its other
/// threads slept during the whole time between two checks, since a thread that is awake may still
/// call Read(). Not thread-safe.
class PollingDetector {
 public:
  /// Counts calls at a simulated time.
  /// @param weight  fraction of the limit, > 0.
  /// @return whether check() must be called.
  [[nodiscard]] bool note(sim::SimTime now_ns, double weight);
  /// Counts a command. Its weight depends on whether the calling thread has slept since its last
  /// command: programs send many commands in a row, but do not sleep in between.
  [[nodiscard]] bool note_command(sim::SimTime now_ns, double weight, double weight_after_sleep);
  /// Postpones the next check() until the count has doubled.
  void postpone() noexcept { next_check_ = 2.0 * used_; }
  /// Checks the process's threads, and postpones the next check. @return whether no thread will let
  /// time advance.
  [[nodiscard]] bool check(sim::SimTime now_ns);

 private:
  using Sleepers = std::map<pid_t, std::uint64_t>;  ///< voluntary context switches by thread

  /// The other threads; nullopt if one of them is awake.
  [[nodiscard]] static std::optional<Sleepers> sleepers();
  void begin_at(sim::SimTime now_ns);

  sim::SimTime since_ns_ = -1;
  double used_ = 0.0;  ///< fraction of the limit
  double next_check_ = 0.5;
  bool commanded_ = false;            ///< a command has been counted
  long own_sleeps_ = -1;              ///< of the calling thread at the last command; < 0: unknown
  std::optional<Sleepers> sleepers_;  ///< at the last check
};

}  // namespace playerlike
