// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <iosfwd>
#include <vector>

#include "libplayerc++/clientproxy.h"

namespace PlayerCc {

/// A bumper with several segments around the robot.
///
/// A segment counts as pressed if it was pressed at any time since the previous reading. Before the
/// first reading there are 0 segments, and each of them reads 0. The geometry is known from the
/// start.
///
/// An element whose index is not below its count reads 0; after the first reading a warning on
/// standard error says so, once for each proxy.
class BumperProxy : public ClientProxy {
 public:
  /// @throws PlayerError kNoSuchDevice if the device does not exist; the text names those that do.
  BumperProxy(PlayerClient* aPc, uint32_t aIndex = 0);
  ~BumperProxy() override;

  uint32_t GetCount() const;                 ///< number of segments in the newest reading
  uint32_t IsBumped(uint32_t aIndex) const;  ///< 1 if the segment is pressed, otherwise 0
  bool IsAnyBumped();                        ///< whether any segment is pressed
  /// Requests the geometry of the segments. It is known from the start, so nothing changes.
  void RequestBumperConfig();
  uint32_t GetPoseCount() const;  ///< number of segments with known geometry
  /// Geometry of a segment: the pose of its centre in the robot's body frame (its x axis points
  /// outwards), its length [m] and the radius of its arc [m]; radius 0 is a straight segment.
  player_bumper_define_t GetPose(uint32_t aIndex) const;
  /// Same as IsBumped().
  bool operator[](uint32_t aIndex) const;

 private:
  std::vector<player_bumper_define_t> mPoses;
};

}  // namespace PlayerCc

namespace std {
/// Prints the segments, one per line: x, y, yaw, length, radius, whether it is pressed.
std::ostream& operator<<(std::ostream& os, const PlayerCc::BumperProxy& c);
}  // namespace std
