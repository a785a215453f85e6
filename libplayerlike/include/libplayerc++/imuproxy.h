// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <iosfwd>

#include "libplayerc++/clientproxy.h"

namespace PlayerCc {

/// An inertial measurement unit. Its frame is the robot's body: x forward, y left, z up. All values
/// come from the newest reading; before the first reading they are 0.
class ImuProxy : public ClientProxy {
 public:
  /// @throws PlayerError kNoSuchDevice if the device does not exist; the text names those that do.
  ImuProxy(PlayerClient* aPc, uint32_t aIndex = 0);
  ~ImuProxy() override;

  /// Orientation, integrated from the measured turn rates; see ResetEuler(). The position is always
  /// 0.
  player_pose3d_t GetPose() const;
  float GetXAccel();  ///< specific force forward [m/s^2]
  float GetYAccel();  ///< to the left [m/s^2]
  float GetZAccel();  ///< upwards: g at rest [m/s^2]
  float GetXGyro();   ///< turn rate about x [rad/s]
  float GetYGyro();   ///< about y [rad/s]
  float GetZGyro();   ///< about z, counter-clockwise [rad/s]
  float GetXMagn();   ///< magnetic field forward [uT]
  float GetYMagn();   ///< to the left [uT]
  float GetZMagn();   ///< upwards [uT]
  /// The nine numbers above.
  player_imu_data_calib_t GetRawValues() const;

  /// Selects the type of message that the device sends. It changes nothing here, because the
  /// readings of this device contain all values.
  /// @param aDatatype  PLAYER_IMU_DATA_STATE, _CALIB, _QUAT, _EULER or _FULLSTATE.
  /// @throws PlayerError kBadArgument for any other value.
  void SetDatatype(int aDatatype);
  /// Sets the current orientation to zero, with ResetEuler().
  /// @param aValue  selects the part that a device resets; ignored here.
  void ResetOrientation(int aValue);
  /// Sets the current orientation to these angles [rad], from the next reading on. It changes the
  /// device, so all clients see it. Only the yaw is used; roll and pitch stay 0, because the robot
  /// is level.
  /// @throws PlayerError kBadArgument for angles that are not finite.
  void ResetEuler(float aRoll, float aPitch, float aYaw);
};

}  // namespace PlayerCc

namespace std {
/// Prints accelerations, turn rates, magnetic field and heading.
std::ostream& operator<<(std::ostream& os, const PlayerCc::ImuProxy& c);
}  // namespace std
