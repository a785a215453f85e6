// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/core/random_stream.h"

#include <cmath>

#include "sim/core/hash.h"
#include "sim/core/math.h"
#include "sim/core/state_archive.h"

namespace sim {
namespace {

std::uint64_t stream_seed(std::uint64_t world_seed, std::string_view component_path) {
  StateHash hash;
  hash.add(world_seed);
  hash.add(component_path);
  return hash.value();
}

}  // namespace

MersenneTwister::MersenneTwister(std::uint64_t seed) noexcept : next_(kSize) {
  words_[0] = seed;
  for (std::size_t i = 1; i < kSize; ++i) {
    words_[i] = 6364136223846793005ULL * (words_[i - 1] ^ (words_[i - 1] >> 62)) + i;
  }
}

void MersenneTwister::twist() noexcept {
  constexpr std::size_t kShift = 156;
  constexpr std::uint64_t kUpper = ~std::uint64_t{0} << 31;
  const auto mixed = [this](std::size_t i, std::size_t following, std::size_t shifted) {
    const std::uint64_t y = (words_[i] & kUpper) | (words_[following] & ~kUpper);
    return words_[shifted] ^ (y >> 1) ^ ((y & 1) != 0 ? 0xb5026f5aa96619e9ULL : 0);
  };
  std::size_t i = 0;
  for (; i < kSize - kShift; ++i) words_[i] = mixed(i, i + 1, i + kShift);
  for (; i < kSize - 1; ++i) words_[i] = mixed(i, i + 1, i + kShift - kSize);
  words_[i] = mixed(i, 0, kShift - 1);
  next_ = 0;
}

void MersenneTwister::archive(StateArchive& archive) {
  archive.index(next_, kSize + 1);
  archive.raw(words_.data(), sizeof words_);
}

RandomStream::RandomStream(std::uint64_t world_seed, std::string_view component_path)
    : engine_(stream_seed(world_seed, component_path)) {}

double RandomStream::uniform() {
  ++draws_;
  return static_cast<double>(engine_() >> 11) * 0x1.0p-53;
}

double RandomStream::normal() {
  if (has_spare_) {
    has_spare_ = false;
    return spare_;
  }
  double u = 0.0;
  double v = 0.0;
  double s = 0.0;
  do {
    u = 2.0 * uniform() - 1.0;
    v = 2.0 * uniform() - 1.0;
    s = u * u + v * v;
  } while (s >= 1.0 || s == 0.0);
  const double factor = std::sqrt(-2.0 * math::log(s) / s);
  spare_ = v * factor;
  has_spare_ = true;
  return u * factor;
}

void RandomStream::archive(StateArchive& archive) {
  archive(draws_, has_spare_, spare_);
  if (draws_ > 0) archive(engine_);
}

}  // namespace sim
