// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <iosfwd>
#include <vector>

#include "libplayerc++/clientproxy.h"

namespace PlayerCc {

/// A ring of infrared rangers, single rays. One that meets nothing reads the ring's greatest
/// range. Before the first reading there are 0 ranges, and each reads 0; the places of the
/// transducers are known from the start.
///
/// An element whose index is not below its count reads 0; after the first reading a warning on
/// standard error says so, once for each proxy.
class IrProxy : public ClientProxy {
 public:
  /// @throws PlayerError kNoSuchDevice if there is no such device; the text names those there are.
  IrProxy(PlayerClient* aPc, uint32_t aIndex = 0);
  ~IrProxy() override;

  uint32_t GetCount() const;               ///< ranges of the newest reading
  double GetRange(uint32_t aIndex) const;  ///< [m]
  /// What the sensor would put out at that range [V]: gain / (range + shift), with the settings
  /// `voltage_gain` and `voltage_shift` of the world's device, by default those of a Sharp GP2D12.
  double GetVoltage(uint32_t aIndex) const;
  uint32_t GetPoseCount() const;  ///< transducers whose place is known
  /// Where a transducer is, in the robot's body; it looks along its x axis.
  player_pose3d_t GetPose(uint32_t aIndex) const;
  /// Asks for the places; known from the start.
  void RequestGeom();
  /// GetRange().
  double operator[](uint32_t aIndex) const;

 private:
  std::vector<player_pose3d_t> mPoses;
};

}  // namespace PlayerCc

namespace std {
/// Prints the transducers, one a line: x, y, yaw, range, voltage.
std::ostream& operator<<(std::ostream& os, const PlayerCc::IrProxy& c);
}  // namespace std
