// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "libCCMorse/MorseInfrared.h"

namespace CCMorse {

/// A sonar array. Each transducer measures the distance to the nearest object anywhere in its cone.
class MorseSonar : public MorseRanger {
 public:
  /// @param aName  name of the device; "" for the robot's first device of type "sonar".
  explicit MorseSonar(const MorseRobot& aRobot, const std::string& aName = "");
  ~MorseSonar() override;
};

}  // namespace CCMorse
