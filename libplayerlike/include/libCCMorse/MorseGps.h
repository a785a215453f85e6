// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "libCCMorse/MorseSensor.h"

namespace CCMorse {

/// A satellite receiver. All values are of the newest reading; before the first, and without a fix,
/// they are 0.
class MorseGps : public MorseSensor {
 public:
  /// @param aName  device; "": the robot's first of type "gps".
  explicit MorseGps(const MorseRobot& aRobot, const std::string& aName = "");
  ~MorseGps() override;

  double GetLatitude() const;   ///< north positive [degrees]
  double GetLongitude() const;  ///< east positive [degrees]
  double GetAltitude() const;   ///< over the ellipsoid [m]
  double GetVelocity() const;   ///< over ground [m/s]
  double GetHeading() const;    ///< of motion, clockwise from north, [0, 360) [degrees]
  bool HasFix() const;          ///< whether there are enough satellites
};

}  // namespace CCMorse
