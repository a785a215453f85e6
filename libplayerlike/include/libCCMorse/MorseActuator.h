// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "libCCMorse/MorseDevice.h"

namespace CCMorse {

/// Base class of devices that act on their robot or on the world.
class MorseActuator : public MorseDevice {
 public:
  ~MorseActuator() override;

 protected:
  MorseActuator(const MorseRobot& aRobot, const std::string& aName, const char* aType,
                const char* aClass);
};

}  // namespace CCMorse
