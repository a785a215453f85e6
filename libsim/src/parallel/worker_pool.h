// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace sim::parallel {

/// Threads that share the items of a loop. Each begins with its own part of the items, in every
/// run() the same, so that what belongs to an item stays in the cache of one processor. A thread
/// that has finished its part takes items of the others.
class WorkerPool {
 public:
  /// Starts threads - 1 threads: the caller of run() works, too.
  /// @param threads  > 0.
  /// @throws std::system_error if the system has no more threads.
  explicit WorkerPool(int threads);
  ~WorkerPool();
  WorkerPool(const WorkerPool&) = delete;
  WorkerPool& operator=(const WorkerPool&) = delete;

  [[nodiscard]] int threads() const noexcept { return static_cast<int>(parts_.size()); }

  /// Calls work(item, worker) once for each item in [0, count), with worker in [0, threads()).
  /// Returns when all calls have returned.
  /// @param work  must not throw. Calls with the same worker do not overlap.
  void run(int count, const std::function<void(int item, int worker)>& work);

 private:
  // The next item of a part, alone on its cache line.
  struct alignas(64) Part {
    std::atomic<int> next = 0;
    int end = 0;
  };

  void serve(int worker);
  void work_as(int worker);
  void stop();

  std::vector<Part> parts_;
  const std::function<void(int, int)>* work_ = nullptr;
  std::mutex mutex_;
  std::condition_variable begun_;
  std::condition_variable ended_;
  std::uint64_t round_ = 0;       // guarded by mutex_
  bool stopping_ = false;         // guarded by mutex_
  std::atomic<int> working_ = 0;  // started threads that have not finished the round
  std::vector<std::thread> started_;
};

}  // namespace sim::parallel
