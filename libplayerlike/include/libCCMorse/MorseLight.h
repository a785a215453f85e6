// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "libCCMorse/MorseActuator.h"

namespace CCMorse {

/// A light on the robot, for pictures (docs/devices/blinkenlight.md). Orders are executed from
/// the next step on.
class MorseLight : public MorseActuator {
 public:
  /// @param aName  device; "": the robot's first of type "blinkenlight".
  explicit MorseLight(const MorseRobot& aRobot, const std::string& aName = "");
  ~MorseLight() override;

  /// Switches it on or off.
  void SetOn(bool aOn);
  /// @param aPeriod     of one on and off [s], in 0..1e6; 0: it does not blink.
  /// @param aDutyCycle  share of the period that it is lit, in 0..1.
  /// @throws MorseError kBadArgument for other numbers.
  void SetBlinking(double aPeriod, double aDutyCycle = 0.5);
  void SetColour(std::uint8_t aRed, std::uint8_t aGreen, std::uint8_t aBlue);
};

}  // namespace CCMorse
