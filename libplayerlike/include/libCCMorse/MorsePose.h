// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "libCCMorse/MorseSensor.h"
#include "libplayerc++/playerstructs.h"

namespace CCMorse {

/// What MorsePose and MorseOdometry have in common: where the body B is (the middle of the wheels'
/// axle; x forward, y left) and how it moves. All values are of the newest reading, 0 before the
/// first.
class MorseLocalization : public MorseSensor {
 public:
  ~MorseLocalization() override;

  player_pose2d_t GetPose() const;  ///< position [m] and yaw [rad], in (-pi, pi]
  double GetX() const;              ///< [m]
  double GetY() const;              ///< [m]
  double GetYaw() const;            ///< [rad], counter-clockwise
  double GetSpeed() const;          ///< achieved forward speed [m/s]
  double GetLateralSpeed() const;   ///< achieved speed to the left, as when shoved [m/s]
  double GetTurnRate() const;       ///< achieved, counter-clockwise [rad/s]
  bool GetStall() const;            ///< the commanded speed has not been achieved for 0.2 s

  /// Makes it report this pose for where the robot is now, from the next step on; the robot does
  /// not move. @throws MorseError kBadArgument for NaN or infinity.
  void SetPose(double aX, double aY, double aYaw);

 protected:
  MorseLocalization(const MorseRobot& aRobot, const std::string& aName, const char* aType,
                    const char* aClass);
};

/// The arena's localisation: the pose of B in the world.
class MorsePose : public MorseLocalization {
 public:
  /// @param aName  device; "": the robot's first of type "pose".
  explicit MorsePose(const MorseRobot& aRobot, const std::string& aName = "");
  ~MorsePose() override;
};

}  // namespace CCMorse
