// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <charconv>
#include <optional>
#include <string>

#include "sim/devices/wire.h"

namespace sim {

/// "ROBOT.DEVICE.INDEX" or "DEVICE.INDEX"; nullopt for anything else.
[[nodiscard]] inline std::optional<Wire> parse_wire(const std::string& text) {
  const std::size_t last = text.rfind('.');
  if (last == std::string::npos || last == 0) return std::nullopt;
  const std::size_t first = text.find('.');
  Wire wire;
  if (first != last) wire.robot = text.substr(0, first);
  wire.device = first == last ? text.substr(0, last) : text.substr(first + 1, last - first - 1);
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data() + last + 1, end, wire.index);
  const bool whole = error == std::errc() && stop == end && wire.index >= 0;
  if (!whole || wire.device.empty() || first == 0 || wire.device.find('.') != std::string::npos) {
    return std::nullopt;
  }
  return wire;
}

}  // namespace sim
