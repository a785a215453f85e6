// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "libplayerinterface/player_constants.h"
#include "sim/devices/battery.h"

/// @file
/// Player's interface power.
namespace playerlike {

inline constexpr double kJoulesPerWattHour = 3600.0;

/// The state of a battery.
template <typename Data>
[[nodiscard]] Data power_data(const sim::BatteryReading& battery) {
  Data data = {};
  data.valid = PLAYER_POWER_MASK_VOLTS | PLAYER_POWER_MASK_WATTS | PLAYER_POWER_MASK_JOULES |
               PLAYER_POWER_MASK_PERCENT | PLAYER_POWER_MASK_CHARGING;
  data.volts = static_cast<float>(battery.voltage_v);
  data.percent = static_cast<float>(battery.charge_percent);
  data.joules = static_cast<float>(battery.energy_wh * kJoulesPerWattHour);
  data.watts = static_cast<float>(battery.power_w);
  data.charging = battery.status == sim::BatteryStatus::kCharging ? 1 : 0;
  return data;
}
template <typename Data>
[[nodiscard]] sim::BatteryReading battery_reading(const Data& data) {
  sim::BatteryReading reading;
  reading.voltage_v = double{data.volts};
  reading.charge_percent = double{data.percent};
  reading.energy_wh = double{data.joules} / kJoulesPerWattHour;
  reading.power_w = double{data.watts};
  reading.status =
      data.charging > 0 ? sim::BatteryStatus::kCharging : sim::BatteryStatus::kDischarging;
  return reading;
}

}  // namespace playerlike
