// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "physics/hilbert_curve.h"

#include <algorithm>
#include <utility>

namespace sim {

std::uint32_t along_hilbert_curve(const Vec2& p_W) {
  constexpr std::uint32_t kSide = 1U << 16;
  const auto square = [](double x_m) {
    constexpr double kLast = kSide - 1;
    return static_cast<std::uint32_t>(std::clamp(x_m / kHilbertSquare_m + 0.5 * kSide, 0.0, kLast));
  };
  std::uint32_t x = square(p_W.x());
  std::uint32_t y = square(p_W.y());
  std::uint32_t along = 0;
  // Descends into quarters, which the curve visits in this order: lower left, upper left, upper
  // right, lower right.
  for (std::uint32_t half = kSide / 2; half > 0; half /= 2) {
    const bool right = (x & half) != 0;
    const bool upper = (y & half) != 0;
    along += half * half * (right ? (upper ? 2U : 3U) : (upper ? 1U : 0U));
    if (upper) continue;
    // In the lower quarters the curve is mirrored at a diagonal.
    if (right) {
      x = kSide - 1 - x;
      y = kSide - 1 - y;
    }
    std::swap(x, y);
  }
  return along;
}

}  // namespace sim
