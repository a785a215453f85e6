// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>

#include "libCCMorse/MorseSensor.h"

namespace CCMorse {

/// Which robots are near, and obstacles if the world asks for them; walls hide nobody. Distances go
/// from the middle of this robot's axle to that of the other, or to the middle of an obstacle.
/// Before the first reading nobody is near.
class MorseProximity : public MorseSensor {
 public:
  /// @param aName  device; "": the robot's first of type "proximity".
  explicit MorseProximity(const MorseRobot& aRobot, const std::string& aName = "");
  ~MorseProximity() override;

  /// Distances of all that are near, by name [m]. Should a robot and an obstacle have one name, the
  /// nearer one's.
  std::map<std::string, double> GetNearObjects() const;
  bool IsNear(const std::string& aName) const;
  /// Distance of one that is near [m]. @throws MorseError kBadArgument if it is not; the text names
  /// those that are.
  double GetDistance(const std::string& aName) const;
  double GetMaxRange() const;  ///< how far it sees [m]
};

}  // namespace CCMorse
