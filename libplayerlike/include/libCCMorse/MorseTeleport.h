// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "libCCMorse/MorseActuator.h"

namespace CCMorse {

/// Moves its robot to another place instantly; the robot is then at rest
/// (docs/devices/teleport.md).
///
/// Commands take effect at the next step. If the place is occupied, the command is rejected: a
/// warning names the obstacle, and the robot continues as before.
class MorseTeleport : public MorseActuator {
 public:
  /// @param aName  name of the device; "" for the robot's first device of type "teleport".
  explicit MorseTeleport(const MorseRobot& aRobot, const std::string& aName = "");
  ~MorseTeleport() override;

  /// @param aX, aY  position in the world [m].
  /// @param aYaw    heading, counter-clockwise [rad].
  /// @throws MorseError kBadArgument for NaN or infinity.
  void Place(double aX, double aY, double aYaw);
  /// Moves the robot by an offset along the world's axes [m]. The heading does not change.
  /// @throws MorseError kBadArgument for NaN or infinity.
  void Translate(double aX, double aY = 0.0);
  /// Turns the robot in place by an angle, counter-clockwise [rad].
  /// @throws MorseError kBadArgument for NaN or infinity.
  void Rotate(double aYaw);
};

}  // namespace CCMorse
