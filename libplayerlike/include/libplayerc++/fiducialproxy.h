// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <iosfwd>
#include <vector>

#include "libplayerc++/clientproxy.h"

namespace PlayerCc {

/// A sensor that sees numbered things: robots and obstacles to which the world gave a `fiducial`.
///
/// Things in view come nearest first. Of an item, `id` is the thing's number, 0 if it is too far
/// away to be read (as with Stage), `pose` where its middle is and how it is turned, seen from the
/// sensor, and `upose` the standard deviations of that. Before the first reading there are 0 items,
/// and each is zero.
///
/// An item whose index is not below GetCount() is all zeros; while there are items, a warning on
/// standard error says so, once for each proxy.
class FiducialProxy : public ClientProxy {
 public:
  /// @throws PlayerError kNoSuchDevice if there is no such device; the text names those there are.
  FiducialProxy(PlayerClient* aPc, uint32_t aIndex = 0);
  ~FiducialProxy() override;

  uint32_t GetCount() const;  ///< things in view
  player_fiducial_item_t GetFiducialItem(uint32_t aIndex) const;
  player_pose3d_t GetSensorPose() const;    ///< in the robot's body
  player_bbox3d_t GetSensorSize() const;    ///< 0: the simulated sensor is a point
  player_bbox2d_t GetFiducialSize() const;  ///< 0: things of any size bear a number
  /// Asks for the geometry; known from the start.
  void RequestGeometry();
  /// GetFiducialItem().
  player_fiducial_item_t operator[](uint32_t aIndex) const;
};

}  // namespace PlayerCc

namespace std {
/// Prints the things in view, one a line: id, x, y, yaw.
std::ostream& operator<<(std::ostream& os, const PlayerCc::FiducialProxy& c);
}  // namespace std
