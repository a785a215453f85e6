// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace sim {

class StateArchive;

/// A std::mt19937_64 whose state can be saved. The C++ standard fixes its output.
///
/// M. Matsumoto and T. Nishimura, "Mersenne twister: a 623-dimensionally equidistributed uniform
/// pseudo-random number generator", ACM TOMACS 8(1), 1998; the 64-bit constants are those of the
/// standard ([rand.predef]).
class MersenneTwister {
 public:
  explicit MersenneTwister(std::uint64_t seed) noexcept;

  [[nodiscard]] std::uint64_t operator()() noexcept {
    if (next_ == kSize) twist();
    std::uint64_t y = words_[next_++];
    y ^= (y >> 29) & 0x5555555555555555ULL;
    y ^= (y << 17) & 0x71d67fffeda60000ULL;
    y ^= (y << 37) & 0xfff7eee000000000ULL;
    return y ^ (y >> 43);
  }
  /// Writes or reads the state.
  void archive(StateArchive& archive);

 private:
  void twist() noexcept;

  static constexpr std::size_t kSize = 312;

  std::array<std::uint64_t, kSize> words_{};
  std::size_t next_;
};

/// The random numbers of one component, independent of all other streams.
///
/// The seed is made of the world's seed and the component's path (e.g. "r1/laser"), so adding a
/// sensor does not change the noise of the others. The distributions are implemented here, because
/// the standard does not fix the output of its own. Not thread-safe; each stream belongs to one
/// component.
class RandomStream {
 public:
  RandomStream(std::uint64_t world_seed, std::string_view component_path);

  /// Uniform in [0, 1), 53 bits.
  [[nodiscard]] double uniform();

  /// Standard normal deviate, by Marsaglia's polar method (G. Marsaglia and T. A. Bray, "A
  /// convenient method for generating normal variables", SIAM Review 6(3), 1964).
  [[nodiscard]] double normal();

  /// Gaussian with mean 0 and the given standard deviation. If sigma is 0, the result is exactly 0
  /// and no number is drawn.
  [[nodiscard]] double gaussian(double sigma) { return sigma > 0.0 ? sigma * normal() : 0.0; }

  /// Number of 64-bit words drawn so far.
  [[nodiscard]] std::uint64_t draws() const noexcept { return draws_; }
  /// Writes or reads the state. A stream that has not been drawn from is stored as its seed alone.
  void archive(StateArchive& archive);

 private:
  MersenneTwister engine_;
  std::uint64_t draws_ = 0;
  double spare_ = 0.0;
  bool has_spare_ = false;
};

}  // namespace sim
