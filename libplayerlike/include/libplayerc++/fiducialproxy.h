// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <iosfwd>
#include <vector>

#include "libplayerc++/clientproxy.h"

namespace PlayerCc {

/// A sensor that detects numbered objects: robots and obstacles with a `fiducial` in the world
/// file.
///
/// Items are sorted by distance, nearest first. The fields of an item are: `id`, the object's
/// number, or 0 if it is too far away to be read (as in Stage); `pose`, the pose of its centre in
/// the sensor's frame; `upose`, the standard deviations of `pose`. Before the first reading there
/// are 0 items, and each of them is zero.
///
/// An item whose index is not below GetCount() is all zeros; while there are items, a warning on
/// standard error says so, once for each proxy.
class FiducialProxy : public ClientProxy {
 public:
  /// @throws PlayerError kNoSuchDevice if the device does not exist; the text names those that do.
  FiducialProxy(PlayerClient* aPc, uint32_t aIndex = 0);
  ~FiducialProxy() override;

  uint32_t GetCount() const;  ///< number of objects in view
  player_fiducial_item_t GetFiducialItem(uint32_t aIndex) const;
  player_pose3d_t GetSensorPose() const;    ///< in the robot's body frame
  player_bbox3d_t GetSensorSize() const;    ///< 0: the simulated sensor is a point
  player_bbox2d_t GetFiducialSize() const;  ///< 0: objects of any size can have a number
  /// Requests the geometry. It is known from the start, so nothing changes.
  void RequestGeometry();
  /// Same as GetFiducialItem().
  player_fiducial_item_t operator[](uint32_t aIndex) const;
};

}  // namespace PlayerCc

namespace std {
/// Prints the objects in view, one per line: id, x, y, yaw.
std::ostream& operator<<(std::ostream& os, const PlayerCc::FiducialProxy& c);
}  // namespace std
