// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "messages/player_interfaces.h"

#include "libplayerinterface/player_constants.h"

namespace playerlike {
namespace {

struct PlayerInterfaceRow {
  int code;
  const char* name;
};
constexpr PlayerInterfaceRow kPlayerInterfaces[] = {
#include "messages/interface_names.inc"  // generated from libplayerlike/player/interfaces.txt
};

}  // namespace

const char* player_interface_name(int code) noexcept {
  for (const PlayerInterfaceRow& row : kPlayerInterfaces) {
    if (row.code == code) return row.name;
  }
  return nullptr;
}

std::optional<int> player_interface_code(std::string_view name) noexcept {
  for (const PlayerInterfaceRow& row : kPlayerInterfaces) {
    if (name == row.name) return row.code;
  }
  return std::nullopt;
}

}  // namespace playerlike
