// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "io/stage/draft.h"
#include "io/stage/entity.h"

namespace sim::io::stage {

inline constexpr int kDefaultPort = 6665;

/// An address as Player writes it: key:host:robot:interface:index, the first three of which may be
/// missing or empty.
struct Address {
  std::string key;  ///< what a driver uses it for, for example "input"
  int port = kDefaultPort;
  std::string interface;
  int index = 0;
  Place place;
  std::string text;  ///< as written
};

/// An address as a configuration file has it; nullopt if the text is none.
[[nodiscard]] std::optional<Address> parse_address(const Value& value);

/// The interface of Player and the model of Stage that offers it.
struct InterfaceRow {
  std::string_view interface;
  std::vector<std::string_view> stage_types;
  std::string_view device;  ///< type of device; "": any
};

/// The row of an interface; nullptr if models do not offer it.
[[nodiscard]] const InterfaceRow* row_of(std::string_view interface);
/// Whether a device may have an address of an interface.
[[nodiscard]] bool fits(const InterfaceRow& row, const DraftDevice& device);
/// Whether models offer an interface.
[[nodiscard]] bool is_offered(std::string_view interface);
/// Interfaces that every robot or world has. graphics3d is none here, but a note says so.
[[nodiscard]] bool is_everywhere(std::string_view interface);

using AddressKey = std::tuple<int, std::string, int>;
/// What tells addresses apart: port, interface and index.
[[nodiscard]] inline AddressKey key_of(const Address& address) {
  return {address.port, address.interface, address.index};
}

}  // namespace sim::io::stage
