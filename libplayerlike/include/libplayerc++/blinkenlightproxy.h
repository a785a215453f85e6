// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <iosfwd>

#include "libplayerc++/clientproxy.h"

namespace PlayerCc {

/// A light on a robot, for pictures (docs/devices/blinkenlight.md). Player 2 had such a class, with
/// GetEnable(), SetEnable() and SetPeriod(); the rest is as in its C library.
///
/// What is set holds from the next step on; what is told is the newest reading's, and 0, false or
/// black before the first.
class BlinkenLightProxy : public ClientProxy {
 public:
  /// @param aIndex  on a robot's own port the robot's devices of type "blinkenlight", counted from
  /// 0; on port
  ///                4000 the robot.
  /// @throws PlayerError kNoSuchDevice if there is no such device; the text names those there are.
  BlinkenLightProxy(PlayerClient* aPc, uint32_t aIndex = 0);
  ~BlinkenLightProxy() override;

  bool GetEnable() const;       ///< whether it is on, be it lit or dark at this moment
  double GetPeriod() const;     ///< of one on and off [s]; 0: it does not blink
  double GetDutyCycle() const;  ///< share of the period that it is lit, in [0, 1]
  uint8_t GetRed() const;
  uint8_t GetGreen() const;
  uint8_t GetBlue() const;
  bool IsLit() const;  ///< whether it was lit at the moment of the reading

  void SetEnable(bool aSet);
  /// @throws PlayerError kBadArgument for a period that is not in 0..1e6 s.
  void SetPeriod(double aPeriod);
  /// @throws PlayerError kBadArgument for a share that is not in 0..1.
  void SetDutyCycle(double aDutyCycle);
  void SetColor(uint8_t aRed, uint8_t aGreen, uint8_t aBlue);

 private:
  struct State {
    bool enabled = false;
    bool lit = false;
    double period = 0.0;
    double dutyCycle = 0.0;
    uint8_t red = 0;
    uint8_t green = 0;
    uint8_t blue = 0;
  };
};

}  // namespace PlayerCc

namespace std {
/// Prints how the light is set, and whether it is lit.
std::ostream& operator<<(std::ostream& os, const PlayerCc::BlinkenLightProxy& c);
}  // namespace std
