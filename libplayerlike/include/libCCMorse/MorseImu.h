// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string>

#include "libCCMorse/MorseSensor.h"

namespace CCMorse {

/// An inertial measurement unit. Its frame is the robot's body: x forward, y left, z up. All values
/// come from the newest reading; before the first reading they are 0.
class MorseImu : public MorseSensor {
 public:
  /// @param aName  name of the device; "" for the robot's first device of type "imu".
  explicit MorseImu(const MorseRobot& aRobot, const std::string& aName = "");
  ~MorseImu() override;

  std::array<double, 3> GetAngularVelocity() const;     ///< about x, y and z [rad/s]
  std::array<double, 3> GetLinearAcceleration() const;  ///< specific force; at rest z is g [m/s^2]
  std::array<double, 3> GetMagneticField() const;       ///< [uT]
  double GetYaw() const;  ///< heading, integrated from the measured rate, in (-pi, pi] [rad]
};

}  // namespace CCMorse
