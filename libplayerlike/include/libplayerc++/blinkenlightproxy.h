// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <iosfwd>

#include "libplayerc++/clientproxy.h"

namespace PlayerCc {

/// A light on a robot, visible in pictures (docs/devices/blinkenlight.md). GetEnable(), SetEnable()
/// and SetPeriod() come from Player 2's class of this name; the other members follow its C library.
///
/// Settings take effect at the next step. Getters return values of the newest reading; before the
/// first reading they return 0, false or black.
class BlinkenLightProxy : public ClientProxy {
 public:
  /// @param aIndex  on a robot's own port, index among its devices of type "blinkenlight";
  ///                on port 4000, the robot's number.
  /// @throws PlayerError kNoSuchDevice if the device does not exist; the text names those that do.
  BlinkenLightProxy(PlayerClient* aPc, uint32_t aIndex = 0);
  ~BlinkenLightProxy() override;

  bool GetEnable() const;       ///< whether the light is on, even if a blinking light is dark now
  double GetPeriod() const;     ///< length of a blink cycle [s]; 0: no blinking
  double GetDutyCycle() const;  ///< lit fraction of the period, in [0, 1]
  uint8_t GetRed() const;
  uint8_t GetGreen() const;
  uint8_t GetBlue() const;
  bool IsLit() const;  ///< whether the light was lit at the time of the reading

  void SetEnable(bool aSet);
  /// @throws PlayerError kBadArgument for a period outside 0..1e6 s.
  void SetPeriod(double aPeriod);
  /// @throws PlayerError kBadArgument for a fraction outside 0..1.
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
/// Prints the settings of the light and whether it is lit.
std::ostream& operator<<(std::ostream& os, const PlayerCc::BlinkenLightProxy& c);
}  // namespace std
