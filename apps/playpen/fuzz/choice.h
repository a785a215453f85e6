// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "sim/core/math.h"
#include "sim/core/random_stream.h"

namespace playpen::fuzz {

/// Uniform in [low, high).
[[nodiscard]] inline double between(sim::RandomStream& random, double low, double high) {
  return low + (high - low) * random.uniform();
}
/// Uniform in its logarithm, so that small numbers are as likely as large ones. @pre low > 0
[[nodiscard]] inline double scale_between(sim::RandomStream& random, double low, double high) {
  return low * sim::math::pow(high / low, random.uniform());
}
/// From 0 to count - 1, each equally likely. @pre count > 0
[[nodiscard]] inline std::size_t index_below(sim::RandomStream& random, std::size_t count) {
  return std::min(static_cast<std::size_t>(random.uniform() * static_cast<double>(count)),
                  count - 1);
}
[[nodiscard]] inline bool chance(sim::RandomStream& random, double probability) {
  return random.uniform() < probability;
}

}  // namespace playpen::fuzz
