// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "session/player_values/fields.h"
#include "sim/devices/imu.h"

/// @file
/// Player's interface imu.
namespace playerlike {

/// Acceleration, turning rate and magnetic field of an inertial unit.
template <typename Calibrated, MaybeConst<sim::ImuReading> Unit, typename Same>
void same_values(Calibrated& data, Unit& unit, Same same) {
  same(data.accel_x, unit.acceleration_mps2[0]);
  same(data.accel_y, unit.acceleration_mps2[1]);
  same(data.accel_z, unit.acceleration_mps2[2]);
  same(data.gyro_x, unit.rate_radps[0]);
  same(data.gyro_y, unit.rate_radps[1]);
  same(data.gyro_z, unit.rate_radps[2]);
  same(data.magn_x, unit.field_ut[0]);
  same(data.magn_y, unit.field_ut[1]);
  same(data.magn_z, unit.field_ut[2]);
}

}  // namespace playerlike
