// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Clocks, and functions that use real clocks and cannot be simulated.
#include <string.h>
#include <sys/sem.h>
#include <sys/time.h>
#include <sys/timerfd.h>
#include <unistd.h>

#include "virtual_time/preload/common.h"

// Functions that replace the C library's must be in the global namespace.
using namespace playerlike::preload;  // NOLINT(google-build-using-namespace)

namespace {

NEXT(time);
NEXT(clock_gettime);
NEXT(timespec_get);
NEXT(clock);
NEXT(alarm);
NEXT(ualarm);
NEXT(timer_settime);
NEXT(timerfd_settime);
NEXT(semtimedop);
constinit Next<int(int, const itimerval*, itimerval*)> next_setitimer("setitimer");
constinit Next<int(timeval*, void*)> next_gettimeofday("gettimeofday");

bool virtual_realtime(timespec& time, const void* caller) {
  long long elapsed_ns = 0;
  if (!virtual_now(elapsed_ns, true, caller)) return false;
  time = to_timespec(playerlike::kVirtualEpoch_s * kSecond_ns + elapsed_ns);
  return true;
}

}  // namespace

EXPORTED time_t time(time_t* result) noexcept {
  timespec now{};
  if (!virtual_realtime(now, CALLER)) return next_time(result);
  if (result != nullptr) *result = now.tv_sec;
  return now.tv_sec;
}

// The type of the second parameter differs between versions of the C library.
EXPORTED int gettimeofday(timeval* __restrict result, void* __restrict zone) noexcept {
  timespec now{};
  if (!virtual_realtime(now, CALLER)) return next_gettimeofday(result, zone);
  *result = {now.tv_sec, static_cast<suseconds_t>(now.tv_nsec / 1'000)};
  if (zone != nullptr) memset(zone, 0, sizeof(struct timezone));
  return 0;
}

EXPORTED int clock_gettime(clockid_t clock, timespec* result) noexcept {
  const long long start_ns = clock_start(clock);
  long long elapsed_ns = 0;
  // Libraries measure durations with the clocks of processor time, while programs poll them.
  if (start_ns < 0 || (start_ns == 0 && !is_programs(CALLER)) ||
      !virtual_now(elapsed_ns, true, CALLER)) {
    return next_clock_gettime(clock, result);
  }
  *result = to_timespec(start_ns + elapsed_ns);
  return 0;
}

EXPORTED int timespec_get(timespec* result, int base) noexcept {
  if (base != TIME_UTC || !virtual_realtime(*result, CALLER)) {
    return next_timespec_get(result, base);
  }
  return base;
}

EXPORTED clock_t clock() noexcept {
  long long elapsed_ns = 0;
  if (!is_programs(CALLER) || !virtual_now(elapsed_ns, true, CALLER)) return next_clock();
  return static_cast<clock_t>(elapsed_ns / (kSecond_ns / CLOCKS_PER_SEC));
}

// --- Real-time facilities that cannot be simulated

namespace {

void report_real_time(const char* what, const void* caller) {
  if (!is_programs(caller)) return;
  const int error = errno;
  playpen()->waits_for_real(what);
  errno = error;
}

}  // namespace

EXPORTED unsigned alarm(unsigned seconds) noexcept {
  if (seconds != 0) report_real_time("alarm()", CALLER);
  return next_alarm(seconds);
}

EXPORTED useconds_t ualarm(useconds_t value, useconds_t interval) noexcept {
  if (value != 0) report_real_time("ualarm()", CALLER);
  return next_ualarm(value, interval);
}

// The type of the first parameter differs in C.
EXPORTED int setitimer(int which, const itimerval* __restrict value,
                       itimerval* __restrict old) noexcept {
  if (value != nullptr && (value->it_value.tv_sec != 0 || value->it_value.tv_usec != 0)) {
    report_real_time("setitimer()", CALLER);
  }
  return next_setitimer(which, value, old);
}

EXPORTED int timer_settime(timer_t timer, int flags, const itimerspec* __restrict value,
                           itimerspec* __restrict old) noexcept {
  if (value != nullptr && (value->it_value.tv_sec != 0 || value->it_value.tv_nsec != 0)) {
    report_real_time("timer_settime()", CALLER);
  }
  return next_timer_settime(timer, flags, value, old);
}

EXPORTED int timerfd_settime(int timer, int flags, const itimerspec* value,
                             itimerspec* old) noexcept {
  if (value != nullptr && (value->it_value.tv_sec != 0 || value->it_value.tv_nsec != 0)) {
    report_real_time("timerfd_settime()", CALLER);
  }
  return next_timerfd_settime(timer, flags, value, old);
}

EXPORTED int semtimedop(int semaphores, sembuf* operations, size_t count,
                        const timespec* timeout) noexcept {
  if (timeout != nullptr) report_real_time("semtimedop()", CALLER);
  return next_semtimedop(semaphores, operations, count, timeout);
}
