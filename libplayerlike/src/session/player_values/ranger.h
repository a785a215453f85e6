// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "playerlike/messages/messages.h"
#include "session/player_values/poses.h"
#include "session/range_settings.h"
#include "sim/devices/rangers.h"

/// @file
/// Player's interfaces ranger and ir, and what sonar shares with them.
namespace playerlike {

/// The poses of a device's elements. @throws SessionError as element_mountings().
template <typename Pose3d>
[[nodiscard]] std::vector<Pose3d> element_poses(const DeviceSettings& settings) {
  std::vector<Pose3d> poses;
  for (const Mounting& element : element_mountings(settings)) {
    poses.push_back(to_players<Pose3d>(element));
  }
  return poses;
}

/// The intensity of a range of simulated rangers, which have the same for all echoes.
[[nodiscard]] inline double echo_intensity(double range_m, double range_max_m, double echo) {
  return range_m < range_max_m ? echo : 0.0;
}

/// The voltage of an element: as measured, or that of its range.
[[nodiscard]] inline double voltage_v(const sim::RangerReading& ring, std::size_t element,
                                      const DeviceSettings& settings) {
  if (element < ring.voltages_v.size()) return ring.voltages_v[element];
  return sim::infrared_voltage_v(ring.ranges_m[element], setting_of(settings, "voltage_gain"),
                                 setting_of(settings, "voltage_shift"));
}

/// How a client has limited and rounded the ranges.
struct RangeLimits {
  double min_m = 0.0;
  double max_m = 0.0;
  double resolution_m = 0.0;  ///< 0: not rounded
  bool any = false;           ///< whether there are any

  [[nodiscard]] double limited_m(double range_m) const {
    return any ? limited_range_m(range_m, resolution_m, min_m, max_m) : range_m;
  }
};

/// The limits in a configuration. @param wish  `max_m` 0: the sensor's. @param most_m  the
/// sensor's.
/// @throws SessionError kBadArgument for negative numbers.
[[nodiscard]] inline RangeLimits range_limits(RangeLimits wish, double most_m) {
  if (wish.min_m < 0.0 || wish.max_m < 0.0 || wish.resolution_m < 0.0) {
    throw SessionError(SessionError::Code::kBadArgument,
                       "a range, or the resolution of ranges, is negative");
  }
  wish.max_m = wish.max_m > 0.0 ? std::min(wish.max_m, most_m) : most_m;
  wish.min_m = std::min(wish.min_m, wish.max_m);
  wish.any = wish.resolution_m > 0.0 || wish.min_m > 0.0 || wish.max_m != most_m;
  return wish;
}

}  // namespace playerlike
