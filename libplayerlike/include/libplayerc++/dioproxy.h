// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <iosfwd>

#include "libplayerc++/clientproxy.h"

namespace PlayerCc {

/// Digital inputs and outputs of a robot; what stands at the inputs is told in docs/devices/dio.md.
class DioProxy : public ClientProxy {
 public:
  /// @param aIndex  on a robot's own port the robot's devices of type "dio", counted from 0; on
  /// port
  ///                4000 the robot.
  /// @throws PlayerError kNoSuchDevice if there is no such device; the text names those there are.
  DioProxy(PlayerClient* aPc, uint32_t aIndex = 0);
  ~DioProxy() override;

  /// How many inputs there are; 0 before the first reading.
  uint32_t GetCount() const;
  /// All inputs: input i is bit i.
  uint32_t GetDigin() const;
  /// One input. An input that does not exist reads false; a warning says how many there are, once
  /// for each proxy.
  bool GetInput(uint32_t aIndex) const;
  /// Sets the first outputs, from the next step on; the others stay as they are.
  /// @param aCount   how many; if there are fewer outputs, all of them are set, and a warning says
  ///                 so, once for each proxy.
  /// @param aDigout  output i gets bit i.
  void SetOutput(uint32_t aCount, uint32_t aDigout);
  /// As GetInput().
  uint32_t operator[](uint32_t aIndex) const { return GetInput(aIndex) ? 1 : 0; }

 private:
  // Guarded by the client's mutex.
};

}  // namespace PlayerCc

namespace std {
/// Prints the inputs, each as 0 or 1, the first one first.
std::ostream& operator<<(std::ostream& os, const PlayerCc::DioProxy& c);
}  // namespace std
