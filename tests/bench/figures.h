// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <vector>

namespace sim::bench {

/// Prints a result of a benchmark as the line "figure NAME VALUE".
inline void figure(const char* name, double value) { std::printf("figure %s %.6g\n", name, value); }

/// Seconds that one call of f takes: the minimum over `rounds` rounds of `calls` calls each,
/// because other processes can only add time.
template <typename F>
[[nodiscard]] double seconds_per_call(F f, int calls, int rounds = 9) {
  using Clock = std::chrono::steady_clock;
  double best = 1e30;
  for (int r = 0; r < rounds; ++r) {
    const auto begin = Clock::now();
    for (int i = 0; i < calls; ++i) f();
    const std::chrono::duration<double> took = Clock::now() - begin;
    best = std::min(best, took.count() / calls);
  }
  return best;
}

}  // namespace sim::bench
