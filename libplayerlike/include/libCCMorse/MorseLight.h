// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "libCCMorse/MorseActuator.h"

namespace CCMorse {

/// A light on the robot, visible in pictures (docs/devices/blinkenlight.md). Commands take effect
/// at the next step.
class MorseLight : public MorseActuator {
 public:
  /// @param aName  name of the device; "" for the robot's first device of type "blinkenlight".
  explicit MorseLight(const MorseRobot& aRobot, const std::string& aName = "");
  ~MorseLight() override;

  /// Switches the light on or off.
  void SetOn(bool aOn);
  /// @param aPeriod     length of one blink cycle [s], in 0..1e6; 0 for no blinking.
  /// @param aDutyCycle  fraction of the period during which the light is on, in 0..1.
  /// @throws MorseError kBadArgument for a value outside these ranges.
  void SetBlinking(double aPeriod, double aDutyCycle = 0.5);
  void SetColour(std::uint8_t aRed, std::uint8_t aGreen, std::uint8_t aBlue);
};

}  // namespace CCMorse
