// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "libCCMorse/MorseSensor.h"
#include "libplayerc++/playerstructs.h"

namespace CCMorse {

/// Common base of MorsePose and MorseOdometry: pose and twist of the body frame B (origin at the
/// centre of the wheel axle; x forward, y left). All values come from the newest reading; before
/// the first reading they are 0.
class MorseLocalization : public MorseSensor {
 public:
  ~MorseLocalization() override;

  player_pose2d_t GetPose() const;  ///< position [m] and yaw in (-pi, pi] [rad]
  double GetX() const;              ///< [m]
  double GetY() const;              ///< [m]
  double GetYaw() const;            ///< heading, counter-clockwise [rad]
  double GetSpeed() const;          ///< actual forward speed [m/s]
  double GetLateralSpeed() const;   ///< actual speed to the left, e.g. if pushed [m/s]
  double GetTurnRate() const;       ///< actual turn rate, counter-clockwise [rad/s]
  bool GetStall() const;            ///< whether the commanded speed was not reached for 0.2 s

  /// From the next step on, reports this pose for the robot's current position. The robot does not
  /// move.
  /// @throws MorseError kBadArgument for NaN or infinity.
  void SetPose(double aX, double aY, double aYaw);

 protected:
  MorseLocalization(const MorseRobot& aRobot, const std::string& aName, const char* aType,
                    const char* aClass);
};

/// The arena's localisation: the pose of B in the world frame.
class MorsePose : public MorseLocalization {
 public:
  /// @param aName  name of the device; "" for the robot's first device of type "pose".
  explicit MorsePose(const MorseRobot& aRobot, const std::string& aName = "");
  ~MorsePose() override;
};

}  // namespace CCMorse
