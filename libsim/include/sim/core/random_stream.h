// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <random>
#include <string_view>

namespace sim {

/// A stream of random numbers of one component, independent of all others.
///
/// Seeded by the world's seed and the component's path (e.g. "r1/laser"), so that adding a
/// sensor leaves the noise of the others unchanged. The engine is std::mt19937_64, whose output
/// the C++ standard fixes; distributions are ours, since the standard leaves theirs open.
/// Not thread-safe; each stream belongs to one component.
class RandomStream {
 public:
  RandomStream(std::uint64_t world_seed, std::string_view component_path);

  /// Uniform in [0, 1), 53 bits.
  [[nodiscard]] double uniform();

  /// Standard normal deviate, by Marsaglia's polar method (G. Marsaglia and T. A. Bray, "A
  /// convenient method for generating normal variables", SIAM Review 6(3), 1964).
  [[nodiscard]] double normal();

  /// Gaussian with mean 0 and the given deviation; exactly 0, and no draw, when sigma is 0.
  [[nodiscard]] double gaussian(double sigma) { return sigma > 0.0 ? sigma * normal() : 0.0; }

  /// How many 64-bit words were drawn: with the seed, the stream's whole state (for hashing).
  [[nodiscard]] std::uint64_t draws() const noexcept { return draws_; }

 private:
  std::mt19937_64 engine_;
  std::uint64_t draws_ = 0;
  double spare_ = 0.0;
  bool has_spare_ = false;
};

}  // namespace sim
