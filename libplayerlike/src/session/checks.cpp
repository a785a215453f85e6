// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "session/checks.h"

#include <algorithm>
#include <string>

namespace playerlike {

const DeviceInfo& require_device(const std::vector<RobotInfo>& robots, DeviceId device) {
  const auto robot = static_cast<std::size_t>(device.robot);
  if (robot < robots.size()) {
    const std::vector<DeviceInfo>& devices = robots[robot].devices;
    const auto number = static_cast<std::size_t>(device.device);
    if (number < devices.size() && devices[number].id == device) return devices[number];
    for (const DeviceInfo& info : devices) {
      if (info.id == device) return info;
    }
  }
  throw SessionError(SessionError::Code::kNoSuchDevice,
                     "the world has no device " + std::to_string(device.device) + " of robot " +
                         std::to_string(device.robot));
}

bool is_printable(std::string_view text) {
  return std::all_of(text.begin(), text.end(), [](char c) {
    const auto byte = static_cast<unsigned char>(c);
    return byte >= 0x20 && byte != 0x7f;
  });
}

}  // namespace playerlike
