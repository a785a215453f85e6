// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Threads: start, end, join, cancellation and signals.
#include <signal.h>
#include <stdlib.h>

#include "virtual_time/preload/common.h"

// Functions that replace the C library's must be in the global namespace.
using namespace playerlike::preload;  // NOLINT(google-build-using-namespace)

namespace {

NEXT(pthread_create);
NEXT(pthread_join);
NEXT(pthread_exit);
NEXT(pthread_cancel);
NEXT(pthread_kill);
NEXT(pthread_timedjoin_np);
NEXT(pthread_clockjoin_np);
NEXT(pthread_tryjoin_np);
NEXT(exit);

struct ThreadStart {
  void* (*function)(void*);
  void* argument;
  unsigned long long number;
};

void* begin_thread(void* start_of_thread) {
  const ThreadStart start = *static_cast<ThreadStart*>(start_of_thread);
  free(start_of_thread);
  if (const auto* const table = playpen()) table->thread_begun(start.number);
  return start.function(start.argument);
}

}  // namespace

EXPORTED int pthread_create(pthread_t* __restrict thread, const pthread_attr_t* __restrict settings,
                            void* (*function)(void*), void* __restrict argument) noexcept {
  const auto* const table = playpen();
  const unsigned long long number =
      table == nullptr
          ? 0
          : table->begin_thread(CALLER, reinterpret_cast<const void*>(function), argument);
  auto* const start =
      number == 0 ? nullptr : static_cast<ThreadStart*>(malloc(sizeof(ThreadStart)));
  if (start == nullptr) {
    if (number != 0) table->thread_failed(number);
    return next_pthread_create(thread, settings, function, argument);
  }
  *start = {function, argument, number};
  const int error = next_pthread_create(thread, settings, begin_thread, start);
  if (error != 0) {
    free(start);
    table->thread_failed(number);
  } else {
    table->thread_started(number, reinterpret_cast<const void*>(*thread));
  }
  return error;
}

namespace {

/// Waits virtually until a thread has ended, except for its exit in the system. @return 0 or
/// ETIMEDOUT.
int wait_for_end(pthread_t thread, const Deadline& deadline) {
  const auto* const handle = reinterpret_cast<const void*>(thread);
  const auto* const table = playpen();
  while (table != nullptr && table->thread_lives(handle) != 0) {
    const int end = wait_virtually(handle, kPlaypenWaitThread, deadline, nullptr, 0);
    if (end < 0) break;
    pthread_testcancel();
    if (end == kPlaypenWaitTime) return ETIMEDOUT;
  }
  return 0;
}

}  // namespace

EXPORTED int pthread_join(pthread_t thread, void** result) {
  wait_for_end(thread, Deadline());
  return next_pthread_join(thread, result);
}

EXPORTED int pthread_tryjoin_np(pthread_t thread, void** result) noexcept {
  const auto* const table = playpen();
  if (table == nullptr || table->takes_turns() == 0) return next_pthread_tryjoin_np(thread, result);
  if (table->thread_lives(reinterpret_cast<const void*>(thread)) != 0) return EBUSY;
  return next_pthread_join(thread, result);
}

EXPORTED int pthread_timedjoin_np(pthread_t thread, void** result, const timespec* time) {
  const Deadline deadline = deadline_of(time, CLOCK_REALTIME, CALLER);
  if (time == nullptr) return pthread_join(thread, result);
  if (wait_for_end(thread, deadline) != 0) return ETIMEDOUT;
  return next_pthread_timedjoin_np(thread, result, &deadline.real);
}

EXPORTED int pthread_clockjoin_np(pthread_t thread, void** result, clockid_t clock,
                                  const timespec* time) {
  const Deadline deadline = deadline_of(time, clock, CALLER);
  if (time == nullptr) return pthread_join(thread, result);
  if (wait_for_end(thread, deadline) != 0) return ETIMEDOUT;
  return next_pthread_clockjoin_np(thread, result, clock, &deadline.real);
}

EXPORTED int pthread_cancel(pthread_t thread) {
  const int result = next_pthread_cancel(thread);
  if (const auto* const table = playpen()) table->cancelled(reinterpret_cast<const void*>(thread));
  return result;
}

EXPORTED int pthread_kill(pthread_t thread, int signal) noexcept {
  const auto* const table = playpen();
  if (table != nullptr && signal > 0) {
    struct sigaction action {};
    const int error = errno;
    const bool handled = sigaction(signal, nullptr, &action) == 0 &&
                         ((action.sa_flags & SA_SIGINFO) != 0 ||
                          (action.sa_handler != SIG_DFL && action.sa_handler != SIG_IGN));
    // Notified before the signal, so that the order in which the other thread sees the two is
    // fixed.
    if (handled) table->signalled(reinterpret_cast<const void*>(thread));
    errno = error;
  }
  return next_pthread_kill(thread, signal);
}

EXPORTED __attribute__((noreturn)) void pthread_exit(void* result) {
  if (const auto* const table = playpen()) table->leaving(0);
  next_pthread_exit(result);
  __builtin_unreachable();
}

EXPORTED __attribute__((noreturn)) void exit(int status) noexcept {
  if (const auto* const table = playpen()) table->leaving(1);
  next_exit(status);
  __builtin_unreachable();
}
