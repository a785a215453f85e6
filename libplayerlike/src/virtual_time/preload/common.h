// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The library that `playpen run` preloads into client programs: stands in for the functions of the
/// C library that wait for time to pass, or tell it, and asks Playpen in the same process what to
/// do. As long as no Playpen has registered, in other programs and in children, it passes all on.
///
/// It uses the C library only, so that it can be loaded into anything. This is what its sources
/// have in common; each includes it first.

#ifndef _GNU_SOURCE
#define _GNU_SOURCE
#endif
// What is defined here must not be replaced by inline forms.
#undef _FORTIFY_SOURCE

#include <dlfcn.h>
#include <errno.h>
#include <pthread.h>
#include <time.h>

#include <atomic>

#include "virtual_time/hooks.h"

#define EXPORTED extern "C" __attribute__((visibility("default")))
#define CALLER __builtin_return_address(0)

namespace playerlike::preload {

constexpr long long kSecond_ns = 1'000'000'000;

/// What Playpen has registered; nullptr: nothing.
inline std::atomic<const PlaypenVirtualTimeHooks*> hooks{nullptr};
inline const PlaypenVirtualTimeHooks* playpen() { return hooks.load(std::memory_order_acquire); }

/// Whether a call comes from the program, not from a library.
bool is_programs(const void* caller);

// --- The C library's own functions

/// The next definition of a function after this library's. Of functions that the C library has in
/// several versions, the newest: the plain lookup may find the oldest.
void* find_next(const char* name, const char* version);

/// The real function behind one that this library stands in for.
template <typename Function>
class Next {
 public:
  constexpr explicit Next(const char* name, const char* version = nullptr)
      : name_(name), version_(version) {}
  template <typename... Arguments>
  auto operator()(Arguments... arguments) {
    void* function = found_.load(std::memory_order_acquire);
    if (function == nullptr) {
      function = find_next(name_, version_);
      found_.store(function, std::memory_order_release);
    }
    return reinterpret_cast<Function*>(function)(arguments...);
  }

 private:
  const char* name_;
  const char* version_;
  std::atomic<void*> found_{nullptr};
};

#if defined(__x86_64__)
constexpr const char* kConditions = "GLIBC_2.3.2";
#else
constexpr const char* kConditions = nullptr;
#endif

// Named for what they stand for; the function types are those of the headers, whose attributes do
// not matter here.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wignored-attributes"
#endif
#define NEXT(function) constinit Next<decltype(::function)> next_##function(#function)
#define NEXT_CONDITION(function) \
  constinit Next<decltype(::function)> next_##function(#function, kConditions)

// --- Sleeping

/// While one lives, its thread is not cancelled.
class NotCancelled {
 public:
  NotCancelled() { pthread_setcancelstate(PTHREAD_CANCEL_DISABLE, &before_); }
  NotCancelled(const NotCancelled&) = delete;
  NotCancelled& operator=(const NotCancelled&) = delete;
  ~NotCancelled() { pthread_setcancelstate(before_, nullptr); }

 private:
  int before_ = PTHREAD_CANCEL_ENABLE;
};

enum class Slept { kNo, kYes, kInterrupted };

/// Lets simulated time pass instead of waiting, in functions in which a thread may be cancelled.
/// @param left_ns  set to what is left if a signal ends that.
Slept sleep_cancellably(long long duration_ns, const void* caller, long long& left_ns);

/// For functions that are -1 and EINTR after a signal.
int result_of(Slept slept);

/// nanosleep() and clock_nanosleep(), also as system calls.
int nanosleep_from(const timespec* duration, timespec* rest, const void* caller);
int clock_nanosleep_from(clockid_t clock, int flags, const timespec* time, timespec* rest,
                         const void* caller);

// --- Time

/// Time since the program's start, if that is virtual for this thread.
bool virtual_now(long long& elapsed_ns, bool ask, const void* caller);

/// A wait for no time at all is one for the least time, so that loops of such waits end.
inline long long at_least_one(long long duration_ns) {
  return duration_ns > 0 ? duration_ns : 1'000;
}

inline long long nanoseconds(const timespec& time) {
  return time.tv_sec * kSecond_ns + time.tv_nsec;
}

inline timespec to_timespec(long long time_ns) {
  return {static_cast<time_t>(time_ns / kSecond_ns), static_cast<long>(time_ns % kSecond_ns)};
}

/// Whether it fits into nanoseconds.
bool is_duration(const timespec& time);

/// What a clock shows at the program's start [ns]; < 0 for clocks that stay real.
long long clock_start(clockid_t clock);

/// A moment that a wait is to end.
struct Deadline {
  long long elapsed_ns = -1;  ///< since the program's start; < 0: never, or of the real clock
  bool is_virtual = false;
  timespec real{};  ///< for a wait for real
};

/// @param time  nullptr: never.
Deadline deadline_of(const timespec* time, clockid_t clock, const void* caller);

// --- Waiting

using IsThere = int (*)(const void* object, unsigned value);

/// Waits until somebody wakes the thread, or until what it waits for is there.
/// @param before  done when the wait has begun: nobody who wakes the thread is missed.
/// @return a PlaypenWaitEnd; < 0: the thread is to wait for real.
template <typename Before>
int wait_virtually(const void* object, int kind, const Deadline& deadline, IsThere is_there,
                   unsigned value, Before before) {
  const auto* const table = playpen();
  const bool real = deadline.elapsed_ns < 0 && deadline.real.tv_sec != 0;
  if (table == nullptr || real) return -1;
  const int error = errno;
  const NotCancelled whole;
  const int begun = table->begin_wait(object, kind, deadline.elapsed_ns, is_there, value);
  if (begun == 0) return -1;
  if (begun == 2) return kPlaypenWaitThere;
  before();
  const int end = table->finish_wait();
  errno = error;
  return end;
}

inline int wait_virtually(const void* object, int kind, const Deadline& deadline, IsThere is_there,
                          unsigned value) {
  return wait_virtually(object, kind, deadline, is_there, value, [] {});
}

/// Tells that what others wait for may be there.
void wake(const void* object, int most);

}  // namespace playerlike::preload
