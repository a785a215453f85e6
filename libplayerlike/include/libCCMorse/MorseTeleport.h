// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "libCCMorse/MorseActuator.h"

namespace CCMorse {

/// Puts its robot somewhere else at once, at rest (docs/devices/teleport.md).
///
/// Orders are executed from the next step on. A place that is taken is refused: a warning says
/// by what, and the robot goes on as before.
class MorseTeleport : public MorseActuator {
 public:
  /// @param aName  device; "": the robot's first of type "teleport".
  explicit MorseTeleport(const MorseRobot& aRobot, const std::string& aName = "");
  ~MorseTeleport() override;

  /// @param aX, aY  place in the world [m].
  /// @param aYaw    heading, counter-clockwise [rad].
  /// @throws MorseError kBadArgument for NaN or infinity.
  void Place(double aX, double aY, double aYaw);
  /// From where the robot is, along the world's axes, heading unchanged [m].
  /// @throws MorseError kBadArgument for NaN or infinity.
  void Translate(double aX, double aY = 0.0);
  /// Where it stands, counter-clockwise [rad].
  /// @throws MorseError kBadArgument for NaN or infinity.
  void Rotate(double aYaw);
};

}  // namespace CCMorse
