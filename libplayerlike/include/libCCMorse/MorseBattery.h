// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "libCCMorse/MorseSensor.h"

namespace CCMorse {

/// The robot's battery. All values are of the newest reading; before the first they are 0, the
/// status is "", and only the capacity is known.
class MorseBattery : public MorseSensor {
 public:
  /// @param aName  device; "": the robot's first of type "battery".
  explicit MorseBattery(const MorseRobot& aRobot, const std::string& aName = "");
  ~MorseBattery() override;

  double GetCharge() const;    ///< percent of the capacity, in [0, 100]
  double GetVoltage() const;   ///< [V]
  double GetEnergy() const;    ///< what is left [W h]
  double GetCapacity() const;  ///< of a full battery [W h]
  /// As MORSE says it: "Charging" in a dock, "Charged" in a dock and full, else "Discharging".
  std::string GetStatus() const;
  bool IsDocked() const;  ///< "Charging" or "Charged"
};

}  // namespace CCMorse
