// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "io/stage/player_address.h"

#include <algorithm>
#include <charconv>
#include <iterator>

namespace sim::io::stage {
namespace {

std::optional<int> whole_number(std::string_view text, int most) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || value < 0 || value > most) {
    return std::nullopt;
  }
  return value;
}

const std::vector<InterfaceRow>& interface_rows() {
  static const std::vector<InterfaceRow> kRows = {
      {"ranger", {"ranger", "laser"}, ""},
      {"laser", {"ranger", "laser"}, "laser"},
      {"sonar", {"ranger"}, "sonar"},
      {"fiducial", {"fiducial"}, ""},
      {"blobfinder", {"blobfinder"}, ""},
      {"bumper", {"bumper"}, ""},
      {"gripper", {"gripper"}, ""},
      {"camera", {"camera"}, ""},
      {"ptz", {"ptz"}, ""},
      {"wifi", {"wifi"}, ""},
      {"power", {"power"}, ""},
      {"actarray", {"actuator"}, ""},
      {"blinkenlight", {"blinkenlight", "lightindicator"}, ""},
  };
  return kRows;
}

}  // namespace

std::optional<Address> parse_address(const Value& value) {
  std::vector<std::string_view> parts;
  std::string_view rest = value.text;
  while (rest.ends_with(' ')) rest.remove_suffix(1);  // as Player, which reads numbers by atoi()
  for (;;) {
    const std::size_t colon = rest.find(':');
    parts.push_back(rest.substr(0, colon));
    if (colon == std::string_view::npos) break;
    rest.remove_prefix(colon + 1);
  }
  if (parts.size() < 2 || parts.size() > 5) return std::nullopt;
  Address address;
  address.place = value.place;
  address.text = value.text;
  const std::optional<int> index = whole_number(parts.back(), 1000);
  address.interface = std::string(parts[parts.size() - 2]);
  if (address.interface == "position") address.interface = "position2d";  // as in Player 1
  if (parts.size() >= 4) address.key = std::string(parts.front());
  if (!index || address.interface.empty()) return std::nullopt;
  address.index = *index;
  if (parts.size() >= 3 && !parts[parts.size() - 3].empty()) {
    const std::optional<int> port = whole_number(parts[parts.size() - 3], 65535);
    if (!port) return std::nullopt;
    address.port = *port;
  }
  return address;
}

const InterfaceRow* row_of(std::string_view interface) {
  for (const InterfaceRow& row : interface_rows()) {
    if (row.interface == interface) return &row;
  }
  return nullptr;
}

bool fits(const InterfaceRow& row, const DraftDevice& device) {
  return std::find(row.stage_types.begin(), row.stage_types.end(), device.stage_type) !=
             row.stage_types.end() &&
         (row.device.empty() || row.device == device.type);
}

bool is_offered(std::string_view interface) {
  return interface == "position2d" || row_of(interface) != nullptr;
}

bool is_everywhere(std::string_view interface) {
  constexpr std::string_view kNames[] = {"simulation", "speech", "graphics2d", "graphics3d", "map"};
  return std::find(std::begin(kNames), std::end(kNames), interface) != std::end(kNames);
}

}  // namespace sim::io::stage
