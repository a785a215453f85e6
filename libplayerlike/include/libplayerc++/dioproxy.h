// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <iosfwd>

#include "libplayerc++/clientproxy.h"

namespace PlayerCc {

/// Digital inputs and outputs of a robot; docs/devices/dio.md lists the signals of the inputs.
class DioProxy : public ClientProxy {
 public:
  /// @param aIndex  on a robot's own port, index among its devices of type "dio";
  ///                on port 4000, the robot's number.
  /// @throws PlayerError kNoSuchDevice if the device does not exist; the text names those that do.
  DioProxy(PlayerClient* aPc, uint32_t aIndex = 0);
  ~DioProxy() override;

  /// Number of inputs; 0 before the first reading.
  uint32_t GetCount() const;
  /// All inputs as a bit mask: bit i is input i.
  uint32_t GetDigin() const;
  /// One input. An input that does not exist reads false; a warning says how many there are, once
  /// for each proxy.
  bool GetInput(uint32_t aIndex) const;
  /// Sets the first outputs, from the next step on; the others stay as they are.
  /// @param aCount   how many; if there are fewer outputs, all of them are set, and a warning says
  ///                 so, once for each proxy.
  /// @param aDigout  output i gets bit i.
  void SetOutput(uint32_t aCount, uint32_t aDigout);
  /// GetInput() as 0 or 1.
  uint32_t operator[](uint32_t aIndex) const { return GetInput(aIndex) ? 1 : 0; }

 private:
  // Guarded by the client's mutex.
};

}  // namespace PlayerCc

namespace std {
/// Prints the inputs in ascending order, each as 0 or 1.
std::ostream& operator<<(std::ostream& os, const PlayerCc::DioProxy& c);
}  // namespace std
