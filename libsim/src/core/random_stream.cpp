// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/core/random_stream.h"

#include <cmath>

#include "sim/core/hash.h"

namespace sim {
namespace {

std::uint64_t stream_seed(std::uint64_t world_seed, std::string_view component_path) {
  StateHash hash;
  hash.add(world_seed);
  hash.add(component_path);
  return hash.value();
}

}  // namespace

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
  const double factor = std::sqrt(-2.0 * std::log(s) / s);
  spare_ = v * factor;
  has_spare_ = true;
  return u * factor;
}

}  // namespace sim
