// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "sim/core/time.h"

/// Playpen's side of virtual time (docs/virtual_time.md): implements sleeps and clocks of a program
/// that `playpen run` has started. The other side is preload/.
///
/// The state is per thread. The main thread and the threads in the lockstep use virtual time while
/// they run the program's own code. Playpen's own code (Inside) and all other threads use real
/// time. All functions may be called from any thread.
namespace playerlike {

class TurnClock;

namespace virtual_time {

/// Whether sleeps of this process are virtual: the library is preloaded and give_up() was not
/// called.
[[nodiscard]] bool active() noexcept;

/// While an object exists, its thread runs Playpen's own code.
class Inside {
 public:
  Inside() noexcept;
  Inside(const Inside&) = delete;
  Inside& operator=(const Inside&) = delete;
  ~Inside();
};

/// While an object exists, threads that its thread starts belong to the program, although Playpen's
/// code starts them.
class StartsForProgram {
 public:
  StartsForProgram() noexcept;
  StartsForProgram(const StartsForProgram&) = delete;
  StartsForProgram& operator=(const StartsForProgram&) = delete;
  ~StartsForProgram();
};

/// While an object exists, threads that its thread starts belong to libraries that work for
/// Playpen, such as film encoders. Nothing is virtual for them, and nobody waits for them.
class StartsForLibraries {
 public:
  StartsForLibraries() noexcept;
  StartsForLibraries(const StartsForLibraries&) = delete;
  StartsForLibraries& operator=(const StartsForLibraries&) = delete;
  ~StartsForLibraries();
};

/// From now on sleeps advance this simulation's time and the clocks show it; it must be in
/// lockstep. Further simulations are ignored until the first one is detached: a program has one
/// clock.
void attach(const std::shared_ptr<TurnClock>& simulation);
/// The simulation that is attached; null: none.
[[nodiscard]] const TurnClock* attached_clock() noexcept;
/// The clocks stop until another simulation is attached.
void detach(TurnClock& simulation) noexcept;
/// From now on sleeps are real, and the clocks continue in real time. The caller has locked the
/// simulation, or Turns if there is none.
void give_up_locked() noexcept;
/// As give_up_locked(); the caller holds no lock.
void give_up() noexcept;

/// Without a simulation: virtual time since the program's start [ns].
[[nodiscard]] long long time_before_ns() noexcept;
void set_time_before_ns(long long now_ns) noexcept;

/// The calling thread uses virtual time: calls note_thread_ends() when it ends.
void remember_thread();
/// The calling thread waits for simulated time, so it takes part in the lockstep from now on.
void note_wait() noexcept;
/// Counts the calling thread's accesses to data and commands. If a thread does nothing else for
/// very long, a step passes now and then: a background thread may change the data it polls, and
/// without such a thread the run must still end. Must not be called with a lock held that other
/// threads need.
void count_data_reads(int count = 1) noexcept;
/// From now on background threads read data, see count_data_reads().
void note_background() noexcept;
/// The calling thread's variables are being destroyed. The thread leaves virtual time, unless the
/// whole process ends.
void note_thread_ends() noexcept;
/// Whether the thread ends because the process does.
[[nodiscard]] bool process_ends() noexcept;

/// Advances simulated time step by step until a condition holds, as if the calling thread slept.
/// @param simulation  whose time to advance, see Session::simulation().
/// @return whether the condition holds; false at once if the thread does not use that simulation's
/// time.
[[nodiscard]] bool wait_until(const void* simulation, const std::function<bool()>& condition);

}  // namespace virtual_time
}  // namespace playerlike
