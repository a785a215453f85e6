// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "session/checks.h"

#include <algorithm>

#include "sim/core/error.h"

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

std::string unknown_name(const char* what, const std::string& name,
                         const std::vector<std::string>& known) {
  constexpr std::size_t kMostListed = 40;
  std::string text = "there is no ";
  text.append(what).append(" named \"").append(name).append("\"; ");
  if (known.empty()) return text.append("this world has none");
  if (const std::string near = sim::nearest_word(name, known); !near.empty()) {
    text.append("did you mean \"").append(near).append("\"? ");
  }
  text += "this world has: ";
  for (std::size_t i = 0; i < std::min(known.size(), kMostListed); ++i) {
    if (i > 0) text += ", ";
    text += known[i];
  }
  if (known.size() > kMostListed) {
    text.append(" and ").append(std::to_string(known.size() - kMostListed)).append(" more");
  }
  return text;
}

bool is_printable(std::string_view text) {
  return std::all_of(text.begin(), text.end(), [](char c) {
    const auto byte = static_cast<unsigned char>(c);
    return byte >= 0x20 && byte != 0x7f;
  });
}

void refuse_argument(const std::string& message) {
  throw SessionError(SessionError::Code::kBadArgument, message);
}

void require_done(const std::optional<std::string>& refusal) {
  if (refusal) refuse_argument(*refusal);
}

}  // namespace playerlike
