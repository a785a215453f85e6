// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "libplayerinterface/player_constants.h"
#include "session/player_values/fields.h"
#include "sim/devices/battery.h"

/// @file
/// Player's interface power.
namespace playerlike {

inline constexpr double kJoulesPerWattHour = 3600.0;

/// The state of a battery.
template <typename Data, MaybeConst<sim::BatteryReading> Battery, typename Same>
void same_values(Data& data, Battery& battery, Same same) {
  using sim::BatteryStatus;
  same(data.volts, battery.voltage_v);
  same(data.percent, battery.charge_percent);
  same.converted(
      data.joules, battery.energy_wh, [](double wh) { return wh * kJoulesPerWattHour; },
      [](float joules) { return double{joules} / kJoulesPerWattHour; });
  same(data.watts, battery.power_w);
  same.converted(
      data.charging, battery.status,
      [](BatteryStatus status) { return status == BatteryStatus::kCharging ? 1 : 0; },
      [](int code) { return code > 0 ? BatteryStatus::kCharging : BatteryStatus::kDischarging; });
}

/// The fields of PowerData that hold values.
inline constexpr std::uint32_t kPowerFields = PLAYER_POWER_MASK_VOLTS | PLAYER_POWER_MASK_WATTS |
                                              PLAYER_POWER_MASK_JOULES | PLAYER_POWER_MASK_PERCENT |
                                              PLAYER_POWER_MASK_CHARGING;

}  // namespace playerlike
