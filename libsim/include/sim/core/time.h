// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace sim {

/// A point in simulated time, or a duration: whole nanoseconds since the simulation's start.
///
/// Integers make a million steps of 10 ms exactly 10 000 s, and make two runs agree to the bit.
/// 2^63 ns are 292 years.
using SimTime = std::int64_t;

/// Units of SimTime in a second.
inline constexpr SimTime kNanosecondsPerSecond = 1'000'000'000;

/// Seconds as a floating-point number, with a relative error of at most 2^-53.
[[nodiscard]] constexpr double to_seconds(SimTime time_ns) noexcept {
  return static_cast<double>(time_ns) / static_cast<double>(kNanosecondsPerSecond);
}

/// The nearest whole nanosecond to `seconds` (halves away from zero).
/// @pre |seconds| < 9.2e9 (asserted by callers that read input; larger values would overflow).
[[nodiscard]] constexpr SimTime from_seconds(double seconds) noexcept {
  const double ns = seconds * static_cast<double>(kNanosecondsPerSecond);
  return static_cast<SimTime>(ns < 0.0 ? ns - 0.5 : ns + 0.5);
}

}  // namespace sim
