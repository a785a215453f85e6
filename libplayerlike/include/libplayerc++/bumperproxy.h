// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <iosfwd>
#include <vector>

#include "libplayerc++/clientproxy.h"

namespace PlayerCc {

/// A bumper of several segments round the robot.
///
/// A segment counts as pressed if it was so at any time since the reading before. Before the first
/// reading there are 0 segments, and each reads 0; where they are is known from the start.
///
/// An element whose index is not below its count reads 0; after the first reading a warning on
/// standard error says so, once for each proxy.
class BumperProxy : public ClientProxy {
 public:
  /// @throws PlayerError kNoSuchDevice if there is no such device; the text names those there are.
  BumperProxy(PlayerClient* aPc, uint32_t aIndex = 0);
  ~BumperProxy() override;

  uint32_t GetCount() const;                 ///< segments of the newest reading
  uint32_t IsBumped(uint32_t aIndex) const;  ///< 1 if the segment is pressed, else 0
  bool IsAnyBumped();                        ///< whether any segment is pressed
  /// Asks for the places of the segments; known from the start.
  void RequestBumperConfig();
  uint32_t GetPoseCount() const;  ///< segments whose place is known
  /// Where a segment is: the pose of its middle in the robot's body, whose x axis looks outwards,
  /// its length and the radius of its arc [m]; 0: straight.
  player_bumper_define_t GetPose(uint32_t aIndex) const;
  /// IsBumped().
  bool operator[](uint32_t aIndex) const;

 private:
  std::vector<player_bumper_define_t> mPoses;
};

}  // namespace PlayerCc

namespace std {
/// Prints the segments, one a line: x, y, yaw, length, radius, whether it is pressed.
std::ostream& operator<<(std::ostream& os, const PlayerCc::BumperProxy& c);
}  // namespace std
