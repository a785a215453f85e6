// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "parallel/worker_pool.h"

#include <cstddef>

namespace sim::parallel {

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
    lock.lock();
    if (--working_ == 0) ended_.notify_one();
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
      working_ = static_cast<int>(started_.size());
    }
    begun_.notify_all();
  }
  work_as(0);
  std::unique_lock lock(mutex_);
  ended_.wait(lock, [this] { return working_ == 0; });
}

}  // namespace sim::parallel
