// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// The C interface between the preloaded library (preload/) and Playpen in the same process. The
/// two binaries may come from different builds, so every change needs a new version. See
/// docs/virtual_time.md.
extern "C" {

/// Playpen's implementation of the functions that the preloaded library replaces. None of them
/// throws. The thread that called the replaced function calls them; `caller` is the address of that
/// call.
struct PlaypenVirtualTimeHooks {
  int version;  ///< PLAYPEN_VIRTUAL_TIME_VERSION
  /// Number of threads that wait for a mutex virtually or are about to lock one after such a wait;
  /// and number of threads that wait for other objects. Atomic.
  const int* mutex_waits;
  const int* object_waits;
  /// Advances simulated time for the calling thread by a duration [ns], > 0.
  /// @param left_ns  receives the remaining time if a signal ended the sleep.
  /// @return 1: done; 2: a signal ended it; 0: the thread must sleep in real time.
  int (*sleep)(long long duration_ns, const void* caller, long long* left_ns);
  /// Reads the virtual time since the program's start [ns].
  /// @param ask  1 if the program asked: a loop that only reads the clock must let time advance.
  /// @return 1: done; 0: use the real clock.
  int (*now)(long long* elapsed_ns, int ask, const void* caller);
  /// The calling thread is about to start another thread. @return an id for it, > 0; 0 if the
  /// thread is not part of virtual time.
  unsigned long long (*begin_thread)(const void* caller, const void* start, const void* argument);
  /// The thread was started.
  void (*thread_started)(unsigned long long number, const void* handle);
  /// The thread could not be started.
  void (*thread_failed)(unsigned long long number);
  /// The calling thread is the started one. Returns when it gets its turn.
  void (*thread_begun)(unsigned long long number);
  /// Begins a wait for an object, which its address identifies (a thread: its pthread_t). From now
  /// on wake() finds the calling thread.
  /// @param kind         a PlaypenWaitKind.
  /// @param deadline_ns  since the program's start; < 0: none.
  /// @param is_ready     nullptr, or a function of object and value that tells whether the wait is
  ///                  over. Called with locks held: it must not block.
  /// @return 1: finish_wait() must be called; 2: the wait is over; 0: the thread must wait in real
  /// time.
  int (*begin_wait)(const void* object, int kind, long long deadline_ns,
                    int (*is_ready)(const void*, unsigned), unsigned value);
  /// Waits until the wait is over. @return a PlaypenWaitEnd.
  int (*finish_wait)();
  /// Wakes up to `most` threads that wait for an object. @return the number of threads woken.
  int (*wake)(const void* object, int most);
  /// Whether the calling thread must wait virtually for a locked mutex, because its owner (a system
  /// thread id) waits for its own turn.
  int (*waits_for_turn)(int owner);
  /// Whether a thread that has waited for this mutex is about to lock it.
  int (*mutex_is_wanted)(const void* mutex);
  /// Whether the thread with this pthread_t takes turns and has not ended.
  int (*thread_lives)(const void* handle);
  /// A thread cancels another one, whose wait ends.
  void (*cancelled)(const void* handle);
  /// A thread sends another one a signal that has a handler; the other thread's sleep ends.
  void (*signalled)(const void* handle);
  /// Gives up the turn, so that other ready threads run.
  void (*yield)();
  /// The calling thread (pthread_exit) or the process (exit) is about to end.
  void (*leaving)(int process);
  /// is_programs: whether `caller` is the program's own code and the calling thread takes turns.
  /// takes_turns: only the latter.
  int (*is_programs)(const void* caller);
  int (*takes_turns)();
  /// The program uses a real-time facility that cannot be simulated. Warns once.
  void (*waits_for_real)(const char* what);
};

enum PlaypenWaitKind { kPlaypenWaitObject = 0, kPlaypenWaitMutex = 1, kPlaypenWaitThread = 2 };

enum PlaypenWaitEnd {
  kPlaypenWaitReady = 0,
  kPlaypenWaitTime = 1,         ///< the deadline has passed
  kPlaypenWaitInterrupted = 2,  ///< another thread cancels this one
  kPlaypenWaitReleased = 3,     ///< time is no longer virtual: the thread must wait in real time
};

/// Exported by the preloaded library. Registers the hooks, which must never be destroyed. @return
/// 1, or 0 if the versions differ.
using PlaypenVirtualTimeRegister = int (*)(const PlaypenVirtualTimeHooks* hooks);

}  // extern "C"

#define PLAYPEN_VIRTUAL_TIME_VERSION 2
#define PLAYPEN_VIRTUAL_TIME_REGISTER "playpen_virtual_time_register"

namespace playerlike {

/// The value of time() at the start of a program: 2026-01-01 00:00 UTC.
inline constexpr long long kVirtualEpoch_s = 1'767'225'600;
/// The value of CLOCK_MONOTONIC at the start of a program. Not 0, which programs tend to use for
/// "never".
inline constexpr long long kVirtualUptime_s = 1'000;

}  // namespace playerlike
