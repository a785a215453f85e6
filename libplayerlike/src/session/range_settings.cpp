// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "session/range_settings.h"

#include <algorithm>
#include <cmath>

#include "playerlike/messages/messages.h"

namespace playerlike {

double setting_of(const DeviceSettings& settings, const std::string& name) {
  const auto it = settings.find(name);
  return it == settings.end() ? 0.0 : it->second;
}

std::size_t count_of(const DeviceSettings& settings, const std::string& name) {
  const double count = setting_of(settings, name);
  if (count >= 0.0 && count <= static_cast<double>(kMostElements) && count == std::floor(count)) {
    return static_cast<std::size_t>(count);
  }
  throw SessionError(SessionError::Code::kNotAvailable,
                     "the server says that a device has " + std::to_string(count) + " of its \"" +
                         name + "\"; expected a whole number from 0 to " +
                         std::to_string(kMostElements));
}

Mounting mounting_of(const DeviceSettings& settings) {
  return {setting_of(settings, "mount_x"), setting_of(settings, "mount_y"),
          setting_of(settings, "height"), setting_of(settings, "mount_yaw")};
}

std::vector<Mounting> element_mountings(const DeviceSettings& settings) {
  std::vector<Mounting> mountings(count_of(settings, "count"));
  const double height_m = setting_of(settings, "height");
  for (std::size_t i = 0; i < mountings.size(); ++i) {
    const std::string number = std::to_string(i);
    mountings[i] = {setting_of(settings, "mount_x_" + number),
                    setting_of(settings, "mount_y_" + number), height_m,
                    setting_of(settings, "mount_yaw_" + number)};
  }
  return mountings;
}

ScannerSettings scanner_settings(const DeviceSettings& settings) {
  ScannerSettings scanner;
  scanner.count = count_of(settings, "beams");
  scanner.native_rad = setting_of(settings, "resolution");
  if (const auto least = settings.find("angle_min"); least != settings.end()) {
    scanner.least_rad = least->second;
  } else if (scanner.count > 0) {  // the simulated laser is symmetric about forward
    scanner.least_rad = -0.5 * static_cast<double>(scanner.count - 1) * scanner.native_rad;
  }
  scanner.range_max_m = setting_of(settings, "range_max");
  scanner.frequency_hz = setting_of(settings, "frequency");
  scanner.mounting = mounting_of(settings);
  scanner.size = {setting_of(settings, "size_y"), setting_of(settings, "size_x"),
                  setting_of(settings, "size_height")};
  return scanner;
}

BeamWindow window_of(double min_rad, double max_rad, double resolution_rad, std::size_t count,
                     double least_rad, double native_rad) {
  // Tolerance for equal angles, as a fraction of the beam spacing.
  constexpr double kSameBeam = 1e-6;
  const double last = static_cast<double>(count) - 1.0;
  const double begin = std::max(0.0, std::ceil((min_rad - least_rad) / native_rad - kSameBeam));
  const double end = std::min(last, std::floor((max_rad - least_rad) / native_rad + kSameBeam));
  if (!(begin <= end)) {
    throw SessionError(SessionError::Code::kBadArgument,
                       "no beam lies between " + std::to_string(min_rad) + " and " +
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

sim::SharedReading announced_scan(const ScannerSettings& scanner) {
  auto scan = std::make_shared<sim::LaserReading>();
  scan->angle_min_rad = scanner.least_rad;
  scan->resolution_rad = scanner.native_rad;
  scan->range_max_m = scanner.range_max_m;
  return scan;
}

std::shared_ptr<sim::LaserReading> part_of(const sim::LaserReading& scan,
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
  if (scan.intensities.size() == scan.ranges_m.size()) {
    part->intensities.resize(window.shown);
    for (std::size_t i = 0; i < window.shown; ++i) {
      part->intensities[i] = scan.intensities[window.first + i * window.stride];
    }
  }
  return part;
}

double limited_range_m(double range_m, double resolution_m, double min_m, double max_m) {
  if (resolution_m > 0.0) range_m = std::round(range_m / resolution_m) * resolution_m;
  return std::min(std::max(range_m, min_m), max_m);
}

}  // namespace playerlike
