// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <iosfwd>
#include <vector>

#include "libplayerc++/clientproxy.h"

namespace PlayerCc {

/// An array of sonar transducers. Each of them measures the distance to the nearest object in its
/// cone, and reads the array's maximum range if it detects nothing. Before the first reading there
/// are 0 ranges; the poses of the transducers are known from the start.
class SonarProxy : public ClientProxy {
 public:
  /// @throws PlayerError kNoSuchDevice if the device does not exist; the text names those that do.
  SonarProxy(PlayerClient* aPc, uint32_t aIndex = 0);
  ~SonarProxy() override;

  uint32_t GetCount() const;  ///< ranges of the newest reading
  /// A range [m]; -1 for an index that is not below GetCount(), as in Player. After the first
  /// reading a warning on standard error says so, once for each proxy.
  double GetScan(uint32_t aIndex) const;
  /// Same as GetScan().
  double operator[](uint32_t aIndex) const;
  uint32_t GetPoseCount() const;  ///< number of transducers with known pose
  /// Where a transducer is, in the robot's body; it looks along its x axis.
  /// Zeros for an index that is not below GetPoseCount(); see GetScan().
  player_pose3d_t GetPose(uint32_t aIndex) const;
  /// Requests the poses. They are known from the start, so nothing changes.
  void RequestGeom();

 private:
  std::vector<player_pose3d_t> mPoses;
};

}  // namespace PlayerCc

namespace std {
/// Prints the transducers, one per line: x, y, yaw, range.
std::ostream& operator<<(std::ostream& os, const PlayerCc::SonarProxy& c);
}  // namespace std
