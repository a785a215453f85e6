// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "libCCMorse/MorseSensor.h"

namespace CCMorse {

/// Bumpers: what the robot has touched since the reading before, this moment included. A contact
/// that begins and ends between two readings is in the second one. Before the first reading nothing
/// is touched.
class MorseCollision : public MorseSensor {
 public:
  /// @param aName  device; "": the robot's first of type "collision".
  explicit MorseCollision(const MorseRobot& aRobot, const std::string& aName = "");
  ~MorseCollision() override;

  bool GetCollision() const;  ///< whether anything was touched
  /// Names of what was touched: of obstacles, dock separators and robots; "border" and "wall" (of a
  /// map). Sorted, each once.
  std::vector<std::string> GetObjects() const;
  bool Touches(const std::string& aName) const;  ///< whether that name is among GetObjects()
};

}  // namespace CCMorse
