// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>

#include "libCCMorse/MorseSensor.h"

namespace CCMorse {

/// Detects nearby robots, and nearby obstacles if the world file enables them. Walls do not block
/// detection. A distance is measured from the centre of this robot's axle to that of the other
/// robot, or to the centre of an obstacle. Before the first reading nothing is near.
class MorseProximity : public MorseSensor {
 public:
  /// @param aName  name of the device; "" for the robot's first device of type "proximity".
  explicit MorseProximity(const MorseRobot& aRobot, const std::string& aName = "");
  ~MorseProximity() override;

  /// Returns the distances of all nearby objects by name [m]. If a robot and an obstacle have the
  /// same name, the result contains the nearer one.
  std::map<std::string, double> GetNearObjects() const;
  bool IsNear(const std::string& aName) const;
  /// Returns the distance of a nearby object [m].
  /// @throws MorseError kBadArgument if the object is not near; the text names the nearby ones.
  double GetDistance(const std::string& aName) const;
  double GetMaxRange() const;  ///< detection range [m]
};

}  // namespace CCMorse
