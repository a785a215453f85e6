// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Waits for other threads: mutexes, condition variables, semaphores, read-write locks, barriers.
#include <limits.h>
#include <linux/futex.h>
#include <sched.h>
#include <semaphore.h>
#include <string.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "virtual_time/preload/common.h"

// Functions that replace the C library's must be in the global namespace.
using namespace playerlike::preload;  // NOLINT(google-build-using-namespace)

namespace {

NEXT(sem_timedwait);
NEXT(sem_clockwait);
NEXT(sem_wait);
NEXT(sem_post);
NEXT(sched_yield);
NEXT(pthread_mutex_lock);
NEXT(pthread_mutex_trylock);
NEXT(pthread_mutex_unlock);
NEXT(pthread_mutex_timedlock);
NEXT(pthread_mutex_clocklock);
NEXT(pthread_rwlock_rdlock);
NEXT(pthread_rwlock_wrlock);
NEXT(pthread_rwlock_timedrdlock);
NEXT(pthread_rwlock_timedwrlock);
NEXT(pthread_rwlock_clockrdlock);
NEXT(pthread_rwlock_clockwrlock);
NEXT(pthread_rwlock_unlock);
NEXT(pthread_barrier_wait);
NEXT(pthread_barrier_destroy);
NEXT(syscall);
NEXT_CONDITION(pthread_cond_wait);
NEXT_CONDITION(pthread_cond_timedwait);
NEXT_CONDITION(pthread_cond_signal);
NEXT_CONDITION(pthread_cond_broadcast);
NEXT(pthread_cond_clockwait);

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

// Whether a mutex is shared with other processes or has a priority protocol.
bool is_special(const pthread_mutex_t* mutex) {
  constexpr int kShared = 128;
  constexpr int kInherits = 32;
  constexpr int kProtects = 64;
  return (mutex->__data.__kind & (kShared | kInherits | kProtects)) != 0;
}

/// Locks a mutex. If its owner waits for its turn, a real wait would deadlock, so the wait is
/// virtual. Such waits are served in the order in which they began.
/// @param real  locks in real time.
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

// Whether other processes, which do not take turns, share a condition variable.
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
  pthread_testcancel();  // with the mutex locked, as cleanup handlers expect
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

/// Locks a read-write lock.
/// @param attempt  returns 0 if it succeeds, EBUSY if it must be repeated later.
template <typename Attempt, typename Real>
int wait_by_trying(const void* object, const Deadline& deadline, Attempt attempt, Real real) {
  for (;;) {
    if (const int result = attempt(); result != EBUSY) return result;
    const int end = wait_virtually(object, kPlaypenWaitObject, deadline, nullptr, 0);
    if (end < 0) return real();
    if (end == kPlaypenWaitTime) return ETIMEDOUT;
  }
}

}  // namespace

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
  // The condition variable's clock cannot be queried. The two virtual clocks are 50 years apart, so
  // the value tells which one it is.
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

/// A barrier of this process. The system's barrier does not reveal how many threads wait.
struct Barrier {
  std::atomic<const pthread_barrier_t*> which{nullptr};
  std::atomic<unsigned> arrived{0};
  std::atomic<unsigned> round{0};
};
constinit Barrier barriers[64];

// The C library's layout of a barrier.
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

/// @return nullptr if there are too many barriers.
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
