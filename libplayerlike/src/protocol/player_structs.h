// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "libplayerinterface/player_constants.h"

/// Messages of Player's protocol (docs/player_wire.md). The server and the client of this protocol
/// share them.
///
/// The structs are made from libplayerlike/player/interfaces.txt, as the C structs of
/// libplayerinterface/player_structs.h are, with the same fields and units: LaserData stands for
/// player_laser_data_t. Arrays are vectors here, so that there are no fields X_count. An array of
/// char is a string with the bytes of the message; texts end with a zero byte there, see
/// text_bytes().
///
/// visit_fields() passes a struct's fields in the order of the messages to a visitor with the
/// members value(name, field), count(name, array) for the number of an array's elements, and
/// elements(name, array, limit) for the elements.
namespace playerlike::player {

/// Length of arrays without a limit of their own.
inline constexpr std::size_t kUnlimited = std::numeric_limits<std::size_t>::max();

/// The payload of messages without fields.
struct Empty {
  template <typename Self, typename Visitor>
  static void visit_fields(Self& /*self*/, Visitor& /*visit*/) {}
};

#include "protocol/player_structs.inc"

/// The bytes of a text in messages: with a zero byte at the end.
[[nodiscard]] inline std::string text_bytes(std::string_view text) {
  std::string bytes(text);
  bytes.push_back('\0');
  return bytes;
}

/// The text up to the first zero byte, or the whole without one.
[[nodiscard]] inline std::string text_of(std::string_view bytes) {
  return std::string(bytes.substr(0, bytes.find('\0')));
}

}  // namespace playerlike::player
