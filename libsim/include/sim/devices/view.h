// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <numbers>
#include <string>

#include "sim/core/fields.h"
#include "sim/core/pose.h"

namespace sim {

/// Settings of devices that view the world through a lens (blobfinder, camera). The default picture
/// size, angle and range are those of Stage's blobfinder.
struct ViewParams {
  int width = 80;                                     ///< of the picture [pixels], 1..kMaxWidth
  int height = 60;                                    ///< [pixels], 1..kMaxHeight
  double field_of_view_rad = std::numbers::pi / 3.0;  ///< horizontal, (0, kMaxView_rad]
  double range_max_m = 12.0;                          ///< [m]
  Pose X_BS;                                          ///< mounting on the body
  double height_m = 0.2;                              ///< above the floor [m]
  std::string ptz;  ///< name of the robot's ptz device on which it is mounted; empty: it looks
                    ///< along X_BS

  static constexpr int kMaxWidth = 640;
  static constexpr int kMaxHeight = 480;
  static constexpr double kMaxView_rad = 170.0 / 180.0 * std::numbers::pi;
};

/// Fields that cameras and blobfinders share.
template <>
const FieldTable& fields_of<ViewParams>();

/// Projection of the world onto a picture: an ideal pinhole camera with square pixels and a
/// horizontal axis (Hartley, Zisserman, Multiple View Geometry, 2nd ed. 2004, sec. 6.1, with the
/// principal point in the middle).
///
/// Frames: S sensor (x forward, y left). In a picture, column 0 is at the left, row 0 at the top,
/// and the centre of pixel (c, r) is at (c + 0.5, r + 0.5). Unlike a real head, a tilt does not
/// rotate the camera. It shifts the picture up or down by f tan(tilt), like a shift lens: vertical
/// edges stay vertical, and each column sees what one ray on the floor meets.
struct PinholeView {
  int width;                 ///< [pixels]
  int height;                ///< [pixels]
  double field_of_view_rad;  ///< horizontal, (0, pi)
  double tilt_rad = 0.0;     ///< upwards, (-pi/2, pi/2)

  /// f = (width / 2) / tan(view / 2) [pixels].
  [[nodiscard]] double focal_px() const;
  /// Slope y / x in S of the ray through the middle of a column; > 0 on the left.
  [[nodiscard]] double slope(int column) const;
  /// Vertical position of a point in the picture, from its top edge [pixels]: height / 2 + f
  /// (tan(tilt) - rise / depth).
  /// @param depth_m  its x in S, > 0 [m].
  /// @param rise_m   its height above the lens [m]; may be infinite.
  [[nodiscard]] double row_px(double depth_m, double rise_m) const;
};

}  // namespace sim
