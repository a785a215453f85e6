// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Waits for time and for input from elsewhere: sleeps, descriptors, signals, queues.
#include <fcntl.h>
#include <limits.h>
#include <mqueue.h>
#include <poll.h>
#include <signal.h>
#include <string.h>
#include <sys/epoll.h>
#include <sys/select.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstddef>
#include <initializer_list>

#include "virtual_time/preload/common.h"

// Functions that replace the C library's must be in the global namespace.
using namespace playerlike::preload;  // NOLINT(google-build-using-namespace)

namespace {

// Polling period of waits for events from outside of the program.
constexpr long long kSlice_ns = 10'000'000;

NEXT(sleep);
NEXT(usleep);
NEXT(nanosleep);
NEXT(clock_nanosleep);
NEXT(select);
NEXT(pselect);
NEXT(poll);
NEXT(ppoll);
NEXT(mq_timedreceive);
NEXT(mq_timedsend);
NEXT(sigtimedwait);
NEXT(epoll_wait);
NEXT(epoll_pwait);
constinit Next<int(pollfd*, nfds_t, int, std::size_t)> next_poll_chk("__poll_chk");
constinit Next<int(pollfd*, nfds_t, const timespec*, const sigset_t*, std::size_t)> next_ppoll_chk(
    "__ppoll_chk");

bool no_descriptors(int count, const fd_set* read, const fd_set* write, const fd_set* except) {
  for (int i = 0; i < count; ++i) {
    for (const fd_set* set : {read, write, except}) {
      if (set != nullptr && FD_ISSET(i, set)) return false;
    }
  }
  return true;
}

/// Polls, in simulated time, for an event from outside of the program.
/// @param left_ns  time limit.
/// @param check    polls; >= 0: the result.
/// @return the result; -1: time limit; -2: the rest must be waited in real time; -3: a signal
/// arrived.
template <typename Check>
int wait_by_polling(long long& left_ns, const void* caller, Check check) {
  for (;;) {
    if (const int result = check(); result >= 0) return result;
    if (left_ns <= 0) return -1;
    const long long slice_ns = left_ns < kSlice_ns ? left_ns : kSlice_ns;
    long long rest_ns = 0;
    const SleepResult slept = sleep_cancellably(slice_ns, caller, rest_ns);
    if (slept == SleepResult::kNo) return -2;
    if (slept == SleepResult::kInterrupted) return -3;
    left_ns -= slice_ns;
  }
}

/// Sleeps like nanosleep(). @return false if the sleep must be real; otherwise `result` is set.
bool sleep_with_rest(long long duration_ns, timespec* rest, const void* caller, int& result) {
  long long left_ns = 0;
  const SleepResult slept = sleep_cancellably(duration_ns, caller, left_ns);
  if (slept == SleepResult::kNo) return false;
  if (slept == SleepResult::kInterrupted && rest != nullptr) *rest = to_timespec(left_ns);
  result = result_of(slept);
  return true;
}

/// Tells whether a program waits for a key: all descriptors are standard input or terminals. Such a
/// wait takes simulated time. Input from elsewhere takes real time.
class KeyboardWait {
 public:
  void add(int descriptor) {
    struct stat status {};
    if (isatty(descriptor) == 0 && (descriptor != STDIN_FILENO || fstat(descriptor, &status) != 0 ||
                                    S_ISSOCK(status.st_mode))) {
      only_keyboard_ = false;
    }
    any_ = true;
  }
  [[nodiscard]] bool keyboard_only() const { return any_ && only_keyboard_; }

 private:
  bool any_ = false;
  bool only_keyboard_ = true;
};

/// Implements the variants of poll().
/// @param again  the real function, with another timeout [ns]; < 0: none.
template <typename Again>
int poll_from(const pollfd* descriptors, nfds_t count, long long timeout_ns, const void* caller,
              Again again) {
  if (timeout_ns < 0) return again(timeout_ns);
  if (count == 0) {
    long long left_ns = 0;
    const SleepResult slept = sleep_cancellably(at_least_1us(timeout_ns), caller, left_ns);
    return slept == SleepResult::kNo ? again(timeout_ns) : result_of(slept);
  }
  if (!is_programs(caller)) return again(timeout_ns);
  KeyboardWait keyboard_wait;
  for (nfds_t i = 0; i < count; ++i) {
    if (descriptors[i].fd >= 0) keyboard_wait.add(descriptors[i].fd);
  }
  if (!keyboard_wait.keyboard_only()) return again(timeout_ns);
  long long left_ns = at_least_1us(timeout_ns);
  int found = 0;
  const int result = wait_by_polling(left_ns, caller, [&] {
    found = again(0);
    return found != 0 ? 1 : -1;
  });
  if (result >= 0) return found;
  if (result == -2) return again(left_ns);
  return result_of(result == -1 ? SleepResult::kYes : SleepResult::kInterrupted);
}

int poll_ms(long long timeout_ns) {
  if (timeout_ns < 0) return -1;
  const long long whole_ms = (timeout_ns + 999'999) / 1'000'000;
  return whole_ms > INT_MAX ? INT_MAX : static_cast<int>(whole_ms);
}

/// Implements the variants of select().
/// @param again  the real function, with another timeout [ns]; < 0: none.
template <typename Again>
int select_from(int count, fd_set* read, fd_set* write, fd_set* except, long long timeout_ns,
                const void* caller, Again again) {
  if (no_descriptors(count, read, write, except)) {
    long long left_ns = 0;
    const SleepResult slept = sleep_cancellably(at_least_1us(timeout_ns), caller, left_ns);
    return slept == SleepResult::kNo ? again(timeout_ns) : result_of(slept);
  }
  if (count > FD_SETSIZE || !is_programs(caller)) return again(timeout_ns);
  KeyboardWait keyboard_wait;
  fd_set* const sets[] = {read, write, except};
  fd_set wanted[3];
  for (int i = 0; i < 3; ++i) {
    if (sets[i] == nullptr) continue;
    wanted[i] = *sets[i];
    for (int descriptor = 0; descriptor < count; ++descriptor) {
      if (FD_ISSET(descriptor, sets[i])) keyboard_wait.add(descriptor);
    }
  }
  if (!keyboard_wait.keyboard_only()) return again(timeout_ns);
  const auto put_back = [&] {
    for (int i = 0; i < 3; ++i) {
      if (sets[i] != nullptr) *sets[i] = wanted[i];
    }
  };
  long long left_ns = at_least_1us(timeout_ns);
  int found = 0;
  const int result = wait_by_polling(left_ns, caller, [&] {
    put_back();
    found = again(0);
    return found != 0 ? 1 : -1;
  });
  if (result >= 0 || result == -1) return result >= 0 ? found : 0;
  put_back();
  return result == -2 ? again(left_ns) : result_of(SleepResult::kInterrupted);
}

}  // namespace

namespace playerlike::preload {

int nanosleep_from(const timespec* duration, timespec* rest, const void* caller) {
  int result = 0;
  if (duration != nullptr && is_duration(*duration) &&
      sleep_with_rest(at_least_1us(nanoseconds(*duration)), rest, caller, result)) {
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
      if (sleep_with_rest(at_least_1us(nanoseconds(*time)), rest, caller, result)) return error();
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

}  // namespace playerlike::preload

EXPORTED unsigned sleep(unsigned seconds) {
  long long left_ns = 0;
  switch (sleep_cancellably(at_least_1us(seconds * kSecond_ns), CALLER, left_ns)) {
    case SleepResult::kNo:
      return next_sleep(seconds);
    case SleepResult::kYes:
      return 0;
    default:
      // Rounded, but at least 1, since the sleep was interrupted.
      return left_ns < kSecond_ns ? 1U
                                  : static_cast<unsigned>((left_ns + kSecond_ns / 2) / kSecond_ns);
  }
}

EXPORTED int usleep(useconds_t microseconds) {
  long long left_ns = 0;
  const SleepResult slept =
      sleep_cancellably(at_least_1us(microseconds * 1'000LL), CALLER, left_ns);
  return slept == SleepResult::kNo ? next_usleep(microseconds) : result_of(slept);
}

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
  // Linux stores the remaining time in `timeout`.
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

// poll and ppoll of programs that were built with _FORTIFY_SOURCE.
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

/// Whether an epoll has no descriptors, so that waiting for it is a sleep.
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
  const SleepResult slept = sleep_cancellably(timeout_ms * 1'000'000LL, caller, left_ns);
  return slept == SleepResult::kNo ? again() : result_of(slept);
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
  const int result = wait_by_polling(left_ns, CALLER, [&] {
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

/// @param attempt  the call, with a deadline that has passed or with another one.
template <typename Result, typename Attempt>
Result wait_for_queue(const timespec* deadline, const void* caller, Attempt attempt) {
  const Deadline end = deadline_of(deadline, CLOCK_REALTIME, caller);
  long long now_ns = 0;
  if (!end.is_virtual || !virtual_now(now_ns, false, caller)) return attempt(deadline);
  constexpr timespec kPassed = {0, 0};
  long long left_ns = end.elapsed_ns - now_ns;
  Result found = -1;
  const int result = wait_by_polling(left_ns, caller, [&] {
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
