// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <string_view>

#include "playerlike/messages/messages.h"
#include "sim/devices/device.h"

namespace playerlike {

/// Turns a Player server's data into readings, one object per device. It remembers the device's
/// last values, since some interfaces send a device's values in several messages.
class PlayerReadings {
 public:
  /// @param interface  code of the device's interface.
  explicit PlayerReadings(unsigned interface) : interface_(interface) {}

  /// @param device  the device; its properties tell what the data do not contain.
  /// @param time_s  timestamp of the message. A time that is not a finite number in [0, 9e9] counts
  ///                as the time of the last reading.
  /// @return the reading; null if the message has no values that readings contain.
  /// @throws protocol::ProtocolError if the payload cannot be understood.
  [[nodiscard]] sim::SharedReading convert(std::uint8_t subtype, double time_s,
                                           std::string_view payload, const DeviceInfo& device);

  /// Time of the last message.
  [[nodiscard]] sim::SimTime time_ns() const noexcept { return time_ns_; }

 private:
  unsigned interface_;
  std::uint64_t sequence_ = 0;
  sim::SimTime time_ns_ = 0;
  sim::SharedReading last_;
};

}  // namespace playerlike
