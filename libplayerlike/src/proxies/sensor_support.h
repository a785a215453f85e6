// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <ostream>
#include <vector>

#include "core/errors.h"
#include "libplayerc++/playerstructs.h"
#include "proxies/link.h"
#include "session/player_values/ranger.h"
#include "session/range_settings.h"
#include "sim/devices/rangers.h"

/// Shared helpers of the proxies of sensors with several elements.
namespace PlayerCc::detail {

/// Elements of sonars and infrared rings.
inline constexpr ElementWords kTransducers{"transducer", "transducers"};

/// The number of ranges in a reading.
inline uint32_t count_of_ranges(const sim::RangerReading& reading) {
  return static_cast<uint32_t>(reading.ranges_m.size());
}

/// As playerlike::element_poses().
/// @throws PlayerError kNotAvailable.
inline std::vector<player_pose3d_t> element_poses(const playerlike::DeviceSettings& settings) {
  return playerlike::translated(
      "", [&] { return playerlike::element_poses<player_pose3d_t>(settings); });
}

/// Prints a pose in the format of proxies: "x y yaw", separated by tabs.
inline void print_pose(std::ostream& os, const player_pose3d_t& pose) {
  os << pose.px << '\t' << pose.py << '\t' << pose.pyaw;
}

}  // namespace PlayerCc::detail
