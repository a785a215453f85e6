// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string>

#include "libCCMorse/MorseSensor.h"

namespace CCMorse {

/// An inertial measurement unit in the robot's body: x forward, y left, z up. All values are of the
/// newest reading; before the first they are 0.
class MorseImu : public MorseSensor {
 public:
  /// @param aName  device; "": the robot's first of type "imu".
  explicit MorseImu(const MorseRobot& aRobot, const std::string& aName = "");
  ~MorseImu() override;

  std::array<double, 3> GetAngularVelocity() const;     ///< about x, y and z [rad/s]
  std::array<double, 3> GetLinearAcceleration() const;  ///< at rest z is g [m/s^2]
  std::array<double, 3> GetMagneticField() const;       ///< [uT]
  double GetYaw() const;  ///< heading added up from the measured rate, (-pi, pi] [rad]
};

}  // namespace CCMorse
