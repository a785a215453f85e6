// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pthread.h>

/// What the preloaded library (preload.cpp) and Playpen in the same process say to each other. A C
/// interface between binaries that may have been built apart: what changes gets another version.
/// See docs/virtual_time.md.
extern "C" {

/// What Playpen does for the functions that the preloaded library stands in for. None throws, and
/// all are called by the thread that called such a function. `caller` is the address that it was
/// called from.
struct PlaypenVirtualTimeHooks {
  int version;  ///< PLAYPEN_VIRTUAL_TIME_VERSION
  /// Lets simulated time pass for the calling thread [ns], > 0.
  /// @return 1 if it did; 0: the thread is to wait for real.
  int (*sleep)(long long duration_ns, const void* caller);
  /// Tells the time since the program's start [ns].
  /// @param ask  1 if the program asked for it, so that somebody who does nothing but ask gets on.
  /// @return 1 if it did; 0: the real clock is to be asked.
  int (*now)(long long* elapsed_ns, int ask, const void* caller);
  /// The calling thread is about to start another one.
  /// @return a number for it, > 0; 0 if it does not matter.
  unsigned long long (*begin_thread)(const void* caller, const void* start, const void* argument);
  /// That thread has begun; called by it.
  void (*thread_begun)(unsigned long long number);
  /// It could not be started.
  void (*thread_failed)(unsigned long long number);
  /// The calling thread is about to wait, without a deadline, for something of another one: its end
  /// (`what` is its pthread_t), or a condition variable or semaphore there.
  /// @return 1 if end_wait() is to be called after that.
  int (*begin_wait)(const void* what);
  void (*end_wait)();
  /// The calling thread is about to wake one who waits for that, or all.
  void (*signalled)(const void* what, int all);
};

/// Offered by the preloaded library: gives it the hooks, which are to live for ever.
/// @return 1, or 0 if the versions do not match.
using PlaypenVirtualTimeRegister = int (*)(const PlaypenVirtualTimeHooks* hooks);

}  // extern "C"

#define PLAYPEN_VIRTUAL_TIME_VERSION 1
#define PLAYPEN_VIRTUAL_TIME_REGISTER "playpen_virtual_time_register"

namespace playerlike {

/// What time() is at the start of a program: 2026-01-01 00:00 UTC.
inline constexpr long long kVirtualEpoch_s = 1'767'225'600;
/// What CLOCK_MONOTONIC is then. Not 0, which programs like to take for "never".
inline constexpr long long kVirtualUptime_s = 1'000;

}  // namespace playerlike
