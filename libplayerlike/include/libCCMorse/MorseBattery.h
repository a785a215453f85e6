// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "libCCMorse/MorseSensor.h"

namespace CCMorse {

/// The robot's battery. All values come from the newest reading. Before the first reading they are
/// 0 and the status is ""; only the capacity is already known.
class MorseBattery : public MorseSensor {
 public:
  /// @param aName  name of the device; "" for the robot's first device of type "battery".
  explicit MorseBattery(const MorseRobot& aRobot, const std::string& aName = "");
  ~MorseBattery() override;

  double GetCharge() const;    ///< charge in percent of the capacity, in [0, 100]
  double GetVoltage() const;   ///< [V]
  double GetEnergy() const;    ///< remaining energy [W h]
  double GetCapacity() const;  ///< energy of a full battery [W h]
  /// Returns MORSE's status: "Charging" in a dock, "Charged" when it is full in a dock, otherwise
  /// "Discharging".
  std::string GetStatus() const;
  bool IsDocked() const;  ///< whether the status is "Charging" or "Charged"
};

}  // namespace CCMorse
