// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cstddef>
#include <string>

#include "host/client.h"

namespace playerlike {

/// Tells the user of a program, as warnings, that it lets no simulated time pass: it commands and
/// looks, but does not call Read(). Says so once. See IdleCalls for how that is found.
/// Guarded by the host's mutex, but for what says otherwise.
class StandingTime {
 public:
  /// @param sleeps_count  virtual time: sleeps let time pass.
  /// @param limit_s       processor time that a watched program may use before its first step.
  StandingTime(std::size_t robots, bool sleeps_count, double limit_s, Warn warn);

  /// The program has subscribed to something or commanded, so it is to let time pass. Any thread.
  /// @return whether that is news.
  [[nodiscard]] bool note_wish() noexcept {
    return !wants_time_.load(std::memory_order_relaxed) && !wants_time_.exchange(true);
  }
  /// Notes a command, or looks at data, of a program at a moment of simulated time; with the
  /// client's input mutex, without the host's. @return whether check() is to be called.
  [[nodiscard]] bool note_command(Client& client, sim::SimTime now_ns) const;
  [[nodiscard]] static bool note_looks(Client& client, sim::SimTime now_ns, int count,
                                       bool has_data);
  /// Looks whether nobody will let time pass, and if so says it.
  /// @param hopeful  somebody may still do so.
  void check(Client& client, sim::SimTime now_ns, bool hopeful);

  /// See Host::watch_program().
  void watch() noexcept { watches_ = true; }
  void set_alarm() const;
  /// Time passes now, or the program is told by other means.
  void dismiss_alarm() const noexcept;
  /// The program ends, and has let no time pass.
  void note_end() const;

 private:
  [[nodiscard]] std::string cure() const;

  const double robots_;
  const bool sleeps_count_;
  const double limit_s_;
  const Warn warn_;
  std::atomic<bool> wants_time_{false};
  bool watches_ = false;
  bool told_ = false;
};

}  // namespace playerlike
