// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "parallel/worker_pool.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cstddef>
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
TEST(WorkerPool, SlowItem_OthersTakeItsPart) {
  WorkerPool pool(2);
  std::atomic<int> done = 0;
  pool.run(10, [&](int item, int) {
    // Item 0 begins the caller's part; it ends only after all others.
    while (item == 0 && done < 9) std::this_thread::yield();
    ++done;
  });
  EXPECT_EQ(done, 10);
}

}  // namespace
}  // namespace sim::parallel
