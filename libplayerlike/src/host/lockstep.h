// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "host/clients.h"

namespace playerlike {

/// Who takes part in the lockstep, and whether time waits for somebody.
///
/// A client takes part from its first wait on. It belongs to the thread that last waited with it,
/// and a thread waits if one of its clients does. Time waits for those who think, but not for those
/// who have been silent for too long. The start gate, once open, stays open.
/// Not thread-safe: guarded by the host's mutex.
class Lockstep {
 public:
  /// @param clients  must live as long as this.
  /// @param gate     how many programs' clients must have joined before time begins.
  Lockstep(const Clients& clients, int gate, double silence_limit_s, Warn warn);

  /// The client waits, by this thread; from now on it takes part.
  void adopt(Client& client, ThreadId thread_id);
  /// A thread has ended: nobody waits for its clients.
  void forget(ThreadId thread_id) noexcept;

  [[nodiscard]] bool gate_open();
  /// Whether a program is there for which time may go on.
  [[nodiscard]] bool program_takes_part() const;
  [[nodiscard]] bool somebody_waits() const;
  /// Whether all who take part wait.
  [[nodiscard]] bool all_wait() const;
  /// Whether a client of another thread than this one may come to let time pass.
  [[nodiscard]] bool others_may_wait(ThreadId thread_id);

  /// When it is to be looked whether a client has been silent for too long, if nothing changes.
  [[nodiscard]] WallClock::time_point silence_deadline(WallClock::time_point now) const;
  /// Says for whom the others wait, and no longer waits for those who have been silent too long.
  void note_silence(WallClock::time_point now);
  /// In virtual time: a thread has been silent for too long.
  void note_silent_thread(ThreadId thread_id) const;
  /// How long a thread may think.
  [[nodiscard]] WallClock::duration silence_limit() const;
  /// When a thread was last seen by its clients, or `seen` if that is later.
  [[nodiscard]] WallClock::time_point last_seen(ThreadId thread_id,
                                                WallClock::time_point seen) const;

  /// Whether the others have gone on without a client.
  [[nodiscard]] bool silence_noted() const noexcept { return silence_noted_; }
  /// Whether several threads have waited with programs' clients.
  [[nodiscard]] bool several_owners() const noexcept { return several_owners_; }

 private:
  [[nodiscard]] int joined_programs() const;
  [[nodiscard]] bool thinks(const Client& client) const;
  void warn_of_silence(const std::string& who) const;

  const Clients& clients_;
  const int gate_;
  const double silence_limit_s_;
  const Warn warn_;
  bool gate_opened_ = false;
  WallClock::time_point gate_told_ = WallClock::now();  ///< when it was last said who is missing
  bool silence_noted_ = false;
  ThreadId first_owner_ = 0;               ///< who waited first, and ...
  bool several_owners_ = false;            ///< ... whether another one has
  mutable std::vector<ThreadId> waiting_;  ///< of all_wait()
};

}  // namespace playerlike
