// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "lock_watch.h"

#include <dlfcn.h>
#include <pthread.h>

#include <atomic>
#include <cstdint>
#include <ctime>

namespace {

// The mutex that is watched, and the longest time that a thread has held it [ns]. What counts is
// the processor's time of the thread, because a busy machine may interrupt it for any time.
std::atomic<const void*> watched{nullptr};
std::atomic<std::int64_t> longest_ns{0};
thread_local const void* last_locked = nullptr;
thread_local std::int64_t begin_ns = 0;

std::int64_t thread_time_ns() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<std::int64_t>(time.tv_sec) * 1'000'000'000 + time.tv_nsec;
}

void note_locked(const void* mutex) {
  last_locked = mutex;
  if (mutex == watched) begin_ns = thread_time_ns();
}

void note_unlocked(const void* mutex) {
  if (mutex != watched || begin_ns == 0) return;
  const std::int64_t held_ns = thread_time_ns() - begin_ns;
  begin_ns = 0;
  std::int64_t longest = longest_ns;
  while (held_ns > longest && !longest_ns.compare_exchange_weak(longest, held_ns)) {
  }
}

template <typename Function>
Function* next_function(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

}  // namespace

extern "C" {

int pthread_mutex_lock(pthread_mutex_t* mutex) {
  static std::atomic<int (*)(pthread_mutex_t*)> next{nullptr};
  if (next == nullptr) next = next_function<int(pthread_mutex_t*)>("pthread_mutex_lock");
  const int error = next.load()(mutex);
  if (error == 0) note_locked(mutex);
  return error;
}

int pthread_mutex_unlock(pthread_mutex_t* mutex) {
  static std::atomic<int (*)(pthread_mutex_t*)> next{nullptr};
  if (next == nullptr) next = next_function<int(pthread_mutex_t*)>("pthread_mutex_unlock");
  note_unlocked(mutex);
  return next.load()(mutex);
}

int pthread_cond_wait(pthread_cond_t* condition, pthread_mutex_t* mutex) {
  using Wait = int(pthread_cond_t*, pthread_mutex_t*);
  static std::atomic<Wait*> next{nullptr};
  if (next == nullptr) next = next_function<Wait>("pthread_cond_wait");
  note_unlocked(mutex);
  const int error = next.load()(condition, mutex);
  note_locked(mutex);
  return error;
}

int pthread_cond_clockwait(pthread_cond_t* condition, pthread_mutex_t* mutex, clockid_t clock,
                           const timespec* until) {
  using Wait = int(pthread_cond_t*, pthread_mutex_t*, clockid_t, const timespec*);
  static std::atomic<Wait*> next{nullptr};
  if (next == nullptr) next = next_function<Wait>("pthread_cond_clockwait");
  note_unlocked(mutex);
  const int error = next.load()(condition, mutex, clock, until);
  note_locked(mutex);
  return error;
}

int pthread_cond_timedwait(pthread_cond_t* condition, pthread_mutex_t* mutex,
                           const timespec* until) {
  using Wait = int(pthread_cond_t*, pthread_mutex_t*, const timespec*);
  static std::atomic<Wait*> next{nullptr};
  if (next == nullptr) next = next_function<Wait>("pthread_cond_timedwait");
  note_unlocked(mutex);
  const int error = next.load()(condition, mutex, until);
  note_locked(mutex);
  return error;
}

}  // extern "C"

namespace test_support {

void watch_last_mutex() { watched = last_locked; }
void watch_no_mutex() { watched = nullptr; }
void forget_holds() { longest_ns = 0; }
std::int64_t longest_hold_ns() { return longest_ns; }

}  // namespace test_support
