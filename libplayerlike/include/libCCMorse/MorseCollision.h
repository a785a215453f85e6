// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "libCCMorse/MorseSensor.h"

namespace CCMorse {

/// Bumpers. A reading contains all contacts since the previous reading, including the current ones.
/// A contact that begins and ends between two readings is in the second reading. Before the first
/// reading there are no contacts.
class MorseCollision : public MorseSensor {
 public:
  /// @param aName  name of the device; "" for the robot's first device of type "collision".
  explicit MorseCollision(const MorseRobot& aRobot, const std::string& aName = "");
  ~MorseCollision() override;

  bool GetCollision() const;  ///< whether there was any contact
  /// Returns the names of the touched objects: obstacles, dock separators and robots; also "border"
  /// and "wall" (of a map). Sorted, without duplicates.
  std::vector<std::string> GetObjects() const;
  bool Touches(const std::string& aName) const;  ///< whether GetObjects() contains the name
};

}  // namespace CCMorse
