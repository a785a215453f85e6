// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "host/core.h"
#include "virtual_time/program_clock.h"

namespace playerlike {

/// The simulation in this process as the clock of virtual time (see Turns): threads that take turns
/// make its steps and sleep in its time.
class Host::Core::VirtualClock final : public ProgramClock {
 public:
  explicit VirtualClock(Core& core) : core_(core) {}

  /// As Core::wait_until(), for a thread that takes turns. Also returns when virtual time has
  /// ended.
  void wait_for_turn(Lock& lock, Client& client);
  /// Makes the threads ready whose wait is over, in their order.
  void make_ready();

  bool step(Lock& lock) override;
  void check_silent_clients() override;
  [[nodiscard]] WallClock::time_point last_seen(const TurnThread& thread) const override;
  void on_silent(const TurnThread& thread) override;
  bool on_blocked(const TurnThread& thread) override;
  [[nodiscard]] sim::SimTime now_ns() const noexcept override { return core_.now_ns(); }
  [[nodiscard]] sim::SimTime step_ns() const noexcept override { return core_.step_ns_; }
  [[nodiscard]] WallClock::duration silence_limit() const override;
  [[nodiscard]] bool excuses_debuggers() const override { return core_.excuses_debuggers(); }

  /// Whether other threads can run without a step.
  [[nodiscard]] static bool others_take_turns(ThreadId thread_id);

 private:
  class Wait;

  [[nodiscard]] bool in_turns() const override { return core_.in_turns(); }
  [[nodiscard]] bool over() const override { return core_.over(); }
  [[nodiscard]] bool ended_by_program() const override { return core_.ended_by_program_; }
  void adopt_sessions_of(ThreadId thread_id) override;
  [[nodiscard]] Lock lock_for_stepping() const override { return core_.lock_for_stepping(); }
  [[nodiscard]] Lock lock_shortly() const override { return core_.lock_with_priority(); }
  [[nodiscard]] EndRules end_rules() const override;
  void tell_end(bool asleep) override;

  Core& core_;
};

}  // namespace playerlike
