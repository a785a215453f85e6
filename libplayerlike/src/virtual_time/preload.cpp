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
#include <fcntl.h>
#include <limits.h>
#include <linux/futex.h>
#include <mqueue.h>
#include <poll.h>
#include <pthread.h>
#include <sched.h>
#include <semaphore.h>
#include <signal.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <sys/epoll.h>
#include <sys/select.h>
#include <sys/sem.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/time.h>
#include <sys/timerfd.h>
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
// How long a wait for what no thread of the program brings sleeps before it looks again.
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
NEXT(sched_yield);
NEXT(pthread_exit);
NEXT(pthread_cancel);
NEXT(pthread_kill);
NEXT(pthread_mutex_lock);
NEXT(pthread_mutex_trylock);
NEXT(pthread_mutex_unlock);
NEXT(pthread_timedjoin_np);
NEXT(pthread_clockjoin_np);
NEXT(pthread_tryjoin_np);
NEXT(pthread_rwlock_rdlock);
NEXT(pthread_rwlock_wrlock);
NEXT(pthread_rwlock_timedrdlock);
NEXT(pthread_rwlock_timedwrlock);
NEXT(pthread_rwlock_clockrdlock);
NEXT(pthread_rwlock_clockwrlock);
NEXT(pthread_rwlock_unlock);
NEXT(pthread_barrier_wait);
NEXT(pthread_barrier_destroy);
NEXT(mq_timedreceive);
NEXT(mq_timedsend);
NEXT(sigtimedwait);
NEXT(epoll_wait);
NEXT(epoll_pwait);
NEXT(clock);
NEXT(alarm);
NEXT(ualarm);
NEXT(timer_settime);
NEXT(timerfd_settime);
NEXT(semtimedop);
constinit Next<int(int, const itimerval*, itimerval*)> next_setitimer("setitimer");
NEXT(exit);
NEXT(syscall);
NEXT_CONDITION(pthread_cond_wait);
NEXT_CONDITION(pthread_cond_timedwait);
NEXT_CONDITION(pthread_cond_signal);
NEXT_CONDITION(pthread_cond_broadcast);
NEXT(pthread_cond_clockwait);
constinit Next<int(timeval*, void*)> next_gettimeofday("gettimeofday");
constinit Next<int(pollfd*, nfds_t, int, std::size_t)> next_poll_chk("__poll_chk");
constinit Next<int(pollfd*, nfds_t, const timespec*, const sigset_t*, std::size_t)> next_ppoll_chk(
    "__ppoll_chk");

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

/// Lets simulated time pass instead of waiting.
/// @param left_ns  set to what is left if a signal ends that.
Slept sleep_virtually(long long duration_ns, const void* caller, long long& left_ns) {
  const auto* const table = playpen();
  if (table == nullptr) return Slept::kNo;
  const int error = errno;
  // The simulation must not be left in the middle of a step: the thread ends after it.
  int done = 0;
  {
    const NotCancelled whole;
    done = table->sleep(duration_ns, caller, &left_ns);
  }
  errno = error;
  if (done == 0) return Slept::kNo;
  return done == 1 ? Slept::kYes : Slept::kInterrupted;
}

/// The same for functions in which a thread may be cancelled.
Slept sleep_cancellably(long long duration_ns, const void* caller, long long& left_ns) {
  const Slept slept = sleep_virtually(duration_ns, caller, left_ns);
  if (slept != Slept::kNo) pthread_testcancel();
  return slept;
}

/// For functions that are -1 and EINTR after a signal.
int result_of(Slept slept) {
  if (slept == Slept::kYes) return 0;
  errno = EINTR;
  return -1;
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
    case CLOCK_PROCESS_CPUTIME_ID:
    case CLOCK_THREAD_CPUTIME_ID:
      return 0;
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

timespec real_deadline(clockid_t clock, long long duration_ns) {
  timespec now{};
  next_clock_gettime(clock, &now);
  return to_timespec(nanoseconds(now) + (duration_ns > 0 ? duration_ns : 0));
}

/// A moment that a wait is to end.
struct Deadline {
  long long elapsed_ns = -1;  ///< since the program's start; < 0: never, or of the real clock
  bool is_virtual = false;
  timespec real{};  ///< for a wait for real
};

/// @param time  nullptr: never.
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

int wait_virtually(const void* object, int kind, const Deadline& deadline, IsThere is_there,
                   unsigned value) {
  return wait_virtually(object, kind, deadline, is_there, value, [] {});
}

/// Tells that what others wait for may be there.
void wake(const void* object, int most) {
  const auto* const table = playpen();
  if (table == nullptr || __atomic_load_n(table->object_waits, __ATOMIC_SEQ_CST) <= 0) return;
  const int error = errno;
  table->wake(object, most);
  errno = error;
}

// --- Mutexes

int own_number() {
  static thread_local int number = 0;
  if (number == 0) number = static_cast<int>(next_syscall(SYS_gettid, 0L, 0L, 0L, 0L, 0L, 0L));
  return number;
}

bool mutex_is_free(const pthread_mutex_t* mutex) {
  return __atomic_load_n(&mutex->__data.__lock, __ATOMIC_SEQ_CST) == 0;
}

int is_free(const void* mutex, unsigned /*value*/) {
  return mutex_is_free(static_cast<const pthread_mutex_t*>(mutex)) ? 1 : 0;
}

// Shared with other processes, or with a protocol of its own.
bool is_special(const pthread_mutex_t* mutex) {
  constexpr int kShared = 128;
  constexpr int kInherits = 32;
  constexpr int kProtects = 64;
  return (mutex->__data.__kind & (kShared | kInherits | kProtects)) != 0;
}

/// A mutex whose holder waits for its turn cannot be waited for for real: that would come to
/// nothing. It is handed on in the order in which threads began to wait.
/// @param real  waits for real.
template <typename Real>
int lock_mutex(const PlaypenVirtualTimeHooks* table, pthread_mutex_t* mutex,
               const Deadline& deadline, Real real) {
  bool wanted = __atomic_load_n(table->mutex_waits, __ATOMIC_SEQ_CST) > 0 &&
                mutex->__data.__owner != own_number() && table->mutex_is_wanted(mutex) != 0;
  for (;;) {
    if (!wanted) {
      const int result = next_pthread_mutex_trylock(mutex);
      if (result != EBUSY) return result;
    }
    if (is_special(mutex)) return real();
    const int error = errno;
    if (!wanted && table->waits_for_turn(mutex->__data.__owner) == 0) return real();
    const int end =
        wait_virtually(mutex, kPlaypenWaitMutex, deadline, wanted ? nullptr : is_free, 0);
    errno = error;
    if (end < 0) return real();
    if (end == kPlaypenWaitTime) return ETIMEDOUT;
    wanted = false;
  }
}

int lock_mutex(pthread_mutex_t* mutex) {
  const auto real = [mutex] { return next_pthread_mutex_lock(mutex); };
  const auto* const table = playpen();
  return table == nullptr ? real() : lock_mutex(table, mutex, Deadline(), real);
}

int unlock_mutex(pthread_mutex_t* mutex) {
  const int result = next_pthread_mutex_unlock(mutex);
  const auto* const table = playpen();
  if (table != nullptr && __atomic_load_n(table->mutex_waits, __ATOMIC_SEQ_CST) > 0) {
    const int error = errno;
    table->wake(mutex, 1);
    errno = error;
  }
  return result;
}

// --- Condition variables and semaphores

// Shared with other processes, which do not take turns.
bool is_shared(const pthread_cond_t* condition) { return (condition->__data.__wrefs & 1U) != 0; }

template <typename Real>
int wait_for_condition(pthread_cond_t* condition, pthread_mutex_t* mutex, const Deadline& deadline,
                       Real real) {
  if (is_shared(condition)) return real();
  const int end = wait_virtually(condition, kPlaypenWaitObject, deadline, nullptr, 0,
                                 [mutex] { unlock_mutex(mutex); });
  if (end < 0) return real();
  {
    const NotCancelled whole;
    lock_mutex(mutex);
  }
  pthread_testcancel();  // with the mutex, as those who tidy up expect
  return end == kPlaypenWaitTime ? ETIMEDOUT : 0;
}

int is_posted(const void* semaphore, unsigned /*value*/) {
  int value = 0;
  auto* const known = const_cast<sem_t*>(static_cast<const sem_t*>(semaphore));
  return sem_getvalue(known, &value) == 0 && value > 0 ? 1 : 0;
}

template <typename Real>
int wait_for_semaphore(sem_t* semaphore, const Deadline& deadline, Real real) {
  for (;;) {
    if (sem_trywait(semaphore) == 0) return 0;
    if (errno != EAGAIN) return -1;
    const int end = wait_virtually(semaphore, kPlaypenWaitObject, deadline, is_posted, 0);
    if (end < 0) return real();
    pthread_testcancel();
    if (end != kPlaypenWaitTime) continue;
    errno = ETIMEDOUT;
    return -1;
  }
}

/// For locks for reading and writing.
/// @param attempt  0 if it has succeeded, EBUSY if it may later.
template <typename Attempt, typename Real>
int wait_by_trying(const void* object, const Deadline& deadline, Attempt attempt, Real real) {
  for (;;) {
    if (const int result = attempt(); result != EBUSY) return result;
    const int end = wait_virtually(object, kPlaypenWaitObject, deadline, nullptr, 0);
    if (end < 0) return real();
    if (end == kPlaypenWaitTime) return ETIMEDOUT;
  }
}

/// For what no thread of the program brings: looks every so often, in simulated time.
/// @param left_ns  how long.
/// @param look     >= 0: the result.
/// @return the result; -1: there was none in this time; -2: the rest is to be waited for real;
///         -3: a signal came.
template <typename Look>
int wait_by_looking(long long& left_ns, const void* caller, Look look) {
  for (;;) {
    if (const int result = look(); result >= 0) return result;
    if (left_ns <= 0) return -1;
    const long long slice_ns = left_ns < kSlice_ns ? left_ns : kSlice_ns;
    long long rest_ns = 0;
    const Slept slept = sleep_cancellably(slice_ns, caller, rest_ns);
    if (slept == Slept::kNo) return -2;
    if (slept == Slept::kInterrupted) return -3;
    left_ns -= slice_ns;
  }
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
  long long left_ns = 0;
  switch (sleep_cancellably(at_least_one(seconds * kSecond_ns), CALLER, left_ns)) {
    case Slept::kNo:
      return next_sleep(seconds);
    case Slept::kYes:
      return 0;
    default:
      // Rounded, but never to nothing: it was interrupted.
      return left_ns < kSecond_ns ? 1U
                                  : static_cast<unsigned>((left_ns + kSecond_ns / 2) / kSecond_ns);
  }
}

EXPORTED int usleep(useconds_t microseconds) {
  long long left_ns = 0;
  const Slept slept = sleep_cancellably(at_least_one(microseconds * 1'000LL), CALLER, left_ns);
  return slept == Slept::kNo ? next_usleep(microseconds) : result_of(slept);
}

namespace {

/// @return as nanosleep(), in `result`; false: it is to be done for real.
bool sleep_with_rest(long long duration_ns, timespec* rest, const void* caller, int& result) {
  long long left_ns = 0;
  const Slept slept = sleep_cancellably(duration_ns, caller, left_ns);
  if (slept == Slept::kNo) return false;
  if (slept == Slept::kInterrupted && rest != nullptr) *rest = to_timespec(left_ns);
  result = result_of(slept);
  return true;
}

int nanosleep_from(const timespec* duration, timespec* rest, const void* caller) {
  int result = 0;
  if (duration != nullptr && is_duration(*duration) &&
      sleep_with_rest(at_least_one(nanoseconds(*duration)), rest, caller, result)) {
    return result;
  }
  return next_nanosleep(duration, rest);
}

int clock_nanosleep_from(clockid_t clock, int flags, const timespec* time, timespec* rest,
                         const void* caller) {
  const long long start_ns = clock_start(clock);
  int result = 0;
  const auto error = [&result] { return result == 0 ? 0 : EINTR; };
  if (start_ns > 0 && time != nullptr && is_duration(*time)) {
    if ((flags & TIMER_ABSTIME) == 0) {
      if (sleep_with_rest(at_least_one(nanoseconds(*time)), rest, caller, result)) return error();
    } else {
      long long now_ns = 0;
      if (virtual_now(now_ns, false, caller)) {
        const long long left_ns = nanoseconds(*time) - start_ns - now_ns;
        if (left_ns <= 0 || sleep_with_rest(left_ns, nullptr, caller, result)) return error();
        const timespec left = to_timespec(left_ns);
        return next_clock_nanosleep(clock, 0, &left, rest);
      }
    }
  }
  return next_clock_nanosleep(clock, flags, time, rest);
}

/// Whether a program that waits for these waits for a key: all are its standard input or a
/// terminal. Its wait is simulated time then. What others send takes the time it takes.
class Keys {
 public:
  void add(int descriptor) {
    struct stat status {};
    if (isatty(descriptor) == 0 && (descriptor != STDIN_FILENO || fstat(descriptor, &status) != 0 ||
                                    S_ISSOCK(status.st_mode))) {
      only_ = false;
    }
    any_ = true;
  }
  [[nodiscard]] bool only() const { return any_ && only_; }

 private:
  bool any_ = false;
  bool only_ = true;
};

bool is_programs(const void* caller) {
  const auto* const table = playpen();
  if (table == nullptr) return false;
  const int error = errno;
  const bool programs = table->is_programs(caller) != 0;
  errno = error;
  return programs;
}

/// poll() by another name.
/// @param again  with another time-out [ns], < 0: for ever.
template <typename Again>
int poll_from(const pollfd* descriptors, nfds_t count, long long timeout_ns, const void* caller,
              Again again) {
  if (timeout_ns < 0) return again(timeout_ns);
  if (count == 0) {
    long long left_ns = 0;
    const Slept slept = sleep_cancellably(at_least_one(timeout_ns), caller, left_ns);
    return slept == Slept::kNo ? again(timeout_ns) : result_of(slept);
  }
  if (!is_programs(caller)) return again(timeout_ns);
  Keys keys;
  for (nfds_t i = 0; i < count; ++i) {
    if (descriptors[i].fd >= 0) keys.add(descriptors[i].fd);
  }
  if (!keys.only()) return again(timeout_ns);
  long long left_ns = at_least_one(timeout_ns);
  int found = 0;
  const int result = wait_by_looking(left_ns, caller, [&] {
    found = again(0);
    return found != 0 ? 1 : -1;
  });
  if (result >= 0) return found;
  if (result == -2) return again(left_ns);
  return result_of(result == -1 ? Slept::kYes : Slept::kInterrupted);
}

int poll_ms(long long timeout_ns) {
  if (timeout_ns < 0) return -1;
  const long long whole_ms = (timeout_ns + 999'999) / 1'000'000;
  return whole_ms > INT_MAX ? INT_MAX : static_cast<int>(whole_ms);
}

/// select() by another name; the same.
template <typename Again>
int select_from(int count, fd_set* read, fd_set* write, fd_set* except, long long timeout_ns,
                const void* caller, Again again) {
  if (no_descriptors(count, read, write, except)) {
    long long left_ns = 0;
    const Slept slept = sleep_cancellably(at_least_one(timeout_ns), caller, left_ns);
    return slept == Slept::kNo ? again(timeout_ns) : result_of(slept);
  }
  if (count > FD_SETSIZE || !is_programs(caller)) return again(timeout_ns);
  Keys keys;
  fd_set* const sets[] = {read, write, except};
  fd_set wanted[3];
  for (int i = 0; i < 3; ++i) {
    if (sets[i] == nullptr) continue;
    wanted[i] = *sets[i];
    for (int descriptor = 0; descriptor < count; ++descriptor) {
      if (FD_ISSET(descriptor, sets[i])) keys.add(descriptor);
    }
  }
  if (!keys.only()) return again(timeout_ns);
  const auto put_back = [&] {
    for (int i = 0; i < 3; ++i) {
      if (sets[i] != nullptr) *sets[i] = wanted[i];
    }
  };
  long long left_ns = at_least_one(timeout_ns);
  int found = 0;
  const int result = wait_by_looking(left_ns, caller, [&] {
    put_back();
    found = again(0);
    return found != 0 ? 1 : -1;
  });
  if (result >= 0 || result == -1) return result >= 0 ? found : 0;
  put_back();
  return result == -2 ? again(left_ns) : result_of(Slept::kInterrupted);
}

}  // namespace

EXPORTED int nanosleep(const timespec* duration, timespec* rest) {
  return nanosleep_from(duration, rest, CALLER);
}

EXPORTED int clock_nanosleep(clockid_t clock, int flags, const timespec* time, timespec* rest) {
  return clock_nanosleep_from(clock, flags, time, rest, CALLER);
}

EXPORTED int select(int count, fd_set* read, fd_set* write, fd_set* except, timeval* timeout) {
  if (timeout == nullptr || timeout->tv_sec < 0 || timeout->tv_usec < 0 ||
      !is_duration({timeout->tv_sec, 0})) {
    return next_select(count, read, write, except, timeout);
  }
  const long long timeout_ns = timeout->tv_sec * kSecond_ns + timeout->tv_usec * 1'000LL;
  // What is left of it, as Linux has it.
  return select_from(count, read, write, except, timeout_ns, CALLER, [&](long long again_ns) {
    *timeout = {again_ns / kSecond_ns, again_ns % kSecond_ns / 1'000};
    return next_select(count, read, write, except, timeout);
  });
}

EXPORTED int pselect(int count, fd_set* read, fd_set* write, fd_set* except,
                     const timespec* timeout, const sigset_t* mask) {
  if (timeout == nullptr || mask != nullptr || !is_duration(*timeout)) {
    return next_pselect(count, read, write, except, timeout, mask);
  }
  return select_from(count, read, write, except, nanoseconds(*timeout), CALLER,
                     [&](long long again_ns) {
                       const timespec again = to_timespec(again_ns);
                       return next_pselect(count, read, write, except, &again, mask);
                     });
}

EXPORTED int poll(pollfd* descriptors, nfds_t count, int timeout_ms) {
  return poll_from(descriptors, count, timeout_ms * 1'000'000LL, CALLER, [&](long long again_ns) {
    return next_poll(descriptors, count, poll_ms(again_ns));
  });
}

EXPORTED int ppoll(pollfd* descriptors, nfds_t count, const timespec* timeout,
                   const sigset_t* mask) {
  if (timeout == nullptr || mask != nullptr || !is_duration(*timeout)) {
    return next_ppoll(descriptors, count, timeout, mask);
  }
  return poll_from(descriptors, count, nanoseconds(*timeout), CALLER, [&](long long again_ns) {
    const timespec again = to_timespec(again_ns);
    return next_ppoll(descriptors, count, &again, mask);
  });
}

// What poll and ppoll are in programs built with _FORTIFY_SOURCE.
// NOLINTBEGIN(readability-identifier-naming): the C library's names
EXPORTED int __poll_chk(pollfd* descriptors, nfds_t count, int timeout_ms, std::size_t size) {
  return poll_from(descriptors, count, timeout_ms * 1'000'000LL, CALLER, [&](long long again_ns) {
    return next_poll_chk(descriptors, count, poll_ms(again_ns), size);
  });
}

EXPORTED int __ppoll_chk(pollfd* descriptors, nfds_t count, const timespec* timeout,
                         const sigset_t* mask, std::size_t size) {
  if (timeout == nullptr || mask != nullptr || !is_duration(*timeout)) {
    return next_ppoll_chk(descriptors, count, timeout, mask, size);
  }
  return poll_from(descriptors, count, nanoseconds(*timeout), CALLER, [&](long long again_ns) {
    const timespec again = to_timespec(again_ns);
    return next_ppoll_chk(descriptors, count, &again, mask, size);
  });
}
// NOLINTEND(readability-identifier-naming)

namespace {

/// Whether nothing is registered with an epoll: waiting for it is sleeping.
bool watches_nothing(int epoll) {
  char path[] = "/proc/self/fdinfo/0000000000";
  char* end = path + sizeof "/proc/self/fdinfo/" - 1;
  char digits[12];
  int count = 0;
  if (epoll < 0) return false;
  for (int rest = epoll; count == 0 || rest > 0; rest /= 10) {
    digits[count++] = static_cast<char>('0' + rest % 10);
  }
  while (count > 0) *end++ = digits[--count];
  *end = '\0';
  const int file = open(path, O_RDONLY | O_CLOEXEC);
  if (file < 0) return false;
  char text[512];
  const ssize_t length = read(file, text, sizeof text - 1);
  close(file);
  if (length <= 0 || length == static_cast<ssize_t>(sizeof text) - 1) return false;
  text[length] = '\0';
  return strstr(text, "tfd:") == nullptr;
}

template <typename Again>
int epoll_from(int epoll, int timeout_ms, const void* caller, Again again) {
  if (timeout_ms <= 0 || !is_programs(caller) || !watches_nothing(epoll)) return again();
  long long left_ns = 0;
  const Slept slept = sleep_cancellably(timeout_ms * 1'000'000LL, caller, left_ns);
  return slept == Slept::kNo ? again() : result_of(slept);
}

}  // namespace

EXPORTED int epoll_wait(int epoll, epoll_event* events, int most, int timeout_ms) {
  return epoll_from(epoll, timeout_ms, CALLER,
                    [&] { return next_epoll_wait(epoll, events, most, timeout_ms); });
}

EXPORTED int epoll_pwait(int epoll, epoll_event* events, int most, int timeout_ms,
                         const sigset_t* mask) {
  const auto again = [&] { return next_epoll_pwait(epoll, events, most, timeout_ms, mask); };
  return mask != nullptr ? again() : epoll_from(epoll, timeout_ms, CALLER, again);
}

EXPORTED int sigtimedwait(const sigset_t* __restrict set, siginfo_t* __restrict info,
                          const timespec* __restrict timeout) {
  if (timeout == nullptr || !is_duration(*timeout) || !is_programs(CALLER)) {
    return next_sigtimedwait(set, info, timeout);
  }
  constexpr timespec kNow = {0, 0};
  long long left_ns = nanoseconds(*timeout);
  const int result = wait_by_looking(left_ns, CALLER, [&] {
    const int found = next_sigtimedwait(set, info, &kNow);
    return found < 0 && errno == EAGAIN ? -1 : (found < 0 ? 0 : found);
  });
  if (result > 0) return result;
  if (result == -2) {
    const timespec left = to_timespec(left_ns);
    return next_sigtimedwait(set, info, &left);
  }
  if (result == -1) errno = EAGAIN;
  if (result == -3) errno = EINTR;
  return -1;
}

namespace {

/// @param attempt  a call with a deadline that has passed, or with another one.
template <typename Result, typename Attempt>
Result wait_for_queue(const timespec* deadline, const void* caller, Attempt attempt) {
  const Deadline end = deadline_of(deadline, CLOCK_REALTIME, caller);
  long long now_ns = 0;
  if (!end.is_virtual || !virtual_now(now_ns, false, caller)) return attempt(deadline);
  constexpr timespec kPassed = {0, 0};
  long long left_ns = end.elapsed_ns - now_ns;
  Result found = -1;
  const int result = wait_by_looking(left_ns, caller, [&] {
    found = attempt(&kPassed);
    return found < 0 && errno == ETIMEDOUT ? -1 : 0;
  });
  if (result >= 0) return found;
  if (result == -2) return attempt(&end.real);
  errno = result == -1 ? ETIMEDOUT : EINTR;
  return -1;
}

}  // namespace

EXPORTED ssize_t mq_timedreceive(mqd_t queue, char* __restrict text, size_t size,
                                 unsigned* __restrict priority,
                                 const timespec* __restrict deadline) {
  return wait_for_queue<ssize_t>(deadline, CALLER, [&](const timespec* until) {
    return next_mq_timedreceive(queue, text, size, priority, until);
  });
}

EXPORTED int mq_timedsend(mqd_t queue, const char* text, size_t size, unsigned priority,
                          const timespec* deadline) {
  return wait_for_queue<int>(deadline, CALLER, [&](const timespec* until) {
    return next_mq_timedsend(queue, text, size, priority, until);
  });
}

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
  // Libraries measure with those of the processor's time; programs wait for them.
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

// --- What cannot be simulated

namespace {

void tell_of_real_time(const char* what, const void* caller) {
  if (!is_programs(caller)) return;
  const int error = errno;
  playpen()->waits_for_real(what);
  errno = error;
}

}  // namespace

EXPORTED unsigned alarm(unsigned seconds) noexcept {
  if (seconds != 0) tell_of_real_time("alarm()", CALLER);
  return next_alarm(seconds);
}

EXPORTED useconds_t ualarm(useconds_t value, useconds_t interval) noexcept {
  if (value != 0) tell_of_real_time("ualarm()", CALLER);
  return next_ualarm(value, interval);
}

// Its first parameter has another type in C.
EXPORTED int setitimer(int which, const itimerval* __restrict value,
                       itimerval* __restrict old) noexcept {
  if (value != nullptr && (value->it_value.tv_sec != 0 || value->it_value.tv_usec != 0)) {
    tell_of_real_time("setitimer()", CALLER);
  }
  return next_setitimer(which, value, old);
}

EXPORTED int timer_settime(timer_t timer, int flags, const itimerspec* __restrict value,
                           itimerspec* __restrict old) noexcept {
  if (value != nullptr && (value->it_value.tv_sec != 0 || value->it_value.tv_nsec != 0)) {
    tell_of_real_time("timer_settime()", CALLER);
  }
  return next_timer_settime(timer, flags, value, old);
}

EXPORTED int timerfd_settime(int timer, int flags, const itimerspec* value,
                             itimerspec* old) noexcept {
  if (value != nullptr && (value->it_value.tv_sec != 0 || value->it_value.tv_nsec != 0)) {
    tell_of_real_time("timerfd_settime()", CALLER);
  }
  return next_timerfd_settime(timer, flags, value, old);
}

EXPORTED int semtimedop(int semaphores, sembuf* operations, size_t count,
                        const timespec* timeout) noexcept {
  if (timeout != nullptr) tell_of_real_time("semtimedop()", CALLER);
  return next_semtimedop(semaphores, operations, count, timeout);
}

// --- Waiting for other threads

EXPORTED int sched_yield() noexcept {
  if (const auto* const table = playpen()) table->yield();
  return next_sched_yield();
}

EXPORTED int pthread_mutex_lock(pthread_mutex_t* mutex) noexcept { return lock_mutex(mutex); }
EXPORTED int pthread_mutex_unlock(pthread_mutex_t* mutex) noexcept { return unlock_mutex(mutex); }

EXPORTED int pthread_cond_signal(pthread_cond_t* condition) noexcept {
  wake(condition, 1);
  return next_pthread_cond_signal(condition);
}

EXPORTED int pthread_cond_broadcast(pthread_cond_t* condition) noexcept {
  wake(condition, INT_MAX);
  return next_pthread_cond_broadcast(condition);
}

EXPORTED int pthread_cond_wait(pthread_cond_t* __restrict condition,
                               pthread_mutex_t* __restrict mutex) {
  return wait_for_condition(condition, mutex, Deadline(),
                            [&] { return next_pthread_cond_wait(condition, mutex); });
}

EXPORTED int sem_post(sem_t* semaphore) noexcept {
  const int result = next_sem_post(semaphore);
  wake(semaphore, 1);
  return result;
}

EXPORTED int sem_wait(sem_t* semaphore) {
  return wait_for_semaphore(semaphore, Deadline(), [&] { return next_sem_wait(semaphore); });
}

EXPORTED int pthread_cond_timedwait(pthread_cond_t* __restrict condition,
                                    pthread_mutex_t* __restrict mutex,
                                    const timespec* __restrict time) {
  // Its clock is an attribute that cannot be read; the virtual ones are 50 years apart.
  constexpr time_t kBetween_s = playerlike::kVirtualEpoch_s / 2;
  const clockid_t clock = time->tv_sec < kBetween_s ? CLOCK_MONOTONIC : CLOCK_REALTIME;
  const Deadline deadline = deadline_of(time, clock, CALLER);
  return wait_for_condition(condition, mutex, deadline, [&] {
    return next_pthread_cond_timedwait(condition, mutex, &deadline.real);
  });
}

EXPORTED int pthread_cond_clockwait(pthread_cond_t* condition, pthread_mutex_t* mutex,
                                    clockid_t clock, const timespec* time) {
  const Deadline deadline = deadline_of(time, clock, CALLER);
  return wait_for_condition(condition, mutex, deadline, [&] {
    return next_pthread_cond_clockwait(condition, mutex, clock, &deadline.real);
  });
}

EXPORTED int sem_timedwait(sem_t* __restrict semaphore, const timespec* __restrict time) {
  const Deadline deadline = deadline_of(time, CLOCK_REALTIME, CALLER);
  return wait_for_semaphore(semaphore, deadline,
                            [&] { return next_sem_timedwait(semaphore, &deadline.real); });
}

EXPORTED int sem_clockwait(sem_t* __restrict semaphore, clockid_t clock,
                           const timespec* __restrict time) {
  const Deadline deadline = deadline_of(time, clock, CALLER);
  return wait_for_semaphore(semaphore, deadline,
                            [&] { return next_sem_clockwait(semaphore, clock, &deadline.real); });
}

EXPORTED int pthread_mutex_timedlock(pthread_mutex_t* __restrict mutex,
                                     const timespec* __restrict time) noexcept {
  const Deadline deadline = deadline_of(time, CLOCK_REALTIME, CALLER);
  const auto real = [&] { return next_pthread_mutex_timedlock(mutex, &deadline.real); };
  const auto* const table = playpen();
  return table == nullptr ? real() : lock_mutex(table, mutex, deadline, real);
}

EXPORTED int pthread_mutex_clocklock(pthread_mutex_t* __restrict mutex, clockid_t clock,
                                     const timespec* __restrict time) noexcept {
  const Deadline deadline = deadline_of(time, clock, CALLER);
  const auto real = [&] { return next_pthread_mutex_clocklock(mutex, clock, &deadline.real); };
  const auto* const table = playpen();
  return table == nullptr ? real() : lock_mutex(table, mutex, deadline, real);
}

#define RWLOCK(name, attempt, parameters, clock, time, ...)                                       \
  EXPORTED int name parameters noexcept {                                                         \
    const Deadline deadline = deadline_of(time, clock, CALLER);                                   \
    return wait_by_trying(                                                                        \
        lock, deadline, [&] { return attempt(lock); }, [&] { return next_##name(__VA_ARGS__); }); \
  }
RWLOCK(pthread_rwlock_rdlock, pthread_rwlock_tryrdlock, (pthread_rwlock_t * lock), CLOCK_REALTIME,
       nullptr, lock)
RWLOCK(pthread_rwlock_wrlock, pthread_rwlock_trywrlock, (pthread_rwlock_t * lock), CLOCK_REALTIME,
       nullptr, lock)
RWLOCK(pthread_rwlock_timedrdlock, pthread_rwlock_tryrdlock,
       (pthread_rwlock_t* __restrict lock, const timespec* __restrict time), CLOCK_REALTIME, time,
       lock, &deadline.real)
RWLOCK(pthread_rwlock_timedwrlock, pthread_rwlock_trywrlock,
       (pthread_rwlock_t* __restrict lock, const timespec* __restrict time), CLOCK_REALTIME, time,
       lock, &deadline.real)
RWLOCK(pthread_rwlock_clockrdlock, pthread_rwlock_tryrdlock,
       (pthread_rwlock_t* __restrict lock, clockid_t clock, const timespec* __restrict time), clock,
       time, lock, clock, &deadline.real)
RWLOCK(pthread_rwlock_clockwrlock, pthread_rwlock_trywrlock,
       (pthread_rwlock_t* __restrict lock, clockid_t clock, const timespec* __restrict time), clock,
       time, lock, clock, &deadline.real)
#undef RWLOCK

EXPORTED int pthread_rwlock_unlock(pthread_rwlock_t* lock) noexcept {
  const int result = next_pthread_rwlock_unlock(lock);
  wake(lock, INT_MAX);
  return result;
}

// --- Barriers

namespace {

/// A barrier that threads of this process wait at. Theirs cannot be asked who waits there.
struct Barrier {
  std::atomic<const pthread_barrier_t*> which{nullptr};
  std::atomic<unsigned> arrived{0};
  std::atomic<unsigned> round{0};
};
constinit Barrier barriers[64];

// As the C library lays it out.
struct BarrierFields {
  unsigned in;
  unsigned current_round;
  unsigned count;
  int shared;
  unsigned out;
};
static_assert(sizeof(BarrierFields) <= sizeof(pthread_barrier_t));

BarrierFields fields_of(const pthread_barrier_t* barrier) {
  BarrierFields fields;
  memcpy(&fields, barrier, sizeof fields);
  return fields;
}

/// @return nullptr: there are too many.
Barrier* find_barrier(const pthread_barrier_t* which) {
  for (Barrier& barrier : barriers) {
    const pthread_barrier_t* known = barrier.which.load();
    if (known == which) return &barrier;
    if (known == nullptr &&
        (barrier.which.compare_exchange_strong(known, which) || known == which)) {
      return &barrier;
    }
  }
  return nullptr;
}

int has_another_round(const void* barrier, unsigned round) {
  return static_cast<const Barrier*>(barrier)->round.load() != round ? 1 : 0;
}

}  // namespace

EXPORTED int pthread_barrier_wait(pthread_barrier_t* which) noexcept {
  const BarrierFields fields = fields_of(which);
  Barrier* const barrier =
      playpen() == nullptr || fields.shared != 0 ? nullptr : find_barrier(which);
  if (barrier == nullptr) return next_pthread_barrier_wait(which);
  const unsigned round = barrier->round.load();
  if (barrier->arrived.fetch_add(1) + 1 == fields.count) {
    barrier->arrived = 0;
    barrier->round.fetch_add(1);
    wake(barrier, INT_MAX);
    next_syscall(SYS_futex, reinterpret_cast<long>(&barrier->round), long{FUTEX_WAKE_PRIVATE},
                 long{INT_MAX}, 0L, 0L, 0L);
    return PTHREAD_BARRIER_SERIAL_THREAD;
  }
  while (barrier->round.load() == round) {
    if (wait_virtually(barrier, kPlaypenWaitObject, Deadline(), has_another_round, round) >= 0) {
      continue;
    }
    const int error = errno;
    next_syscall(SYS_futex, reinterpret_cast<long>(&barrier->round), long{FUTEX_WAIT_PRIVATE},
                 static_cast<long>(round), 0L, 0L, 0L);
    errno = error;
  }
  return 0;
}

EXPORTED int pthread_barrier_destroy(pthread_barrier_t* which) noexcept {
  for (Barrier& barrier : barriers) {
    const pthread_barrier_t* known = which;
    barrier.which.compare_exchange_strong(known, nullptr);
  }
  return next_pthread_barrier_destroy(which);
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
  } else {
    table->thread_started(number, reinterpret_cast<const void*>(*thread));
  }
  return error;
}

namespace {

/// Waits until a thread has ended, but for what the system does then.
/// @return 0, or ETIMEDOUT.
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
    // Told first, so that it is not chance which of both the other one finds.
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

// --- System calls

namespace {

int word_differs(const void* word, unsigned value) {
  return __atomic_load_n(static_cast<const unsigned*>(word), __ATOMIC_SEQ_CST) != value ? 1 : 0;
}

/// @return whether it was done, with its result.
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

/// @return how many were woken.
int wake_futex(const unsigned* word, int most) {
  const auto* const table = playpen();
  if (table == nullptr || __atomic_load_n(table->object_waits, __ATOMIC_SEQ_CST) <= 0) return 0;
  return table->wake(word, most);
}

}  // namespace

// libstdc++ and others wait with futexes by this function.
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
