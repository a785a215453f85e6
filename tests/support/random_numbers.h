// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <random>

namespace sim::test {

/// Random numbers that are equal with every standard library, unlike those of its distributions.
class Random {
 public:
  explicit Random(std::uint32_t seed) : engine_(seed) {}
  /// A number in [low, high).
  [[nodiscard]] double uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_()) / 4294967296.0;
  }

 private:
  std::mt19937 engine_;
};

}  // namespace sim::test
