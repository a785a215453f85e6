// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "libCCMorse/MorsePose.h"

namespace CCMorse {

/// Wheel odometry: the pose of B in the frame where B was at the start, or when last reset.
class MorseOdometry : public MorseLocalization {
 public:
  /// @param aName  device; "": the robot's first of type "odometry".
  explicit MorseOdometry(const MorseRobot& aRobot, const std::string& aName = "");
  ~MorseOdometry() override;

  /// Starts anew: SetPose(0, 0, 0).
  void Reset() { SetPose(0.0, 0.0, 0.0); }
};

}  // namespace CCMorse
