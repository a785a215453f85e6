// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <memory>
#include <string>

#include "devices/errors.h"
#include "libplayerc++/playererror.h"
#include "libplayerc++/playerstructs.h"
#include "proxies/sensor_support.h"
#include "sim/devices/laser.h"

namespace PlayerCc::detail {

/// Resolution of ranges that rangefinders report until Configure() sets another one [m]. It is the
/// resolution in the data sheets of the S1R's Hokuyo URG-04LX and of the SICK LMS200.
inline constexpr double kRangeResolution_m = 0.001;

/// What a laser's settings say before its first scan.
struct ScannerSettings {
  std::size_t count = 0;    ///< number of beams
  double least_rad = 0.0;   ///< angle of the first beam
  double native_rad = 0.0;  ///< between neighbouring beams
  double range_max_m = 0.0;
  double frequency_hz = 0.0;
  player_pose3d_t pose = {0.0, 0.0, 0.0, 0.0, 0.0, 0.0};  ///< of the laser on the body
  player_bbox3d_t size = {0.0, 0.0, 0.0};                 ///< of the laser's case
};

/// Reads the settings from a laser's properties.
inline ScannerSettings scanner_settings(const std::map<std::string, double>& settings) {
  const auto property = [&](const char* name) { return setting_of(settings, name); };
  ScannerSettings scanner;
  scanner.count = count_of(settings, "beams");
  scanner.native_rad = property("resolution");
  // The simulated laser is symmetric about forward.
  if (scanner.count > 0) {
    scanner.least_rad = -0.5 * static_cast<double>(scanner.count - 1) * scanner.native_rad;
  }
  scanner.range_max_m = property("range_max");
  scanner.frequency_hz = property("frequency");
  scanner.pose = {property("mount_x"),  property("mount_y"), property("height"), 0.0, 0.0,
                  property("mount_yaw")};
  scanner.size = {property("size_y"), property("size_x"), property("size_height")};
  return scanner;
}

/// The beams of a scanner that a proxy exposes: `shown` beams, beginning at `first`, every
/// `stride`-th.
struct BeamWindow {
  std::size_t first = 0;
  std::size_t stride = 1;
  std::size_t shown = 0;
};

/// The beams within [min_rad, max_rad] with a spacing as close to `resolution_rad` as the scanner
/// allows (0: all beams).
/// @param count, least_rad, native_rad  the scanner's number of beams, first angle and spacing.
/// @throws PlayerError kBadArgument in the name of `fun` if no beam lies there.
inline BeamWindow window_of(const char* fun, double min_rad, double max_rad, double resolution_rad,
                            std::size_t count, double least_rad, double native_rad) {
  // Tolerance for equal angles, as a fraction of the beam spacing.
  constexpr double kSameBeam = 1e-6;
  const double last = static_cast<double>(count) - 1.0;
  const double begin = std::max(0.0, std::ceil((min_rad - least_rad) / native_rad - kSameBeam));
  const double end = std::min(last, std::floor((max_rad - least_rad) / native_rad + kSameBeam));
  if (!(begin <= end)) {
    playerlike::refuse(fun, "no beam lies between " + std::to_string(min_rad) + " and " +
                                std::to_string(max_rad) + " rad; this laser's lie from " +
                                std::to_string(least_rad) + " to " +
                                std::to_string(least_rad + last * native_rad) + " rad");
  }
  // A server may report a spacing of zero: then the window has all beams.
  const double ratio = std::round(resolution_rad / native_rad);
  const auto stride = static_cast<std::size_t>(ratio >= 1.0 ? std::min(ratio, last + 1.0) : 1.0);
  return {static_cast<std::size_t>(begin), stride,
          static_cast<std::size_t>(end - begin) / stride + 1};
}

/// The scan that a proxy exposes before the first reading: no beams.
inline sim::SharedReading announced_scan(const ScannerSettings& scanner) {
  auto scan = std::make_shared<sim::LaserReading>();
  scan->angle_min_rad = scanner.least_rad;
  scan->resolution_rad = scanner.native_rad;
  scan->range_max_m = scanner.range_max_m;
  return scan;
}

/// The beams of a scan that lie in a window; empty if there are none.
inline std::shared_ptr<sim::LaserReading> part_of(const sim::LaserReading& scan,
                                                  const BeamWindow& window) {
  auto part = std::make_shared<sim::LaserReading>();
  part->time_ns = scan.time_ns;
  part->sequence = scan.sequence;
  part->angle_min_rad =
      scan.angle_min_rad + static_cast<double>(window.first) * scan.resolution_rad;
  part->resolution_rad = scan.resolution_rad * static_cast<double>(window.stride);
  part->range_max_m = scan.range_max_m;
  if (scan.ranges_m.empty()) return part;
  part->ranges_m.resize(window.shown);
  for (std::size_t i = 0; i < window.shown; ++i) {
    part->ranges_m[i] = scan.ranges_m[window.first + i * window.stride];
  }
  return part;
}

/// The reading to which the elements belong, as its own type.
template <typename Reading>
const Reading& owner_of(const Elements& elements) {
  return static_cast<const Reading&>(*static_cast<const sim::Reading*>(elements.Owner()));
}

/// Angle of a beam of the window [rad].
inline double bearing_rad(const sim::LaserReading& scan, std::size_t beam) {
  return scan.angle_min_rad + static_cast<double>(beam) * scan.resolution_rad;
}

}  // namespace PlayerCc::detail
