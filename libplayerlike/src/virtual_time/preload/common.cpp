// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "virtual_time/preload/common.h"

#include <string.h>

namespace playerlike::preload {
namespace {

NEXT(clock_gettime);

void forget_playpen() { hooks.store(nullptr); }

/// Advances simulated time instead of sleeping.
/// @param left_ns  receives the remaining time if a signal ends the sleep.
SleepResult sleep_virtually(long long duration_ns, const void* caller, long long& left_ns) {
  const auto* const table = playpen();
  if (table == nullptr) return SleepResult::kNo;
  const int error = errno;
  // Cancellation must not leave the simulation in the middle of a step; it happens afterwards.
  int done = 0;
  {
    const NotCancelled whole;
    done = table->sleep(duration_ns, caller, &left_ns);
  }
  errno = error;
  if (done == 0) return SleepResult::kNo;
  return done == 1 ? SleepResult::kYes : SleepResult::kInterrupted;
}

timespec real_deadline(clockid_t clock, long long duration_ns) {
  timespec now{};
  next_clock_gettime(clock, &now);
  return to_timespec(nanoseconds(now) + (duration_ns > 0 ? duration_ns : 0));
}

}  // namespace

bool is_programs(const void* caller) {
  const auto* const table = playpen();
  if (table == nullptr) return false;
  const int error = errno;
  const bool programs = table->is_programs(caller) != 0;
  errno = error;
  return programs;
}

void* find_next(const char* name, const char* version) {
  void* const plain = dlsym(RTLD_NEXT, name);
  Dl_info info{};
  if (version != nullptr && plain != nullptr && dladdr(plain, &info) != 0 &&
      info.dli_fname != nullptr && strstr(info.dli_fname, "/libc.so") != nullptr) {
    if (void* const exact = dlvsym(RTLD_NEXT, name, version)) return exact;
  }
  return plain;
}

SleepResult sleep_cancellably(long long duration_ns, const void* caller, long long& left_ns) {
  const SleepResult slept = sleep_virtually(duration_ns, caller, left_ns);
  if (slept != SleepResult::kNo) pthread_testcancel();
  return slept;
}

int result_of(SleepResult slept) {
  if (slept == SleepResult::kYes) return 0;
  errno = EINTR;
  return -1;
}

bool virtual_now(long long& elapsed_ns, bool ask, const void* caller) {
  const auto* const table = playpen();
  if (table == nullptr) return false;
  const int error = errno;
  const bool told = table->now(&elapsed_ns, ask ? 1 : 0, caller) != 0;
  errno = error;
  return told;
}

bool is_duration(const timespec& time) {
  constexpr time_t kMost_s = 4'000'000'000;  // 126 years; more seconds overflow 64 bits [ns]
  return time.tv_sec >= 0 && time.tv_sec < kMost_s && time.tv_nsec >= 0 &&
         time.tv_nsec < kSecond_ns;
}

long long clock_start(clockid_t clock) {
  switch (clock) {
    case CLOCK_REALTIME:
    case CLOCK_REALTIME_COARSE:
      return playerlike::kVirtualEpoch_s * kSecond_ns;
    case CLOCK_MONOTONIC:
    case CLOCK_MONOTONIC_COARSE:
    case CLOCK_MONOTONIC_RAW:
    case CLOCK_BOOTTIME:
      return playerlike::kVirtualUptime_s * kSecond_ns;
    case CLOCK_PROCESS_CPUTIME_ID:
    case CLOCK_THREAD_CPUTIME_ID:
      return 0;
    default:
      return -1;
  }
}

Deadline deadline_of(const timespec* time, clockid_t clock, const void* caller) {
  Deadline deadline;
  if (time == nullptr) return deadline;
  deadline.real = *time;
  const long long start_ns = clock_start(clock);
  long long now_ns = 0;
  if (start_ns < 0 || !is_duration(*time) || !virtual_now(now_ns, false, caller)) return deadline;
  const long long elapsed_ns = nanoseconds(*time) - start_ns;
  deadline.is_virtual = true;
  deadline.elapsed_ns = elapsed_ns > 0 ? elapsed_ns : 0;
  deadline.real = real_deadline(clock, elapsed_ns - now_ns);
  return deadline;
}

void wake(const void* object, int most) {
  const auto* const table = playpen();
  if (table == nullptr || __atomic_load_n(table->object_waits, __ATOMIC_SEQ_CST) <= 0) return;
  const int error = errno;
  table->wake(object, most);
  errno = error;
}

EXPORTED int playpen_virtual_time_register(const PlaypenVirtualTimeHooks* table) {
  if (table->version != PLAYPEN_VIRTUAL_TIME_VERSION) return 0;
  // A forked child does not have the simulation's threads.
  if (playpen() == nullptr) pthread_atfork(nullptr, nullptr, forget_playpen);
  hooks.store(table, std::memory_order_release);
  return 1;
}

}  // namespace playerlike::preload
