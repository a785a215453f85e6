// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "sim/devices/laser.h"

/// Geometry and settings of rangefinders, as their devices' properties describe them, and the part
/// of a scan that a client has chosen. The proxies and Player's wire protocol share them.
namespace playerlike {

/// Resolution of ranges that rangefinders report until a client sets another one [m]. It is the
/// resolution in the data sheets of the S1R's Hokuyo URG-04LX and of the SICK LMS200.
inline constexpr double kRangeResolution_m = 0.001;

/// Pose of a sensor, or of one of its elements, on the robot's body.
struct Mounting {
  double x_m = 0.0;
  double y_m = 0.0;
  double z_m = 0.0;
  double yaw_rad = 0.0;
};

/// Size of a device.
struct BoxSize {
  double width_m = 0.0;   ///< along y
  double length_m = 0.0;  ///< along x
  double height_m = 0.0;
};

/// The numeric settings of a device, see DeviceInfo::properties.
using DeviceSettings = std::map<std::string, double>;

/// A property of a device; 0 if it has none of that name.
[[nodiscard]] double setting_of(const DeviceSettings& settings, const std::string& name);

/// Maximum of count_of().
inline constexpr std::size_t kMostElements = std::size_t{1} << 20U;

/// A property of a device that is a count; 0 if it has none of that name.
/// @throws SessionError kNotAvailable unless it is a whole number up to kMostElements, since
///         servers may send anything.
[[nodiscard]] std::size_t count_of(const DeviceSettings& settings, const std::string& name);

/// The mounting of a device, from its properties mount_x, mount_y, height and mount_yaw.
[[nodiscard]] Mounting mounting_of(const DeviceSettings& settings);

/// The mountings of a device's elements, from its properties count, mount_x_0, mount_y_0,
/// mount_yaw_0, ... and height. @throws SessionError as count_of().
[[nodiscard]] std::vector<Mounting> element_mountings(const DeviceSettings& settings);

/// What a laser's settings say before its first scan.
struct ScannerSettings {
  std::size_t count = 0;    ///< number of beams
  double least_rad = 0.0;   ///< angle of the first beam
  double native_rad = 0.0;  ///< between neighbouring beams
  double range_max_m = 0.0;
  double frequency_hz = 0.0;
  Mounting mounting;  ///< of the laser on the body
  BoxSize size;       ///< of the laser's case
};

/// Reads the settings from a laser's properties. @throws SessionError as count_of().
[[nodiscard]] ScannerSettings scanner_settings(const DeviceSettings& settings);

/// The beams of a scanner that a client sees: `shown` beams, beginning at `first`, every
/// `stride`-th.
struct BeamWindow {
  std::size_t first = 0;
  std::size_t stride = 1;
  std::size_t shown = 0;
};

/// The beams within [min_rad, max_rad] with a spacing as close to `resolution_rad` as the scanner
/// allows (0: all beams).
/// @param count, least_rad, native_rad  the scanner's number of beams, first angle and spacing.
/// @throws SessionError kBadArgument if no beam lies there.
[[nodiscard]] BeamWindow window_of(double min_rad, double max_rad, double resolution_rad,
                                   std::size_t count, double least_rad, double native_rad);

/// The scan that a client sees before the first reading: no beams.
[[nodiscard]] sim::SharedReading announced_scan(const ScannerSettings& scanner);

/// The beams of a scan that lie in a window; empty if there are none.
[[nodiscard]] std::shared_ptr<sim::LaserReading> part_of(const sim::LaserReading& scan,
                                                         const BeamWindow& window);

/// Angle of a beam of a scan [rad].
[[nodiscard]] inline double bearing_rad(const sim::LaserReading& scan, std::size_t beam) {
  return scan.angle_min_rad + static_cast<double>(beam) * scan.resolution_rad;
}

/// A range, rounded to a multiple of the resolution (0: not rounded) and clamped to
/// [min_m, max_m].
[[nodiscard]] double limited_range_m(double range_m, double resolution_m, double min_m,
                                     double max_m);

}  // namespace playerlike
