// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <ostream>
#include <string>
#include <vector>

#include "libplayerc++/playererror.h"
#include "libplayerc++/playerstructs.h"
#include "proxies/link.h"
#include "sim/devices/rangers.h"

/// Shared helpers of the proxies of sensors with several elements.
namespace PlayerCc::detail {

/// Elements of sonars and infrared rings.
inline constexpr ElementWords kTransducers{"transducer", "transducers"};

/// The number of ranges in a reading.
inline uint32_t count_of_ranges(const sim::RangerReading& reading) {
  return static_cast<uint32_t>(reading.ranges_m.size());
}

/// A property of a device; 0 if it has none of that name.
inline double setting_of(const std::map<std::string, double>& settings, const std::string& name) {
  const auto it = settings.find(name);
  return it == settings.end() ? 0.0 : it->second;
}

/// A property of a device that is a count; 0 if it has none of that name. @throws PlayerError
/// kNotAvailable unless it is a whole number up to kMostElements, since servers may send anything.
inline constexpr std::size_t kMostElements = std::size_t{1} << 20U;
inline std::size_t count_of(const std::map<std::string, double>& settings,
                            const std::string& name) {
  const double count = setting_of(settings, name);
  if (count >= 0.0 && count <= static_cast<double>(kMostElements) && count == std::floor(count)) {
    return static_cast<std::size_t>(count);
  }
  throw PlayerError("",
                    "the server says that a device has " + std::to_string(count) + " of its \"" +
                        name + "\"; expected a whole number from 0 to " +
                        std::to_string(kMostElements),
                    PlayerError::kNotAvailable);
}

/// Poses on the body of a device's elements, from its properties count, mount_x_0, mount_y_0,
/// mount_yaw_0, ... and height.
inline std::vector<player_pose3d_t> element_poses(const std::map<std::string, double>& settings) {
  const auto setting = [&](const std::string& name) { return setting_of(settings, name); };
  std::vector<player_pose3d_t> poses(count_of(settings, "count"));
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const std::string number = std::to_string(i);
    poses[i] = {
        setting("mount_x_" + number),  setting("mount_y_" + number), setting("height"), 0.0, 0.0,
        setting("mount_yaw_" + number)};
  }
  return poses;
}

/// Prints a pose in the format of proxies: "x y yaw", separated by tabs.
inline void print_pose(std::ostream& os, const player_pose3d_t& pose) {
  os << pose.px << '\t' << pose.py << '\t' << pose.pyaw;
}

}  // namespace PlayerCc::detail
