// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file The library that `playpen run` preloads into client programs. It replaces the functions of
/// the C library that wait for time to pass, or read it, and asks Playpen in the same process what
/// to do. While no Playpen has registered, as in other programs and in children, it forwards all
/// calls.
///
/// It uses the C library only, so that it can be loaded into any program. Each of its sources
/// includes this header first.

#ifndef _GNU_SOURCE
#define _GNU_SOURCE
#endif
// Fortified inline forms must not replace the functions that are defined here.
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

/// The registered hooks; nullptr: none.
inline std::atomic<const PlaypenVirtualTimeHooks*> hooks{nullptr};
inline const PlaypenVirtualTimeHooks* playpen() { return hooks.load(std::memory_order_acquire); }

/// Whether a call comes from the program and not from a library.
bool is_programs(const void* caller);

// --- The C library's own functions

/// The next definition of a function after this library's. @param version  the newest version, for
/// a function that the C library has in several: the plain look-up may find the oldest.
void* find_next(const char* name, const char* version);

/// The real function that this library replaces.
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

// Named like the real functions. The types of the functions are those of the headers; their
// attributes do not matter here.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wignored-attributes"
#endif
#define NEXT(function) constinit Next<decltype(::function)> next_##function(#function)
#define NEXT_CONDITION(function) \
  constinit Next<decltype(::function)> next_##function(#function, kConditions)

// --- Sleeping

/// While an object exists, its thread cannot be cancelled.
class NotCancelled {
 public:
  NotCancelled() { pthread_setcancelstate(PTHREAD_CANCEL_DISABLE, &before_); }
  NotCancelled(const NotCancelled&) = delete;
  NotCancelled& operator=(const NotCancelled&) = delete;
  ~NotCancelled() { pthread_setcancelstate(before_, nullptr); }

 private:
  int before_ = PTHREAD_CANCEL_ENABLE;
};

enum class SleepResult { kNo, kYes, kInterrupted };

/// Advances simulated time instead of sleeping, in functions that are cancellation points.
/// @param left_ns  receives the remaining time if a signal ends the sleep.
SleepResult sleep_cancellably(long long duration_ns, const void* caller, long long& left_ns);

/// Sets errno to EINTR and returns -1 after a signal; otherwise returns 0.
int result_of(SleepResult slept);

/// nanosleep() and clock_nanosleep(), also called as system calls.
int nanosleep_from(const timespec* duration, timespec* rest, const void* caller);
int clock_nanosleep_from(clockid_t clock, int flags, const timespec* time, timespec* rest,
                         const void* caller);

// --- Time

/// Reads the time since the program's start, if time is virtual for this thread.
bool virtual_now(long long& elapsed_ns, bool ask, const void* caller);

/// Lengthens a wait of zero time, so that loops of such waits end.
inline long long at_least_1us(long long duration_ns) {
  return duration_ns > 0 ? duration_ns : 1'000;
}

inline long long nanoseconds(const timespec& time) {
  return time.tv_sec * kSecond_ns + time.tv_nsec;
}

inline timespec to_timespec(long long time_ns) {
  return {static_cast<time_t>(time_ns / kSecond_ns), static_cast<long>(time_ns % kSecond_ns)};
}

/// Whether a time fits into 64 bits of nanoseconds.
bool is_duration(const timespec& time);

/// The value of a clock at the program's start [ns]; < 0 for clocks that stay real.
long long clock_start(clockid_t clock);

/// The deadline of a wait.
struct Deadline {
  long long elapsed_ns = -1;  ///< since the program's start; < 0: none, or on a real clock
  bool is_virtual = false;
  timespec real{};  ///< for a wait in real time
};

/// @param time  nullptr: no deadline.
Deadline deadline_of(const timespec* time, clockid_t clock, const void* caller);

// --- Waiting

using IsReady = int (*)(const void* object, unsigned value);

/// Waits until another thread wakes this one, or until `is_ready` says that the wait is over.
/// @param before  called when the wait has begun, so that no wake-up is missed.
/// @return a PlaypenWaitEnd; < 0: the thread must wait in real time.
template <typename Before>
int wait_virtually(const void* object, int kind, const Deadline& deadline, IsReady is_ready,
                   unsigned value, Before before) {
  const auto* const table = playpen();
  const bool real = deadline.elapsed_ns < 0 && deadline.real.tv_sec != 0;
  if (table == nullptr || real) return -1;
  const int error = errno;
  const NotCancelled whole;
  const int begun = table->begin_wait(object, kind, deadline.elapsed_ns, is_ready, value);
  if (begun == 0) return -1;
  if (begun == 2) return kPlaypenWaitReady;
  before();
  const int end = table->finish_wait();
  errno = error;
  return end;
}

inline int wait_virtually(const void* object, int kind, const Deadline& deadline, IsReady is_ready,
                          unsigned value) {
  return wait_virtually(object, kind, deadline, is_ready, value, [] {});
}

/// Wakes up to `most` threads that wait for an object.
void wake(const void* object, int most);

}  // namespace playerlike::preload
