// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// What the preloaded library (preload/) and Playpen in the same process say to each other. A C
/// interface between binaries that may have been built apart: what changes gets another version.
/// See docs/virtual_time.md.
extern "C" {

/// What Playpen does for the functions that the preloaded library stands in for. None throws, and
/// all are called by the thread that called such a function. `caller` is the address that it was
/// called from.
struct PlaypenVirtualTimeHooks {
  int version;  ///< PLAYPEN_VIRTUAL_TIME_VERSION
  /// How many threads wait for a mutex virtually, or are about to take one they have waited for;
  /// and how many wait for other objects. Atomic.
  const int* mutex_waits;
  const int* object_waits;
  /// Lets simulated time pass for the calling thread [ns], > 0.
  /// @param left_ns  set to what is left of it, if a signal ended the sleep.
  /// @return 1 if it did; 2 if a signal ended it; 0: the thread is to wait for real.
  int (*sleep)(long long duration_ns, const void* caller, long long* left_ns);
  /// Tells the time since the program's start [ns].
  /// @param ask  1 if the program asked for it, so that somebody who does nothing but ask gets on.
  /// @return 1 if it did; 0: the real clock is to be asked.
  int (*now)(long long* elapsed_ns, int ask, const void* caller);
  /// The calling thread is about to start another one.
  /// @return a number for it, > 0; 0 if it does not matter.
  unsigned long long (*begin_thread)(const void* caller, const void* start, const void* argument);
  /// It has started it.
  void (*thread_started)(unsigned long long number, const void* handle);
  /// It could not be started.
  void (*thread_failed)(unsigned long long number);
  /// The calling thread is that one. Returns when it is its turn.
  void (*thread_begun)(unsigned long long number);
  /// The calling thread is about to wait for something of another one, an object that is known by
  /// where it lies (a thread by its pthread_t). From now on wake() finds it.
  /// @param kind         a PlaypenWaitKind.
  /// @param deadline_ns  since the program's start; < 0: none.
  /// @param is_there     nullptr, or tells whether it need not wait (any longer); of the object and
  ///                     the value. Asked with locks held: must not wait.
  /// @return 1: finish_wait() must be called; 2: it is there; 0: the thread is to wait for real.
  int (*begin_wait)(const void* object, int kind, long long deadline_ns,
                    int (*is_there)(const void*, unsigned), unsigned value);
  /// Waits. @return a PlaypenWaitEnd.
  int (*finish_wait)();
  /// The calling thread has done what others wait for. @return how many it has woken.
  int (*wake)(const void* object, int most);
  /// Whether the calling thread is to wait virtually for a mutex that it cannot take at once: that
  /// with this system's number holds it and waits for its turn.
  int (*waits_for_turn)(int owner);
  /// Whether somebody has waited for this mutex and is about to take it.
  int (*mutex_is_wanted)(const void* mutex);
  /// Whether a thread with this pthread_t takes turns and has not ended.
  int (*thread_lives)(const void* handle);
  /// Somebody cancels that thread: what it waits for ends.
  void (*cancelled)(const void* handle);
  /// Somebody sends a signal to that thread that it will handle: its sleep ends.
  void (*signalled)(const void* handle);
  /// The calling thread lets others go on.
  void (*yield)();
  /// The calling thread is about to end (pthread_exit), or the process (exit).
  void (*leaving)(int process);
  /// Whether code is the program's own, in a thread that takes turns; and only the latter.
  int (*is_programs)(const void* caller);
  int (*takes_turns)();
  /// The program uses real time, which cannot be simulated. Says so once.
  void (*waits_for_real)(const char* what);
};

enum PlaypenWaitKind { kPlaypenWaitObject = 0, kPlaypenWaitMutex = 1, kPlaypenWaitThread = 2 };

enum PlaypenWaitEnd {
  kPlaypenWaitThere = 0,
  kPlaypenWaitTime = 1,         ///< the deadline has come
  kPlaypenWaitInterrupted = 2,  ///< somebody cancels the thread
  kPlaypenWaitReleased = 3,     ///< time is not virtual any more: the thread is to wait for real
};

/// Offered by the preloaded library: gives it the hooks, which are to live for ever.
/// @return 1, or 0 if the versions do not match.
using PlaypenVirtualTimeRegister = int (*)(const PlaypenVirtualTimeHooks* hooks);

}  // extern "C"

#define PLAYPEN_VIRTUAL_TIME_VERSION 2
#define PLAYPEN_VIRTUAL_TIME_REGISTER "playpen_virtual_time_register"

namespace playerlike {

/// What time() is at the start of a program: 2026-01-01 00:00 UTC.
inline constexpr long long kVirtualEpoch_s = 1'767'225'600;
/// What CLOCK_MONOTONIC is then. Not 0, which programs like to take for "never".
inline constexpr long long kVirtualUptime_s = 1'000;

}  // namespace playerlike
