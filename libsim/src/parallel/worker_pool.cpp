// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "parallel/worker_pool.h"

#include <cstddef>

namespace sim::parallel {
namespace {

// How often the caller looks whether the others have finished, before it sleeps: some microseconds.
constexpr int kSpins = 50;

void relax() {
#if defined(__x86_64__)
  __builtin_ia32_pause();
#endif
}

}  // namespace

WorkerPool::WorkerPool(int threads) : parts_(static_cast<std::size_t>(threads)) {
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
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  begun_.notify_all();
  for (std::thread& thread : started_) thread.join();
}

void WorkerPool::serve(int worker) {
  std::uint64_t done = 0;
  std::unique_lock lock(mutex_);
  while (true) {
    begun_.wait(lock, [&] { return stopping_ || round_ != done; });
    if (stopping_) return;
    done = round_;
    lock.unlock();
    work_as(worker);
    const bool is_last = working_.fetch_sub(1, std::memory_order_acq_rel) == 1;
    lock.lock();
    if (is_last) ended_.notify_one();
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
  if (!started_.empty()) {
    {
      const std::lock_guard lock(mutex_);
      ++round_;
      working_.store(static_cast<int>(started_.size()), std::memory_order_relaxed);
    }
    begun_.notify_all();
  }
  work_as(0);
  // All parts are empty, so the others finish at most an item: to sleep would take longer.
  const auto is_over = [this] { return working_.load(std::memory_order_acquire) == 0; };
  for (int i = 0; i < kSpins; ++i) {
    if (is_over()) return;
    relax();
  }
  std::unique_lock lock(mutex_);
  ended_.wait(lock, is_over);
}

}  // namespace sim::parallel
