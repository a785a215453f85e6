// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include "sim/core/pose.h"

namespace sim::test {

/// The range along a ray to a circle that does not contain its start: |t u - c| = r, solved by the
/// formula for quadratic equations; a miss is `limit_m`.
[[nodiscard]] inline double circle_range_m(const Vec2& p, double angle_rad, const Vec2& center,
                                           double radius_m, double limit_m) {
  const Vec2 u(std::cos(angle_rad), std::sin(angle_rad));
  const double b = u.dot(center - p);
  const double discriminant = b * b - ((center - p).squaredNorm() - radius_m * radius_m);
  if (discriminant < 0.0 || b < 0.0) return limit_m;
  return std::min(limit_m, b - std::sqrt(discriminant));
}

}  // namespace sim::test
