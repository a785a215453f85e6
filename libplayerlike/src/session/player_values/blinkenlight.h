// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "session/player_values/fields.h"
#include "sim/core/number_text.h"
#include "sim/devices/blinkenlight.h"
#include "sim/devices/device.h"

/// @file
/// Player's interface blinkenlight.
namespace playerlike {

template <typename Data, MaybeConst<sim::BlinkenlightReading> Light, typename Same>
void same_values(Data& data, Light& light, Same same) {
  same(data.enable, light.enabled);
  same(data.period, light.period_s);
  same(data.dutycycle, light.duty_cycle);
  same(data.color.alpha, light.colour.a);
  same(data.color.red, light.colour.r);
  same(data.color.green, light.colour.g);
  same(data.color.blue, light.colour.b);
}

/// Why a light cannot flash so; nothing if it can.
[[nodiscard]] inline std::optional<std::string> flashing_fault(const sim::LightCommand& command) {
  const double period_s = command.period_s.value_or(0.0);
  const double duty_cycle = command.duty_cycle.value_or(0.0);
  if (!(period_s >= 0.0 && period_s <= 1e6)) {
    return "a light's period is in 0..1e6 s, but is " + sim::rounded_text(period_s, 6);
  }
  if (!(duty_cycle >= 0.0 && duty_cycle <= 1.0)) {
    return "a light's duty cycle is in 0..1, but is " + sim::rounded_text(duty_cycle, 6);
  }
  return std::nullopt;
}

}  // namespace playerlike
