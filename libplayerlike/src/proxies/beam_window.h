// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/errors.h"
#include "libplayerc++/playerstructs.h"
#include "proxies/sensor_support.h"
#include "session/range_settings.h"
#include "sim/devices/laser.h"

namespace PlayerCc::detail {

using playerlike::announced_scan;
using playerlike::BeamWindow;
using playerlike::bearing_rad;
using playerlike::kRangeResolution_m;
using playerlike::part_of;
using playerlike::ScannerSettings;
using playerlike::to_players;

/// As playerlike::scanner_settings(). @throws PlayerError kNotAvailable.
inline ScannerSettings scanner_settings(const playerlike::DeviceSettings& settings) {
  return playerlike::translated("", [&] { return playerlike::scanner_settings(settings); });
}

/// As playerlike::window_of(). @throws PlayerError kBadArgument in the name of `fun`.
inline BeamWindow window_of(const char* fun, double min_rad, double max_rad, double resolution_rad,
                            std::size_t count, double least_rad, double native_rad) {
  return playerlike::translated(fun, [&] {
    return playerlike::window_of(min_rad, max_rad, resolution_rad, count, least_rad, native_rad);
  });
}

}  // namespace PlayerCc::detail
