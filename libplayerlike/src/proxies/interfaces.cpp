// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <string>

#include "proxies/link.h"

namespace PlayerCc {
namespace {

struct InterfaceRow {
  int code;
  const char* name;
};
constexpr InterfaceRow kInterfaceNames[] = {
#include "proxies/interface_names.inc"  // made from libplayerlike/player/interfaces.txt
};

}  // namespace

const char* interface_name(int code) noexcept {
  for (const InterfaceRow& row : kInterfaceNames) {
    if (row.code == code) return row.name;
  }
  return nullptr;
}

std::optional<int> interface_code(const std::string& name) noexcept {
  for (const InterfaceRow& row : kInterfaceNames) {
    if (name == row.name) return row.code;
  }
  return std::nullopt;
}

}  // namespace PlayerCc
