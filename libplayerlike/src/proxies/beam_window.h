// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <string>

#include "libplayerc++/playererror.h"
#include "libplayerc++/playerstructs.h"
#include "proxies/sensor_support.h"

namespace PlayerCc::detail {

/// What a laser's settings say before its first scan.
struct ScannerSettings {
  std::size_t count = 0;    ///< of beams
  double least_rad = 0.0;   ///< angle of the first beam
  double native_rad = 0.0;  ///< between neighbouring ones
  double range_max_m = 0.0;
  double frequency_hz = 0.0;
  player_pose3d_t pose = {0.0, 0.0, 0.0, 0.0, 0.0, 0.0};  ///< on the body
  player_bbox3d_t size = {0.0, 0.0, 0.0};                 ///< of its case
};

/// Reads them from a laser's properties.
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

/// Which of a scanner's beams a proxy shows: `shown` of them from `first` on, each `stride`-th.
struct BeamWindow {
  std::size_t first = 0;
  std::size_t stride = 1;
  std::size_t shown = 0;
};

/// The beams within [min_rad, max_rad], as near to `resolution_rad` apart as there are (0: all).
/// @param count, least_rad, native_rad  of the scanner's beams: number, first angle, difference.
/// @throws PlayerError kBadArgument in the name of `fun` if no beam lies there.
inline BeamWindow window_of(const char* fun, double min_rad, double max_rad, double resolution_rad,
                            std::size_t count, double least_rad, double native_rad) {
  // Angles that differ by less than this part of a beam are the same.
  constexpr double kSameBeam = 1e-6;
  const double last = static_cast<double>(count) - 1.0;
  const double begin = std::max(0.0, std::ceil((min_rad - least_rad) / native_rad - kSameBeam));
  const double end = std::min(last, std::floor((max_rad - least_rad) / native_rad + kSameBeam));
  if (!(begin <= end)) {
    throw PlayerError(fun,
                      "no beam lies between " + std::to_string(min_rad) + " and " +
                          std::to_string(max_rad) + " rad; this laser's lie from " +
                          std::to_string(least_rad) + " to " +
                          std::to_string(least_rad + last * native_rad) + " rad",
                      PlayerError::kBadArgument);
  }
  // A server may say that neighbouring beams are no angle apart: then all are shown.
  const double ratio = std::round(resolution_rad / native_rad);
  const auto stride = static_cast<std::size_t>(ratio >= 1.0 ? std::min(ratio, last + 1.0) : 1.0);
  return {static_cast<std::size_t>(begin), stride,
          static_cast<std::size_t>(end - begin) / stride + 1};
}

}  // namespace PlayerCc::detail
