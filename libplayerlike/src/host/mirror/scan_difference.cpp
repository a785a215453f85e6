// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "host/mirror/scan_difference.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "sim/core/pose.h"

namespace playerlike {

ScanDifference compare_scans(const sim::LaserReading& real, const sim::LaserReading& predicted) {
  ScanDifference result;
  const double limit_m = std::min(real.range_max_m, predicted.range_max_m);
  if (predicted.ranges_m.empty() || !(limit_m > 0.0)) return result;
  const auto count = static_cast<double>(predicted.ranges_m.size());
  double sum_m = 0.0;
  int different = 0;
  for (std::size_t i = 0; i < real.ranges_m.size(); ++i) {
    const double angle_rad = real.angle_min_rad + real.resolution_rad * static_cast<double>(i);
    const double beam =
        predicted.ranges_m.size() == 1
            ? 0.0
            : std::round((angle_rad - predicted.angle_min_rad) / predicted.resolution_rad);
    if (!(beam >= 0.0 && beam < count) || !std::isfinite(real.ranges_m[i])) continue;
    const double real_m = std::clamp(real.ranges_m[i], 0.0, limit_m);
    const double expected_m =
        std::clamp(predicted.ranges_m[static_cast<std::size_t>(beam)], 0.0, limit_m);
    const double difference_m = std::abs(real_m - expected_m);
    ++result.beams;
    sum_m += difference_m;
    if (difference_m <= kDifferentRange_m) continue;
    ++different;
    const bool unexpected = real_m < expected_m;
    const double place_m = unexpected ? real_m : expected_m;
    result.places.push_back({place_m * sim::unit_vector(angle_rad), unexpected});
  }
  if (result.beams == 0) return result;
  result.mean_m = sum_m / result.beams;
  result.share = static_cast<double>(different) / result.beams;
  return result;
}

}  // namespace playerlike
