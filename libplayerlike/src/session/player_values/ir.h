// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "session/range_settings.h"
#include "sim/devices/rangers.h"

/// @file
/// Player's interface ir.
namespace playerlike {

/// The voltage of an element: as measured, or that of its range.
[[nodiscard]] inline double voltage_v(const sim::RangerReading& ring, std::size_t element,
                                      const DeviceSettings& settings) {
  if (element < ring.voltages_v.size()) return ring.voltages_v[element];
  return sim::infrared_voltage_v(ring.ranges_m[element], setting_of(settings, "voltage_gain"),
                                 setting_of(settings, "voltage_shift"));
}

}  // namespace playerlike
