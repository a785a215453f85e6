// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "sim/core/fields.h"
#include "sim/devices/builtin.h"
#include "sim/devices/device.h"

namespace playerlike::protocol {

/// A key of a device's readings whose numbers a client gets in an array: see `select` in
/// docs/protocol.md.
///
/// The key's value is a number, a whole number, true or false (1 or 0), or a list of doubles. A
/// reading that is a pose has the keys "x", "y" and "yaw". Immutable; any thread may use it.
class NumberPick {
 public:
  /// @param type  of the device, e.g. "laser".
  /// @param key   of the device's readings, e.g. "ranges".
  /// @throws ProtocolError protocol/bad-value if the device makes no readings, or if they have no
  ///         such key, or if its value is of another type or may be missing.
  NumberPick(std::string_view type, const std::string& key);

  /// Appends the numbers of a reading, in SI units and radians. @pre it is one of the type.
  void append(const sim::Reading& reading, std::vector<double>& numbers) const;
  /// How many numbers append() appends. @pre as append().
  [[nodiscard]] std::size_t count(const sim::Reading& reading) const;

 private:
  /// The value of the field in a reading.
  [[nodiscard]] const void* value_in(const sim::Reading& reading) const;

  const sim::ReadingKind& kind_;
  std::vector<const sim::Field*> path_;  ///< of included tables, then the field itself
  int part_ = 0;                         ///< of a pose: 0 x, 1 y, 2 yaw
};

}  // namespace playerlike::protocol
