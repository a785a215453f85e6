// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "session/scan_drivers.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <variant>
#include <vector>

#include "sim/core/math.h"

namespace playerlike {

std::shared_ptr<sim::LaserReading> configuration_space(const sim::LaserReading& scan,
                                                       const CspaceSettings& settings) {
  auto made = std::make_shared<sim::LaserReading>(scan);
  const std::size_t count = scan.ranges_m.size();
  std::vector<sim::Vec2> directions(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double angle_rad = scan.angle_min_rad + static_cast<double>(i) * scan.resolution_rad;
    directions[i] = {sim::math::cos(angle_rad), sim::math::sin(angle_rad)};
  }
  const double radius_m = settings.radius_m;
  const auto step = static_cast<std::size_t>(std::max(settings.step, 1));
  for (std::size_t beam = 0; beam < count; ++beam) {
    const double range_m = scan.ranges_m[beam];
    double free_m = range_m - radius_m;
    for (std::size_t i = 0; i < count; i += step) {
      const sim::Vec2 p_LQ = scan.ranges_m[i] * directions[i];
      const double along_m = p_LQ.dot(directions[beam]);
      if (along_m < 0.0 || along_m > range_m) continue;
      const double beside_m = directions[beam].x() * p_LQ.y() - directions[beam].y() * p_LQ.x();
      const double half_chord_m2 = radius_m * radius_m - beside_m * beside_m;
      if (half_chord_m2 >= 0.0) free_m = std::min(free_m, along_m - std::sqrt(half_chord_m2));
    }
    made->ranges_m[beam] = std::max(free_m, 0.0);
  }
  return made;
}

sim::SharedReading made_scan(const ScanDriverInfo& driver, const sim::SharedReading& scan) {
  const auto* cspace = std::get_if<CspaceSettings>(&driver.settings);
  if (cspace == nullptr) return scan;
  return configuration_space(static_cast<const sim::LaserReading&>(*scan), *cspace);
}

void ScanPoses::add(const sim::PoseReading& reading) {
  if (newest_ && newest_->time_ns < reading.time_ns) before_ = newest_;
  newest_ = {reading.time_ns, reading.pose};
}

bool ScanPoses::knows(sim::SimTime time_ns) const {
  return newest_ && (!interpolate_ || newest_->time_ns >= time_ns);
}

std::optional<sim::Pose> ScanPoses::at(sim::SimTime time_ns) const {
  if (!newest_) return std::nullopt;
  if (!interpolate_ || !before_ || time_ns >= newest_->time_ns) return newest_->pose;
  if (time_ns <= before_->time_ns) return before_->pose;
  const double share = static_cast<double>(time_ns - before_->time_ns) /
                       static_cast<double>(newest_->time_ns - before_->time_ns);
  const sim::Pose& a = before_->pose;
  const sim::Pose& b = newest_->pose;
  return sim::Pose{
      a.x_m + share * (b.x_m - a.x_m), a.y_m + share * (b.y_m - a.y_m),
      sim::normalize_angle(a.yaw_rad + share * sim::normalize_angle(b.yaw_rad - a.yaw_rad))};
}

}  // namespace playerlike
