// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "host/core.h"

namespace playerlike {

/// The simulation as the clock of virtual time (see Turns): threads that take turns make its steps
/// and sleep in its time.
class Host::Core::VirtualClock final : public TurnClock {
 public:
  explicit VirtualClock(Core& core) : core_(core) {}

  /// As Core::wait_until(), for a thread that takes turns. Also returns when virtual time has
  /// ended.
  void wait_for_turn(Lock& lock, Client& client);
  /// Makes the threads ready whose wait is over, in their order.
  void make_ready();

  bool step(Lock& lock) override;
  [[nodiscard]] bool has_come(sim::SimTime wake_ns) const override;
  void check_silent_clients() override;
  [[nodiscard]] WallClock::time_point last_seen(const TurnThread& thread) const override;
  void on_silent(const TurnThread& thread) override;
  bool on_blocked(const TurnThread& thread) override;
  [[nodiscard]] sim::SimTime now_ns() const noexcept override { return core_.now_ns(); }
  [[nodiscard]] sim::SimTime step_ns() const noexcept override { return core_.step_ns_; }
  void begin_turns(sim::SimTime before_ns) override;
  void end_turns(sim::SimTime before_ns) override;
  std::optional<sim::SimTime> pass_time(sim::SimTime target_ns, bool asleep,
                                        bool& interrupted) override;
  void note_timed_wait(Lock& lock, sim::SimTime left_ns) override;
  [[nodiscard]] WallClock::duration silence_limit() const override;

  /// Whether other threads can run without a step.
  [[nodiscard]] static bool others_take_turns(ThreadId thread_id);

 private:
  /// @param asleep  see pass_time().
  void sleep_after_end(Lock& lock, ThreadId thread_id, bool asleep);

  Core& core_;
  int sleeps_after_end_ = 0;
};

}  // namespace playerlike
