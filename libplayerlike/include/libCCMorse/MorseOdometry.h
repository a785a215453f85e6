// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "libCCMorse/MorsePose.h"

namespace CCMorse {

/// Wheel odometry: the pose of the body frame B relative to its pose at the start or at the last
/// reset.
class MorseOdometry : public MorseLocalization {
 public:
  /// @param aName  name of the device; "" for the robot's first device of type "odometry".
  explicit MorseOdometry(const MorseRobot& aRobot, const std::string& aName = "");
  ~MorseOdometry() override;

  /// Resets the odometry; same as SetPose(0, 0, 0).
  void Reset() { SetPose(0.0, 0.0, 0.0); }
};

}  // namespace CCMorse
