// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cstddef>
#include <string>

#include "host/stepping/client.h"

namespace playerlike {

/// Warns the user, once, that the program does not let simulated time advance: it commands and
/// reads data, but does not call Read(). PollingDetector detects this. The host's mutex guards it
/// unless stated otherwise.
class StalledTimeWarning {
 public:
  /// @param sleeps_count  virtual time: sleeps let time advance.
  /// @param limit_s       processor time that a watched program may use before its first step.
  StalledTimeWarning(std::size_t robots, bool sleeps_count, double limit_s, Warn warn);

  /// The program has subscribed or commanded, so it needs simulated time. Any thread. @return
  /// whether this is the first call.
  [[nodiscard]] bool note_needs_time() noexcept {
    return !wants_time_.load(std::memory_order_relaxed) && !wants_time_.exchange(true);
  }
  /// note_command() counts a program's command, count_data_reads() its accesses to data, at a
  /// simulated time. The caller holds the client's input mutex, not the host's. @return whether
  /// check() must be called.
  [[nodiscard]] bool note_command(Client& client, sim::SimTime now_ns) const;
  [[nodiscard]] static bool count_data_reads(Client& client, sim::SimTime now_ns, int count,
                                             bool has_data);
  /// Warns if no thread will let time advance.
  /// @param may_advance  a thread may still do so.
  void check(Client& client, sim::SimTime now_ns, bool may_advance);

  /// See Host::watch_program().
  /// @param alone  without `playpen run`, which watches the steps of its program itself.
  void watch(bool alone) noexcept {
    watches_ = true;
    alone_ = alone;
  }
  void set_alarm() const;
  /// The calling thread makes the first step.
  /// @param lockstep  it then makes the others, too.
  void note_first_step(bool lockstep) const;
  /// Time advances now, or the program gets a warning elsewhere.
  void dismiss_alarm() const noexcept;
  /// The program ends without having let time advance.
  void note_end() const;

 private:
  [[nodiscard]] std::string cure() const;

  const double robots_;
  const bool sleeps_count_;
  const double limit_s_;
  const Warn warn_;
  std::atomic<bool> wants_time_{false};
  bool watches_ = false;
  bool alone_ = false;
  bool warned_ = false;
};

}  // namespace playerlike
