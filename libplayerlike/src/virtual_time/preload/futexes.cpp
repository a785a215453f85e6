// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// The system call futex, with which libstdc++ and other libraries wait.
#include <limits.h>
#include <linux/futex.h>
#include <stdarg.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "virtual_time/preload/common.h"

// Functions that replace the C library's must be in the global namespace.
using namespace playerlike::preload;  // NOLINT(google-build-using-namespace)

namespace {

NEXT(syscall);

int word_differs(const void* word, unsigned value) {
  return __atomic_load_n(static_cast<const unsigned*>(word), __ATOMIC_SEQ_CST) != value ? 1 : 0;
}

/// @return whether the wait was virtual; `result` is its result then.
bool wait_for_futex(unsigned* word, int operation, unsigned value, const timespec* time,
                    unsigned bits, const void* caller, long& result, timespec& real) {
  const auto* const table = playpen();
  if (table == nullptr || table->takes_turns() == 0) return false;
  Deadline deadline;
  if ((operation & FUTEX_CMD_MASK) == FUTEX_WAIT_BITSET) {
    if (bits != FUTEX_BITSET_MATCH_ANY) return false;
    deadline = deadline_of(
        time, (operation & FUTEX_CLOCK_REALTIME) != 0 ? CLOCK_REALTIME : CLOCK_MONOTONIC, caller);
    real = deadline.real;
  } else if (time != nullptr) {
    long long now_ns = 0;
    if (!is_duration(*time) || !virtual_now(now_ns, false, caller)) return false;
    deadline.is_virtual = true;
    deadline.elapsed_ns = now_ns + nanoseconds(*time);
  }
  if (word_differs(word, value) != 0) {
    errno = EAGAIN;
    result = -1;
    return true;
  }
  const int end = wait_virtually(word, kPlaypenWaitObject, deadline, word_differs, value);
  if (end < 0) return false;
  result = end == kPlaypenWaitTime ? -1 : 0;
  if (end == kPlaypenWaitTime) errno = ETIMEDOUT;
  return true;
}

/// @return the number of threads woken.
int wake_futex(const unsigned* word, int most) {
  const auto* const table = playpen();
  if (table == nullptr || __atomic_load_n(table->object_waits, __ATOMIC_SEQ_CST) <= 0) return 0;
  return table->wake(word, most);
}

}  // namespace

// libstdc++ and other libraries call futex through this function.
EXPORTED long syscall(long number, ...) noexcept {
  va_list arguments;
  va_start(arguments, number);
  long a[6];
  for (long& argument : a) argument = va_arg(arguments, long);
  va_end(arguments);
  const auto real = [&] { return next_syscall(number, a[0], a[1], a[2], a[3], a[4], a[5]); };
  if (playpen() == nullptr) return real();
  if (number == SYS_nanosleep) {
    return nanosleep_from(reinterpret_cast<const timespec*>(a[0]),
                          reinterpret_cast<timespec*>(a[1]), CALLER);
  }
  if (number == SYS_clock_nanosleep) {
    const int error = clock_nanosleep_from(static_cast<clockid_t>(a[0]), static_cast<int>(a[1]),
                                           reinterpret_cast<const timespec*>(a[2]),
                                           reinterpret_cast<timespec*>(a[3]), CALLER);
    if (error == 0) return 0;
    errno = error;
    return -1;
  }
  if (number != SYS_futex) return real();
  auto* const word = reinterpret_cast<unsigned*>(a[0]);
  const int operation = static_cast<int>(a[1]);
  timespec until{};
  long result = 0;
  switch (operation & FUTEX_CMD_MASK) {
    case FUTEX_WAIT:
    case FUTEX_WAIT_BITSET:
      if (wait_for_futex(word, operation, static_cast<unsigned>(a[2]),
                         reinterpret_cast<const timespec*>(a[3]), static_cast<unsigned>(a[5]),
                         CALLER, result, until)) {
        return result;
      }
      if (until.tv_sec != 0 && a[3] != 0) a[3] = reinterpret_cast<long>(&until);
      return real();
    case FUTEX_WAKE:
    case FUTEX_WAKE_BITSET: {
      const int most = static_cast<int>(a[2]);
      const int woken = wake_futex(word, most);
      if (woken >= most) return woken;
      a[2] = most - woken;
      result = real();
      return result < 0 ? result : result + woken;
    }
    case FUTEX_REQUEUE:
    case FUTEX_CMP_REQUEUE:
    case FUTEX_WAKE_OP:
      result = real();
      if (result >= 0) {
        wake_futex(word, INT_MAX);
        wake_futex(reinterpret_cast<const unsigned*>(a[4]), INT_MAX);
      }
      return result;
    default:
      return real();
  }
}
