// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "libCCMorse/MorseInfrared.h"

namespace CCMorse {

/// A sonar array: each transducer reads the nearest that is in its cone, wherever in it.
class MorseSonar : public MorseRanger {
 public:
  /// @param aName  device; "": the robot's first of type "sonar".
  explicit MorseSonar(const MorseRobot& aRobot, const std::string& aName = "");
  ~MorseSonar() override;
};

}  // namespace CCMorse
