// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "libCCMorse/MorseActuator.h"

namespace CCMorse {

/// The motors of the robot's drive, commanded by forward speed and turn rate.
class MorseMotionVW : public MorseActuator {
 public:
  /// @param aName  name of the device; "" for the robot's first device of type "motion".
  explicit MorseMotionVW(const MorseRobot& aRobot, const std::string& aName = "");
  ~MorseMotionVW() override;

  /// Sets the speed. It takes effect at the next step and holds until the next command. Values
  /// beyond the robot's limits are clamped.
  /// @param aSpeed     forward speed [m/s].
  /// @param aTurnRate  turn rate, counter-clockwise [rad/s].
  /// @throws MorseError kBadArgument for NaN or infinity.
  void SetSpeed(double aSpeed, double aTurnRate);
  /// Stops the robot; same as SetSpeed(0, 0).
  void Stop();
  /// Enables or disables the motors. Disabled motors stop the robot and ignore speed commands until
  /// they are enabled again.
  void SetMotorEnable(bool aEnable);

  double GetMaxSpeed() const;     ///< [m/s]
  double GetMaxTurnRate() const;  ///< [rad/s]
};

}  // namespace CCMorse
