// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "libCCMorse/MorseSensor.h"

namespace CCMorse {

/// A satellite navigation receiver. All values come from the newest reading. They are 0 before the
/// first reading and without a fix.
class MorseGps : public MorseSensor {
 public:
  /// @param aName  name of the device; "" for the robot's first device of type "gps".
  explicit MorseGps(const MorseRobot& aRobot, const std::string& aName = "");
  ~MorseGps() override;

  double GetLatitude() const;   ///< north positive [degrees]
  double GetLongitude() const;  ///< east positive [degrees]
  double GetAltitude() const;   ///< above the ellipsoid [m]
  double GetVelocity() const;   ///< speed over ground [m/s]
  double GetHeading() const;    ///< course over ground, clockwise from north, in [0, 360) [degrees]
  bool HasFix() const;          ///< whether enough satellites are visible
};

}  // namespace CCMorse
