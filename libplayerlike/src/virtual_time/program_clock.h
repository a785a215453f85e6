// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <mutex>
#include <optional>

#include "virtual_time/turns.h"

namespace playerlike {

/// A wait of a session, as virtual time sees it. The mutex of Turns is held during calls.
class SessionWait {
 public:
  SessionWait() = default;
  SessionWait(const SessionWait&) = delete;
  SessionWait& operator=(const SessionWait&) = delete;
  virtual ~SessionWait() = default;

  /// Whether data, the time or the end of the run has ended the wait.
  [[nodiscard]] virtual bool is_over() const = 0;
  /// The simulated time that ends it; nullopt: only data do.
  [[nodiscard]] virtual std::optional<sim::SimTime> wake_ns() const = 0;
  /// @throws SessionError kDisconnected if the session is closed.
  virtual void require_open() const = 0;
};

/// What the clocks of all simulations have in common, whether the simulation is in this process or
/// at a server: threads of the program wait for sessions and for time in their turn.
class ProgramClock : public TurnClock {
 public:
  using Lock = std::unique_lock<std::mutex>;

  /// Waits for a session in the calling thread's turn. Also returns when virtual time has ended.
  /// @param client  identifies the session, see TurnThread::client.
  void wait_for_turn(Lock& lock, const void* client, const SessionWait& wait);

  void begin_turns(sim::SimTime before_ns) override;
  void end_turns(sim::SimTime before_ns) override;
  std::optional<sim::SimTime> pass_time(sim::SimTime target_ns, bool asleep,
                                        bool& interrupted) override;
  void note_timed_wait(Lock& lock, sim::SimTime left_ns) override;
  [[nodiscard]] bool has_come(sim::SimTime wake_ns) const override;

 protected:
  /// Whether the program's threads take turns and wait for this simulation.
  [[nodiscard]] virtual bool in_turns() const = 0;
  /// Whether the run is over, so that waits end.
  [[nodiscard]] virtual bool over() const = 0;
  /// Whether the program itself has ended the run, as by exit().
  [[nodiscard]] virtual bool ended_by_program() const = 0;
  /// The thread sleeps: the sessions that it has opened and nobody has used take part.
  virtual void adopt_sessions_of(ThreadId thread_id) = 0;
  /// Locks the mutex of Turns for a call that may make steps, or for a short one.
  [[nodiscard]] virtual Lock lock_for_stepping() const = 0;
  [[nodiscard]] virtual Lock lock_shortly() const = 0;

  /// How a program is ended that goes on after the end of the run without reading.
  struct EndRules {
    bool quiet = false;     ///< it is ended at all
    bool reported = false;  ///< a session has thrown because the run is over
  };
  [[nodiscard]] virtual EndRules end_rules() const = 0;
  /// The program is about to be ended in a sleep, or in something else (`asleep` false).
  virtual void tell_end(bool asleep) = 0;

  /// Makes the threads ready whose wait is over: first those of sessions, in this order, then
  /// sleepers. So a program that sleeps in one thread and reads in another finds the data of that
  /// time.
  /// @param clients  pointers, as passed to wait_for_turn(). @param is_over  of one of them.
  template <typename Clients, typename IsOver>
  void make_ready(const Clients& clients, IsOver is_over) {
    using State = TurnThread::State;
    Turns& turns = Turns::instance();
    for (const auto& client : clients) {
      for (const auto& thread : turns.threads()) {
        if (thread->state != State::kWaits || thread->client != std::to_address(client)) continue;
        if (is_over(*client)) turns.make_ready(*thread, TurnThread::Wake::kObjectReady);
      }
    }
    for (const auto& thread : turns.threads()) {
      if (thread->state != State::kWaits || thread->client != nullptr || !thread->wake_ns) continue;
      if (has_come(*thread->wake_ns)) turns.make_ready(*thread, TurnThread::Wake::kTime);
    }
  }

 private:
  /// @param asleep  see pass_time().
  void sleep_after_end(Lock& lock, ThreadId thread_id, bool asleep);

  int sleeps_after_end_ = 0;
};

}  // namespace playerlike
