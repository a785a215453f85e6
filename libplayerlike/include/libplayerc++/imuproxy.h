// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <iosfwd>

#include "libplayerc++/clientproxy.h"

namespace PlayerCc {

/// An inertial measurement unit in the robot's body: x forward, y left, z up. All values are of the
/// newest reading; before the first they are 0.
class ImuProxy : public ClientProxy {
 public:
  /// @throws PlayerError kNoSuchDevice if there is no such device; the text names those there are.
  ImuProxy(PlayerClient* aPc, uint32_t aIndex = 0);
  ~ImuProxy() override;

  /// Orientation: the measured turning rates added up; see ResetEuler(). The position is always 0.
  player_pose3d_t GetPose() const;
  float GetXAccel();  ///< specific force ahead [m/s^2]
  float GetYAccel();  ///< to the left [m/s^2]
  float GetZAccel();  ///< upwards: g at rest [m/s^2]
  float GetXGyro();   ///< turning rate about x [rad/s]
  float GetYGyro();   ///< about y [rad/s]
  float GetZGyro();   ///< about z, counter-clockwise [rad/s]
  float GetXMagn();   ///< magnetic field ahead [uT]
  float GetYMagn();   ///< to the left [uT]
  float GetZMagn();   ///< upwards [uT]
  /// The nine numbers above.
  player_imu_data_calib_t GetRawValues() const;

  /// Chooses which message the device sends. This one's have it all, whichever is chosen.
  /// @param aDatatype  PLAYER_IMU_DATA_STATE, _CALIB, _QUAT, _EULER or _FULLSTATE.
  /// @throws PlayerError kBadArgument for any other.
  void SetDatatype(int aDatatype);
  /// The orientation counts from the present one on: ResetEuler() to zeros.
  /// @param aValue  which part of it a device resets; the simulated one turns about z only.
  void ResetOrientation(int aValue);
  /// The orientation is said to be this now [rad], from the next reading on and for all clients, as
  /// it is the device that is told. Of a robot that stands level, only the yaw: the others stay 0.
  /// @throws PlayerError kBadArgument for numbers that are not finite.
  void ResetEuler(float aRoll, float aPitch, float aYaw);
};

}  // namespace PlayerCc

namespace std {
/// Prints accelerations, turning rates, magnetic field and heading.
std::ostream& operator<<(std::ostream& os, const PlayerCc::ImuProxy& c);
}  // namespace std
