// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "libCCMorse/MorseActuator.h"

namespace CCMorse {

/// The motors of a differential drive, commanded by forward speed and turn rate.
class MorseMotionVW : public MorseActuator {
 public:
  /// @param aName  device; "": the robot's first of type "motion".
  explicit MorseMotionVW(const MorseRobot& aRobot, const std::string& aName = "");
  ~MorseMotionVW() override;

  /// Drive so from the next step on, until the next command. Beyond the limits it is clamped.
  /// @param aSpeed     forward [m/s].
  /// @param aTurnRate  counter-clockwise [rad/s].
  /// @throws MorseError kBadArgument for NaN or infinity.
  void SetSpeed(double aSpeed, double aTurnRate);
  /// SetSpeed(0, 0).
  void Stop();
  /// Off stops the robot and lets speeds be ignored until on again.
  void SetMotorEnable(bool aEnable);

  double GetMaxSpeed() const;     ///< [m/s]
  double GetMaxTurnRate() const;  ///< [rad/s]
};

}  // namespace CCMorse
