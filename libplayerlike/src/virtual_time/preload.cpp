// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// The library that `playpen run` preloads into client programs: stands in for the functions of the
// C library that wait for time to pass, or tell it, and asks Playpen in the same process what to
// do. As long as no Playpen has registered, in other programs and in children, it passes all on.
//
// It uses the C library only, so that it can be loaded into anything.
#ifndef _GNU_SOURCE
#define _GNU_SOURCE
#endif
// What is defined here must not be replaced by inline forms.
#undef _FORTIFY_SOURCE

#include <dlfcn.h>
#include <errno.h>
#include <poll.h>
#include <pthread.h>
#include <semaphore.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/select.h>
#include <sys/time.h>
#include <time.h>
#include <unistd.h>

#include <atomic>
#include <cstddef>
#include <cstdint>

#include "virtual_time/hooks.h"

#define EXPORTED extern "C" __attribute__((visibility("default")))
#define CALLER __builtin_return_address(0)

namespace {

constexpr long long kSecond_ns = 1'000'000'000;
// How long a wait for another thread sleeps before it looks again.
constexpr long long kSlice_ns = 10'000'000;

std::atomic<const PlaypenVirtualTimeHooks*> hooks{nullptr};

const PlaypenVirtualTimeHooks* playpen() { return hooks.load(std::memory_order_acquire); }

void forget_playpen() { hooks.store(nullptr); }

/// The next definition of a function after this library's. Of functions that the C library has in
/// several versions, the newest: the plain lookup may find the oldest.
void* find_next(const char* name, const char* version) {
  void* const plain = dlsym(RTLD_NEXT, name);
  Dl_info info{};
  if (version != nullptr && plain != nullptr && dladdr(plain, &info) != 0 &&
      info.dli_fname != nullptr && strstr(info.dli_fname, "/libc.so") != nullptr) {
    if (void* const exact = dlvsym(RTLD_NEXT, name, version)) return exact;
  }
  return plain;
}

/// The real function behind one of those below.
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

NEXT(sleep);
NEXT(usleep);
NEXT(nanosleep);
NEXT(clock_nanosleep);
NEXT(select);
NEXT(pselect);
NEXT(poll);
NEXT(ppoll);
NEXT(time);
NEXT(clock_gettime);
NEXT(timespec_get);
NEXT(sem_timedwait);
NEXT(sem_clockwait);
NEXT(pthread_mutex_timedlock);
NEXT(pthread_mutex_clocklock);
NEXT(pthread_create);
NEXT(pthread_join);
NEXT(sem_wait);
NEXT(sem_post);
NEXT_CONDITION(pthread_cond_wait);
NEXT_CONDITION(pthread_cond_timedwait);
NEXT_CONDITION(pthread_cond_signal);
NEXT_CONDITION(pthread_cond_broadcast);
NEXT(pthread_cond_clockwait);
constinit Next<int(timeval*, void*)> next_gettimeofday("gettimeofday");
constinit Next<int(pollfd*, nfds_t, int, std::size_t)> next_poll_chk("__poll_chk");
constinit Next<int(pollfd*, nfds_t, const timespec*, const sigset_t*, std::size_t)> next_ppoll_chk(
    "__ppoll_chk");

/// Lets simulated time pass instead of waiting. @return whether that was done.
bool sleep_virtually(long long duration_ns, const void* caller) {
  const auto* const table = playpen();
  if (table == nullptr) return false;
  const int error = errno;
  // The simulation must not be left in the middle of a step: the thread ends after it.
  int cancel_state = PTHREAD_CANCEL_ENABLE;
  pthread_setcancelstate(PTHREAD_CANCEL_DISABLE, &cancel_state);
  const bool done = table->sleep(duration_ns, caller) != 0;
  pthread_setcancelstate(cancel_state, nullptr);
  errno = error;
  return done;
}

/// The same for functions in which a thread may be cancelled.
bool sleep_cancellably(long long duration_ns, const void* caller) {
  if (!sleep_virtually(duration_ns, caller)) return false;
  pthread_testcancel();
  return true;
}

/// Time since the program's start, if that is virtual for this thread.
bool virtual_now(long long& elapsed_ns, bool ask, const void* caller) {
  const auto* const table = playpen();
  if (table == nullptr) return false;
  const int error = errno;
  const bool told = table->now(&elapsed_ns, ask ? 1 : 0, caller) != 0;
  errno = error;
  return told;
}

// A wait for no time at all is one for the least time, so that loops of such waits end.
long long at_least_one(long long duration_ns) { return duration_ns > 0 ? duration_ns : 1'000; }

long long nanoseconds(const timespec& time) { return time.tv_sec * kSecond_ns + time.tv_nsec; }

timespec to_timespec(long long time_ns) {
  return {static_cast<time_t>(time_ns / kSecond_ns), static_cast<long>(time_ns % kSecond_ns)};
}

bool is_duration(const timespec& time) {
  constexpr time_t kMost_s = 4'000'000'000;  // more does not fit into nanoseconds; 126 years
  return time.tv_sec >= 0 && time.tv_sec < kMost_s && time.tv_nsec >= 0 &&
         time.tv_nsec < kSecond_ns;
}

/// What a clock shows at the program's start [ns]; < 0 for clocks that stay real.
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
    default:
      return -1;
  }
}

bool virtual_realtime(timespec& time, const void* caller) {
  long long elapsed_ns = 0;
  if (!virtual_now(elapsed_ns, true, caller)) return false;
  time = to_timespec(playerlike::kVirtualEpoch_s * kSecond_ns + elapsed_ns);
  return true;
}

bool no_descriptors(int count, const fd_set* read, const fd_set* write, const fd_set* except) {
  for (int i = 0; i < count; ++i) {
    for (const fd_set* set : {read, write, except}) {
      if (set != nullptr && FD_ISSET(i, set)) return false;
    }
  }
  return true;
}

/// Waits until a deadline of a virtual clock, looking every so often whether try_once() has
/// something to say.
/// @param try_once   >= 0: the result.
/// @param wait_once  waits for real, a slice at most; as try_once().
/// @return the result; -1 when the deadline has come; -2: the deadline is of the real clock.
template <typename Try, typename Wait>
int wait_virtually(const timespec& deadline, clockid_t clock, const void* caller, Try try_once,
                   Wait wait_once) {
  long long elapsed_ns = 0;
  const long long start_ns = clock_start(clock);
  if (start_ns < 0 || !is_duration(deadline)) return -2;
  for (;;) {
    if (!virtual_now(elapsed_ns, false, caller)) return -2;
    if (const int result = try_once(); result >= 0) return result;
    const long long left_ns = nanoseconds(deadline) - start_ns - elapsed_ns;
    if (left_ns <= 0) return -1;
    if (const int result = wait_once(left_ns < kSlice_ns ? left_ns : kSlice_ns); result >= 0) {
      return result;
    }
  }
}

timespec real_deadline(clockid_t clock, long long duration_ns) {
  timespec now{};
  next_clock_gettime(clock, &now);
  return to_timespec(nanoseconds(now) + duration_ns);
}

/// Tells that somebody is about to be woken, so that time stands until he has been.
void tell_of_signal(const void* what, bool all) {
  if (const auto* const table = playpen()) table->signalled(what, all ? 1 : 0);
}

/// Waits for another thread, meanwhile holding up nobody.
template <typename Wait>
int wait_for_thread(const void* what, Wait wait) {
  const auto* const table = playpen();
  const bool away = table != nullptr && table->begin_wait(what) != 0;
  const int result = wait();
  if (away) {
    const int error = errno;
    table->end_wait();
    errno = error;
  }
  return result;
}

// How often a condition variable was signalled, by a hash of its address: who waits for it
// virtually is not waiting for it really.
std::atomic<unsigned> signals[256];

std::atomic<unsigned>& signals_of(const pthread_cond_t* condition) {
  const auto address = reinterpret_cast<std::uintptr_t>(condition);
  return signals[(address >> 4U ^ address >> 12U) % 256];
}

/// @param real  waits really, until a deadline of the clock.
template <typename Real>
int wait_for_condition(pthread_cond_t* condition, pthread_mutex_t* mutex, const timespec* deadline,
                       clockid_t clock, const void* caller, Real real) {
  const std::atomic<unsigned>& count = signals_of(condition);
  const unsigned before = count.load();
  const int result = wait_virtually(
      *deadline, clock, caller, [&] { return count.load() != before ? 0 : -1; },
      [&](long long slice_ns) {
        pthread_mutex_unlock(mutex);
        const bool slept = sleep_virtually(slice_ns, caller);
        pthread_mutex_lock(mutex);
        if (slept) return -1;
        const timespec until = real_deadline(clock, slice_ns);
        const int woken = real(&until);
        return woken == ETIMEDOUT ? -1 : woken;
      });
  if (result == -2) return real(deadline);
  return result == -1 ? ETIMEDOUT : result;
}

/// For what can be tried: semaphores and mutexes.
/// @param attempt  0 if it has succeeded.
template <typename Attempt>
int wait_by_trying(const timespec& deadline, clockid_t clock, const void* caller, Attempt attempt) {
  const auto once = [&] { return attempt() == 0 ? 0 : -1; };
  return wait_virtually(deadline, clock, caller, once, [&](long long slice_ns) {
    if (!sleep_virtually(slice_ns, caller)) {
      const timespec slice = to_timespec(slice_ns);
      next_nanosleep(&slice, nullptr);
    }
    return -1;
  });
}

}  // namespace

EXPORTED int playpen_virtual_time_register(const PlaypenVirtualTimeHooks* table) {
  if (table->version != PLAYPEN_VIRTUAL_TIME_VERSION) return 0;
  // A forked child has none of the simulation's threads.
  if (playpen() == nullptr) pthread_atfork(nullptr, nullptr, forget_playpen);
  hooks.store(table, std::memory_order_release);
  return 1;
}

// --- Waiting

EXPORTED unsigned sleep(unsigned seconds) {
  if (sleep_cancellably(at_least_one(seconds * kSecond_ns), CALLER)) return 0;
  return next_sleep(seconds);
}

EXPORTED int usleep(useconds_t microseconds) {
  if (sleep_cancellably(at_least_one(microseconds * 1'000LL), CALLER)) return 0;
  return next_usleep(microseconds);
}

EXPORTED int nanosleep(const timespec* duration, timespec* rest) {
  if (duration != nullptr && is_duration(*duration) &&
      sleep_cancellably(at_least_one(nanoseconds(*duration)), CALLER)) {
    return 0;
  }
  return next_nanosleep(duration, rest);
}

EXPORTED int clock_nanosleep(clockid_t clock, int flags, const timespec* time, timespec* rest) {
  const long long start_ns = clock_start(clock);
  if (start_ns >= 0 && time != nullptr && is_duration(*time)) {
    if ((flags & TIMER_ABSTIME) == 0) {
      if (sleep_cancellably(at_least_one(nanoseconds(*time)), CALLER)) return 0;
    } else {
      long long now_ns = 0;
      if (virtual_now(now_ns, false, CALLER)) {
        const long long left_ns = nanoseconds(*time) - start_ns - now_ns;
        if (left_ns <= 0 || sleep_cancellably(left_ns, CALLER)) return 0;
        const timespec left = to_timespec(left_ns);
        return next_clock_nanosleep(clock, 0, &left, rest);
      }
    }
  }
  return next_clock_nanosleep(clock, flags, time, rest);
}

EXPORTED int select(int count, fd_set* read, fd_set* write, fd_set* except, timeval* timeout) {
  if (timeout != nullptr && timeout->tv_sec >= 0 && timeout->tv_usec >= 0 &&
      no_descriptors(count, read, write, except)) {
    const timespec duration = {timeout->tv_sec, 0};
    if (is_duration(duration) &&
        sleep_cancellably(at_least_one(nanoseconds(duration) + timeout->tv_usec * 1'000LL),
                          CALLER)) {
      *timeout = {};  // what is left of it, as Linux has it
      return 0;
    }
  }
  return next_select(count, read, write, except, timeout);
}

EXPORTED int pselect(int count, fd_set* read, fd_set* write, fd_set* except,
                     const timespec* timeout, const sigset_t* mask) {
  if (timeout != nullptr && mask == nullptr && is_duration(*timeout) &&
      no_descriptors(count, read, write, except) &&
      sleep_cancellably(at_least_one(nanoseconds(*timeout)), CALLER)) {
    return 0;
  }
  return next_pselect(count, read, write, except, timeout, mask);
}

EXPORTED int poll(pollfd* descriptors, nfds_t count, int timeout_ms) {
  if (count == 0 && timeout_ms >= 0 &&
      sleep_cancellably(at_least_one(timeout_ms * 1'000'000LL), CALLER)) {
    return 0;
  }
  return next_poll(descriptors, count, timeout_ms);
}

EXPORTED int ppoll(pollfd* descriptors, nfds_t count, const timespec* timeout,
                   const sigset_t* mask) {
  if (count == 0 && timeout != nullptr && mask == nullptr && is_duration(*timeout) &&
      sleep_cancellably(at_least_one(nanoseconds(*timeout)), CALLER)) {
    return 0;
  }
  return next_ppoll(descriptors, count, timeout, mask);
}

// What poll and ppoll are in programs built with _FORTIFY_SOURCE.
// NOLINTBEGIN(readability-identifier-naming): the C library's names
EXPORTED int __poll_chk(pollfd* descriptors, nfds_t count, int timeout_ms, std::size_t size) {
  if (count == 0 && timeout_ms >= 0 &&
      sleep_cancellably(at_least_one(timeout_ms * 1'000'000LL), CALLER)) {
    return 0;
  }
  return next_poll_chk(descriptors, count, timeout_ms, size);
}

EXPORTED int __ppoll_chk(pollfd* descriptors, nfds_t count, const timespec* timeout,
                         const sigset_t* mask, std::size_t size) {
  if (count == 0 && timeout != nullptr && mask == nullptr && is_duration(*timeout) &&
      sleep_cancellably(at_least_one(nanoseconds(*timeout)), CALLER)) {
    return 0;
  }
  return next_ppoll_chk(descriptors, count, timeout, mask, size);
}
// NOLINTEND(readability-identifier-naming)

// --- Clocks

EXPORTED time_t time(time_t* result) noexcept {
  timespec now{};
  if (!virtual_realtime(now, CALLER)) return next_time(result);
  if (result != nullptr) *result = now.tv_sec;
  return now.tv_sec;
}

// Its second parameter has another type in other versions of the C library.
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
  if (start_ns < 0 || !virtual_now(elapsed_ns, true, CALLER)) {
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

// --- Waiting for other threads

EXPORTED int pthread_cond_signal(pthread_cond_t* condition) noexcept {
  signals_of(condition).fetch_add(1);
  tell_of_signal(condition, false);
  return next_pthread_cond_signal(condition);
}

EXPORTED int pthread_cond_broadcast(pthread_cond_t* condition) noexcept {
  signals_of(condition).fetch_add(1);
  tell_of_signal(condition, true);
  return next_pthread_cond_broadcast(condition);
}

EXPORTED int pthread_cond_wait(pthread_cond_t* __restrict condition,
                               pthread_mutex_t* __restrict mutex) {
  return wait_for_thread(condition, [&] { return next_pthread_cond_wait(condition, mutex); });
}

EXPORTED int sem_post(sem_t* semaphore) noexcept {
  tell_of_signal(semaphore, false);
  return next_sem_post(semaphore);
}

EXPORTED int sem_wait(sem_t* semaphore) {
  return wait_for_thread(semaphore, [&] { return next_sem_wait(semaphore); });
}

EXPORTED int pthread_cond_timedwait(pthread_cond_t* __restrict condition,
                                    pthread_mutex_t* __restrict mutex,
                                    const timespec* __restrict deadline) {
  // Its clock is an attribute that cannot be read; the virtual ones are 50 years apart.
  constexpr time_t kBetween_s = playerlike::kVirtualEpoch_s / 2;
  const clockid_t clock = deadline->tv_sec < kBetween_s ? CLOCK_MONOTONIC : CLOCK_REALTIME;
  return wait_for_condition(condition, mutex, deadline, clock, CALLER, [&](const timespec* until) {
    return next_pthread_cond_timedwait(condition, mutex, until);
  });
}

EXPORTED int pthread_cond_clockwait(pthread_cond_t* condition, pthread_mutex_t* mutex,
                                    clockid_t clock, const timespec* deadline) {
  return wait_for_condition(condition, mutex, deadline, clock, CALLER, [&](const timespec* until) {
    return next_pthread_cond_clockwait(condition, mutex, clock, until);
  });
}

namespace {

int semaphore_result(int waited) {
  if (waited == 0) return 0;
  errno = ETIMEDOUT;
  return -1;
}

}  // namespace

EXPORTED int sem_timedwait(sem_t* __restrict semaphore, const timespec* __restrict deadline) {
  const int waited =
      wait_by_trying(*deadline, CLOCK_REALTIME, CALLER, [&] { return sem_trywait(semaphore); });
  return waited == -2 ? next_sem_timedwait(semaphore, deadline) : semaphore_result(waited);
}

EXPORTED int sem_clockwait(sem_t* __restrict semaphore, clockid_t clock,
                           const timespec* __restrict deadline) {
  const int waited =
      wait_by_trying(*deadline, clock, CALLER, [&] { return sem_trywait(semaphore); });
  return waited == -2 ? next_sem_clockwait(semaphore, clock, deadline) : semaphore_result(waited);
}

EXPORTED int pthread_mutex_timedlock(pthread_mutex_t* __restrict mutex,
                                     const timespec* __restrict deadline) noexcept {
  const int waited = wait_by_trying(*deadline, CLOCK_REALTIME, CALLER,
                                    [&] { return pthread_mutex_trylock(mutex); });
  if (waited == -2) return next_pthread_mutex_timedlock(mutex, deadline);
  return waited == 0 ? 0 : ETIMEDOUT;
}

EXPORTED int pthread_mutex_clocklock(pthread_mutex_t* __restrict mutex, clockid_t clock,
                                     const timespec* __restrict deadline) noexcept {
  const int waited =
      wait_by_trying(*deadline, clock, CALLER, [&] { return pthread_mutex_trylock(mutex); });
  if (waited == -2) return next_pthread_mutex_clocklock(mutex, clock, deadline);
  return waited == 0 ? 0 : ETIMEDOUT;
}

namespace {

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
  }
  return error;
}

EXPORTED int pthread_join(pthread_t thread, void** result) {
  return wait_for_thread(reinterpret_cast<const void*>(thread),
                         [&] { return next_pthread_join(thread, result); });
}
