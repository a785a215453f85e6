// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "session/player_values/fields.h"
#include "session/range_settings.h"
#include "sim/core/time.h"
#include "sim/devices/gps.h"

/// @file
/// Player's interface gps.
namespace playerlike {

/// A fix, with the accuracy that the receiver's settings give.
template <typename Data>
[[nodiscard]] Data gps_data(const sim::GpsReading& fix, const DeviceSettings& settings) {
  constexpr double kDegrees = 180.0 / std::numbers::pi;
  // Clients divide the UTM coordinates by 100 and the dilutions of precision by 10.
  constexpr double kUtmUnits = 100.0;
  constexpr std::uint32_t kOneDop = 10;
  const bool has_fix = fix.quality > 0;
  Data data = {};
  data.time_sec = static_cast<std::uint32_t>(fix.time_ns / sim::kNanosecondsPerSecond);
  data.time_usec = static_cast<std::uint32_t>(fix.time_ns % sim::kNanosecondsPerSecond / 1000);
  data.latitude = static_cast<std::int32_t>(std::lround(1e7 * kDegrees * fix.latitude_rad));
  data.longitude = static_cast<std::int32_t>(std::lround(1e7 * kDegrees * fix.longitude_rad));
  data.altitude =
      static_cast<std::int32_t>(std::lround(std::clamp(1e3 * fix.altitude_m, -2e9, 2e9)));
  data.speed = fix.speed_mps;
  data.course = fix.course_rad;
  data.utm_e = kUtmUnits * fix.utm_easting_m;
  data.utm_n = kUtmUnits * fix.utm_northing_m;
  data.quality = static_cast<std::uint32_t>(fix.quality);
  data.num_sats = static_cast<std::uint32_t>(fix.satellites);
  data.hdop = has_fix ? kOneDop : 0;
  data.vdop = has_fix ? kOneDop : 0;
  data.err_horz = has_fix ? setting_of(settings, "noise") : 0.0;
  data.err_vert = has_fix ? setting_of(settings, "noise_vertical") : 0.0;
  return data;
}
template <typename Data>
[[nodiscard]] sim::GpsReading gps_reading(const Data& data) {
  constexpr double kAngle_rad = 1e-7 * std::numbers::pi / 180.0;
  sim::GpsReading reading;
  reading.latitude_rad = data.latitude * kAngle_rad;
  reading.longitude_rad = data.longitude * kAngle_rad;
  reading.altitude_m = data.altitude * 1e-3;
  reading.speed_mps = data.speed;
  reading.course_rad = data.course;
  reading.utm_easting_m = data.utm_e * 0.01;
  reading.utm_northing_m = data.utm_n * 0.01;
  reading.satellites = as_int(data.num_sats);
  reading.quality = as_int(data.quality);
  reading.accuracy = {data.err_horz, data.err_vert, data.hdop * 0.1, data.vdop * 0.1};
  return reading;
}

}  // namespace playerlike
