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

/// A change of atomic variables that threads wait for: actively for a short time, then asleep.
///
/// The variables are written before send(), and both they and the count of sleepers are read and
/// written in sequentially consistent order. So either send() sees that a thread is about to sleep,
/// or that thread sees the change.
class Signal {
 public:
  /// @param looks  how often a thread looks for the change before it sleeps.
  explicit Signal(int looks) : looks_(looks) {}

  /// Returns as soon as there is what the caller waits for.
  /// @param is_there  reads the variables, and does not throw.
  void wait(const std::function<bool()>& is_there);
  /// Wakes all threads that are asleep. Costs nothing if none is.
  void send();

 private:
  int looks_;
  std::atomic<int> sleepers_ = 0;  // written under mutex_
  std::mutex mutex_;
  std::condition_variable changed_;
};

/// Threads that share the items of a loop. Each begins with its own part of the items, in every
/// run() the same, so that what belongs to an item stays in the cache of one processor. A thread
/// that has finished its part takes items of the others.
///
/// Between two calls of run() the threads look for the next one for some tens of microseconds, then
/// they sleep. They sleep at once if there are more threads than processors.
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
  /// Returns when all calls have returned. Does not wait for threads that have not begun.
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
  Signal begun_;
  Signal ended_;
  // Odd while a round of run() is open: threads may begin to work for it.
  alignas(64) std::atomic<std::uint64_t> round_ = 0;
  std::atomic<bool> stopping_ = false;
  // Started threads that have begun and not finished.
  alignas(64) std::atomic<int> working_ = 0;
  std::vector<std::thread> started_;
};

}  // namespace sim::parallel
