// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "parallel/worker_pool.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

namespace sim::parallel {
namespace {

using testing::Each;

TEST(WorkerPool, EachItemOnce_AnyNumberOfThreads) {
  for (const int threads : {1, 2, 5}) {
    WorkerPool pool(threads);
    for (const int count : {0, 1, 3, 1000}) {
      std::vector<int> calls(static_cast<std::size_t>(count));
      std::vector<std::atomic<int>> busy(static_cast<std::size_t>(threads));
      std::atomic<int> overlaps = 0;
      for (int round = 0; round < 3; ++round) {
        pool.run(count, [&](int item, int worker) {
          std::atomic<int>& own = busy[static_cast<std::size_t>(worker)];
          if (own.fetch_add(1) != 0) ++overlaps;
          ++calls[static_cast<std::size_t>(item)];
          --own;
        });
      }
      EXPECT_THAT(calls, Each(3));
      EXPECT_EQ(overlaps, 0);
    }
  }
}

// The thread of an item that waits for another part does not keep the others from going on.
void run_with_slow_item(WorkerPool& pool) {
  std::atomic<int> done = 0;
  pool.run(10, [&](int item, int) {
    // Item 0 begins the caller's part; it ends only after all others.
    while (item == 0 && done < 9) std::this_thread::yield();
    ++done;
  });
  EXPECT_EQ(done, 10);
}

TEST(WorkerPool, SlowItem_OthersTakeItsPart) {
  WorkerPool pool(2);
  run_with_slow_item(pool);
}

// Rounds follow one another at once, after a short while and after a sleep of the threads. A caller
// that is not woken would end the test by its timeout.
TEST(WorkerPool, RoundsAtAnyTime_EachItemOnce) {
  for (const int threads : {2, 3, 16}) {
    WorkerPool pool(threads);
    std::vector<int> calls(5);
    constexpr int kRounds = 200;
    for (int round = 0; round < kRounds; ++round) {
      if (round % 50 == 0) std::this_thread::sleep_for(std::chrono::microseconds(300));
      for (std::atomic<int> wait = 0; wait < (round % 7) * 1000;) ++wait;
      pool.run(5, [&](int item, int) { ++calls[static_cast<std::size_t>(item)]; });
    }
    EXPECT_THAT(calls, Each(kRounds)) << threads;
  }
}

TEST(WorkerPool, EndsBeforeAndAfterRounds) {
  for (int rounds = 0; rounds < 30; ++rounds) {
    std::atomic<int> calls = 0;
    {
      WorkerPool pool(2);
      for (int round = 0; round < rounds % 3; ++round) pool.run(2, [&](int, int) { ++calls; });
    }
    ASSERT_EQ(calls, 2 * (rounds % 3));
  }
}

// Number of threads of this process that are not asleep.
int awake_threads() {
  int awake = 0;
  for (const auto& task : std::filesystem::directory_iterator("/proc/self/task")) {
    std::ifstream file(task.path() / "stat");
    std::string text;
    std::getline(file, text);
    // The state follows the program's name, which is in parentheses.
    const std::size_t name_end = text.rfind(')');
    if (name_end != std::string::npos && text.compare(name_end, 3, ") S") != 0) ++awake;
  }
  return awake;
}

TEST(WorkerPool, NoFurtherRound_ThreadsSleepUntilNextOne) {
  WorkerPool pool(2);
  pool.run(2, [](int, int) {});
  constexpr int kMostTries = 10'000;
  int tries = 0;
  while (awake_threads() > 1 && tries < kMostTries) {
    ++tries;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  EXPECT_LT(tries, kMostTries);
  run_with_slow_item(pool);
}

}  // namespace
}  // namespace sim::parallel
