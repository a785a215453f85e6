// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <iosfwd>
#include <vector>

#include "libplayerc++/clientproxy.h"

namespace PlayerCc {

/// A ring of infrared rangers. Each of them measures along a single ray and reads the ring's
/// maximum range if it detects nothing. Before the first reading there are 0 ranges, and each of
/// them reads 0. The poses of the transducers are known from the start.
///
/// An element whose index is not below its count reads 0; after the first reading a warning on
/// standard error says so, once for each proxy.
class IrProxy : public ClientProxy {
 public:
  /// @throws PlayerError kNoSuchDevice if the device does not exist; the text names those that do.
  IrProxy(PlayerClient* aPc, uint32_t aIndex = 0);
  ~IrProxy() override;

  uint32_t GetCount() const;               ///< number of ranges in the newest reading
  double GetRange(uint32_t aIndex) const;  ///< [m]
  /// Output voltage of the sensor at the measured range [V]: gain / (range + shift). The settings
  /// `voltage_gain` and `voltage_shift` of the device in the world file give gain and shift; the
  /// defaults model a Sharp GP2D12. With a Player server it is the voltage that the server sends.
  double GetVoltage(uint32_t aIndex) const;
  uint32_t GetPoseCount() const;  ///< number of transducers with known pose
  /// Pose of a transducer in the robot's body frame; the ray is its x axis.
  player_pose3d_t GetPose(uint32_t aIndex) const;
  /// Requests the poses. They are known from the start, so nothing changes.
  void RequestGeom();
  /// Same as GetRange().
  double operator[](uint32_t aIndex) const;

 private:
  std::vector<player_pose3d_t> mPoses;
};

}  // namespace PlayerCc

namespace std {
/// Prints the transducers, one per line: x, y, yaw, range, voltage.
std::ostream& operator<<(std::ostream& os, const PlayerCc::IrProxy& c);
}  // namespace std
