// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "host/stepping/clients.h"

namespace playerlike {

/// Membership in the lockstep, and whether time waits for a client.
///
/// A client takes part from its first wait on. The thread that last waited with it owns it, and a
/// thread waits if one of its clients does. Time waits for all threads that do not wait themselves,
/// except for those that have exceeded the silence limit. The start gate stays open once it is
/// open. Not thread-safe: guarded by the host's mutex.
///
/// The silence limit counts no time in which the client's process is under a debugger, so that a
/// program may stand at a breakpoint for any time. It is looked for from half of the limit on. So
/// at least half of it is left when a debugger leaves the process.
class Lockstep {
 public:
  /// Whether a client's process, or this one, is under a debugger now.
  using IsDebugged = std::function<bool(Client&)>;

  /// @param clients  must outlive this object.
  /// @param gate     how many programs' clients must have joined before time begins.
  /// @param is_debugged  empty: debuggers make no difference, as in a graded run.
  Lockstep(const Clients& clients, int gate, double silence_limit_s, Warn warn,
           IsDebugged is_debugged = {});

  /// This thread waits with the client, which takes part from now on.
  void adopt(Client& client, ThreadId thread_id);
  /// A thread has ended: nobody waits for its clients.
  void forget(ThreadId thread_id) noexcept;

  [[nodiscard]] bool gate_open();
  /// Whether a program's client takes part, so that time may advance for it.
  [[nodiscard]] bool program_takes_part() const;
  [[nodiscard]] bool somebody_waits() const;
  /// Whether all clients that take part wait.
  [[nodiscard]] bool all_wait() const;
  /// Whether a client of another thread may still let time advance.
  [[nodiscard]] bool others_may_wait(ThreadId thread_id);

  /// When note_silence() must be called if nothing changes before.
  [[nodiscard]] WallClock::time_point silence_deadline(WallClock::time_point now) const;
  /// Warns about clients that hold up the others, and stops waiting for those that have exceeded
  /// the silence limit.
  /// @param due  when this call was to be made. If it comes much later, this process was stopped,
  ///             and the limit begins anew.
  void note_silence(WallClock::time_point now, std::optional<WallClock::time_point> due = {});
  /// Whether debuggers make a difference, and one is at work in this process or a client's.
  [[nodiscard]] bool anybody_is_debugged() const;
  /// In virtual time: a thread has exceeded the silence limit.
  void note_silent_thread(ThreadId thread_id) const;
  /// How long a thread may run without waiting.
  [[nodiscard]] WallClock::duration silence_limit() const;
  /// When a client of a thread was last active, or `seen` if that is later.
  [[nodiscard]] WallClock::time_point last_seen(ThreadId thread_id,
                                                WallClock::time_point seen) const;

  /// Whether time has advanced without a silent client.
  [[nodiscard]] bool silence_noted() const noexcept { return silence_noted_; }
  /// Whether several threads have waited with programs' clients.
  [[nodiscard]] bool several_owners() const noexcept { return several_owners_; }

 private:
  [[nodiscard]] int joined_programs() const;
  [[nodiscard]] bool thinks(const Client& client) const;
  void warn_of_silence(const std::string& who) const;
  void note_closed_gate(WallClock::time_point now);

  const Clients& clients_;
  const int gate_;
  const double silence_limit_s_;
  const Warn warn_;
  const IsDebugged is_debugged_;
  bool gate_opened_ = false;
  /// When missing clients were last reported.
  WallClock::time_point gate_warned_at_ = WallClock::now();
  bool silence_noted_ = false;
  ThreadId first_owner_ = 0;               ///< the first thread that waited, and ...
  bool several_owners_ = false;            ///< ... whether another one has waited
  mutable std::vector<ThreadId> waiting_;  ///< scratch memory of all_wait()
};

}  // namespace playerlike
