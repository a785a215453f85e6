// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <iosfwd>
#include <vector>

#include "libplayerc++/clientproxy.h"

namespace PlayerCc {

/// Analog inputs and outputs of a robot; docs/devices/aio.md lists the signals of the inputs.
class AioProxy : public ClientProxy {
 public:
  /// @param aIndex  on a robot's own port, index among its devices of type "aio";
  ///                on port 4000, the robot's number.
  /// @throws PlayerError kNoSuchDevice if the device does not exist; the text names those that do.
  AioProxy(PlayerClient* aPc, uint32_t aIndex = 0);
  ~AioProxy() override;

  /// Number of inputs; 0 before the first reading.
  uint32_t GetCount() const;
  /// Voltage at an input [V]. An input that does not exist reads 0; a warning says how many there
  /// are, once for each proxy.
  double GetVoltage(uint32_t aIndex) const;
  /// Sets an output, from the next step on.
  /// An output that does not exist is not set; a warning says so, once for each proxy.
  /// @param aVoltage  [V], at most 1e6 to either side.
  /// @throws PlayerError kBadArgument if no output can have that voltage.
  void SetVoltage(uint32_t aIndex, double aVoltage);
  /// Same as GetVoltage().
  double operator[](uint32_t aIndex) const { return GetVoltage(aIndex); }
};

}  // namespace PlayerCc

namespace std {
/// Prints the voltages at the inputs.
std::ostream& operator<<(std::ostream& os, const PlayerCc::AioProxy& c);
}  // namespace std
