// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "sim/core/time.h"

/// Playpen's side of virtual time (docs/virtual_time.md): what becomes of a sleep, or of a look at
/// the clock, in a program that `playpen run` has started. Its other side is preload/.
///
/// Each thread has its own way: the main thread and those that take part in the lockstep live in
/// virtual time while they are in the program's own code; in Playpen's own code (Inside) and in all
/// other threads everything is real. All functions may be called from any thread.
namespace playerlike {

class TurnClock;

namespace virtual_time {

/// Whether sleeps of this process reach Playpen: the library is preloaded, and there is no reason
/// (see give_up()) to let the wall clock rule.
[[nodiscard]] bool active() noexcept;

/// While one lives, its thread is in Playpen's own code.
class Inside {
 public:
  Inside() noexcept;
  Inside(const Inside&) = delete;
  Inside& operator=(const Inside&) = delete;
  ~Inside();
};

/// While one lives, threads that its thread starts are the program's own, though it is Playpen's
/// code that starts them.
class StartsForProgram {
 public:
  StartsForProgram() noexcept;
  StartsForProgram(const StartsForProgram&) = delete;
  StartsForProgram& operator=(const StartsForProgram&) = delete;
  ~StartsForProgram();
};

/// While one lives, threads that its thread starts are those of libraries that work for Playpen, as
/// encoders of films do: nothing is virtual for them, and what they wait for holds up nobody.
class StartsForLibraries {
 public:
  StartsForLibraries() noexcept;
  StartsForLibraries(const StartsForLibraries&) = delete;
  StartsForLibraries& operator=(const StartsForLibraries&) = delete;
  ~StartsForLibraries();
};

/// From now on sleeps move this simulation's time, and the clocks tell it; it must be in lockstep.
/// The first one stays until it is detached: a program has one clock.
void attach(const std::shared_ptr<TurnClock>& simulation);
/// The clocks stay where they are until another simulation is attached.
void detach(TurnClock& simulation) noexcept;
/// From now on sleeps are real, and the clocks go on with the wall clock from where they are.
/// With the simulation locked, or Turns if there is none.
void give_up_locked() noexcept;
/// The same, with nothing locked.
void give_up() noexcept;

/// Without a simulation: the time since the program's start, and how that goes on [ns].
[[nodiscard]] long long time_before_ns() noexcept;
void set_time_before_ns(long long now_ns) noexcept;

/// The calling thread lives in virtual time: that is to be told when it ends.
void remember_thread();
/// The calling thread waits for simulated time, and so takes part in the lockstep from now on.
void note_wait() noexcept;
/// The calling thread has looked at data, or given commands, so often. One that does nothing else
/// for very long lets a step pass now and then: what it waits for may change in the background, and
/// if nobody reads there, its run is to end all the same. Not to be called with a lock held that
/// others need.
void note_looks(int count = 1) noexcept;
/// From now on there are threads that read in the background, see note_looks().
void note_background() noexcept;
/// The calling thread's variables are destroyed. It ends, and nothing is virtual for it any more,
/// unless it is the whole process that ends.
void note_thread_ends() noexcept;
/// Whether that is because the process ends.
[[nodiscard]] bool process_ends() noexcept;

/// Lets simulated time pass, step by step, until something is so; as if the calling thread slept.
/// @param simulation  whose time it is, see Session::simulation().
/// @return whether it is; false at once if the thread does not live in that time.
[[nodiscard]] bool wait_until(const void* simulation, const std::function<bool()>& condition);

}  // namespace virtual_time
}  // namespace playerlike
