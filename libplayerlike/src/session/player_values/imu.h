// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sim/devices/imu.h"

/// @file
/// Player's interface imu.
namespace playerlike {

/// Acceleration, turning rate and magnetic field of an inertial unit.
template <typename Calibrated>
[[nodiscard]] Calibrated imu_values(const sim::ImuReading& reading) {
  const auto& a = reading.acceleration_mps2;
  const auto& w = reading.rate_radps;
  const auto& b = reading.field_ut;
  return {static_cast<float>(a[0]), static_cast<float>(a[1]), static_cast<float>(a[2]),
          static_cast<float>(w[0]), static_cast<float>(w[1]), static_cast<float>(w[2]),
          static_cast<float>(b[0]), static_cast<float>(b[1]), static_cast<float>(b[2])};
}
template <typename Calibrated>
void set_imu_values(const Calibrated& data, sim::ImuReading& reading) {
  reading.acceleration_mps2 = {double{data.accel_x}, double{data.accel_y}, double{data.accel_z}};
  reading.rate_radps = {double{data.gyro_x}, double{data.gyro_y}, double{data.gyro_z}};
  reading.field_ut = {double{data.magn_x}, double{data.magn_y}, double{data.magn_z}};
}

}  // namespace playerlike
