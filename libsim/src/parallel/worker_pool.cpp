// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "parallel/worker_pool.h"

#include <sched.h>

#include <cstddef>

namespace sim::parallel {
namespace {

// How often a thread looks before it sleeps. A look takes 25 to 50 ns, so this is 25 to 50 us. A
// policy for 64 robots takes less; to wake a thread takes 10 us or more.
constexpr int kLooks = 1000;

// Processors on which this thread, and those that it starts, may run.
int usable_processors() {
  cpu_set_t usable;
  if (sched_getaffinity(0, sizeof usable, &usable) == 0) return CPU_COUNT(&usable);
  return static_cast<int>(std::thread::hardware_concurrency());
}

// Lets the processor rest for a moment.
void pause() {
#if defined(__x86_64__)
  __builtin_ia32_pause();
#elif defined(__aarch64__)
  asm volatile("isb");
#endif
}

}  // namespace

void Signal::wait(const std::function<bool()>& is_there) {
  for (int i = 0; i < looks_; ++i) {
    if (is_there()) return;
    pause();
  }
  std::unique_lock lock(mutex_);
  ++sleepers_;
  changed_.wait(lock, is_there);
  --sleepers_;
}

void Signal::send() {
  if (sleepers_ == 0) return;
  // A sleeper that has looked before the change has the mutex until it sleeps.
  { const std::lock_guard lock(mutex_); }
  changed_.notify_all();
}

WorkerPool::WorkerPool(int threads)
    : parts_(static_cast<std::size_t>(threads)),
      begun_(threads <= usable_processors() ? kLooks : 0),
      ended_(threads <= usable_processors() ? kLooks : 0) {
  try {
    for (int worker = 1; worker < threads; ++worker) {
      started_.emplace_back([this, worker] { serve(worker); });
    }
  } catch (...) {
    stop();
    throw;
  }
}

WorkerPool::~WorkerPool() { stop(); }

void WorkerPool::stop() {
  stopping_ = true;
  begun_.send();
  for (std::thread& thread : started_) thread.join();
}

// A thread first counts itself as working and then looks whether the round is open; run() first
// closes the round and then looks whether a thread is working. All of it is in sequentially
// consistent order, so run() waits for each thread that has seen its round open, and what the
// thread has written is visible to the caller.
void WorkerPool::serve(int worker) {
  std::uint64_t done = 0;
  while (true) {
    begun_.wait([&] {
      const std::uint64_t round = round_;
      return stopping_ || (round % 2 == 1 && round != done);
    });
    if (stopping_) return;
    ++working_;
    const std::uint64_t round = round_;
    if (round % 2 == 1) {
      work_as(worker);
      done = round;
    }
    if (--working_ == 0) ended_.send();
  }
}

void WorkerPool::work_as(int worker) {
  const std::size_t count = parts_.size();
  for (std::size_t k = 0; k < count; ++k) {
    Part& part = parts_[(static_cast<std::size_t>(worker) + k) % count];
    while (true) {
      const int item = part.next.fetch_add(1, std::memory_order_relaxed);
      if (item >= part.end) break;
      (*work_)(item, worker);
    }
  }
}

void WorkerPool::run(int count, const std::function<void(int, int)>& work) {
  const auto parts = static_cast<std::int64_t>(parts_.size());
  for (std::int64_t k = 0; k < parts; ++k) {
    Part& part = parts_[static_cast<std::size_t>(k)];
    part.next.store(static_cast<int>(k * count / parts), std::memory_order_relaxed);
    part.end = static_cast<int>((k + 1) * count / parts);
  }
  work_ = &work;
  ++round_;
  begun_.send();
  work_as(0);
  ++round_;
  // All parts are empty, so the others finish at most an item each.
  ended_.wait([this] { return working_ == 0; });
}

}  // namespace sim::parallel
