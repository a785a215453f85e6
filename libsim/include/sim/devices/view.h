// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <numbers>
#include <string>

#include "sim/core/fields.h"
#include "sim/core/pose.h"

namespace sim {

/// Settings of what looks at the world through a lens (blobfinder, camera); picture, angle and
/// range are by default those of Stage's blobfinder.
struct ViewParams {
  int width = 80;                                     ///< of the picture [pixels], 1..kMaxWidth
  int height = 60;                                    ///< [pixels], 1..kMaxHeight
  double field_of_view_rad = std::numbers::pi / 3.0;  ///< from side to side, (0, kMaxView_rad]
  double range_max_m = 12.0;                          ///< (0, 1000] [m]
  Pose X_BS;                                          ///< mounting on the body
  double height_m = 0.2;                              ///< above the floor [m], >= 0
  std::string ptz;  ///< name of the robot's ptz device that turns and zooms it; none: it looks
                    ///< along X_BS

  static constexpr int kMaxWidth = 640;
  static constexpr int kMaxHeight = 480;
  static constexpr double kMaxView_rad = 170.0 / 180.0 * std::numbers::pi;
};

/// Fields that cameras and blobfinders have in common.
template <>
const FieldTable& fields_of<ViewParams>();

/// How the world is projected on a picture: an ideal pinhole with square pixels, its axis
/// horizontal (Hartley, Zisserman, Multiple View Geometry, 2nd ed. 2004, sec. 6.1, with the
/// principal point in the middle).
///
/// Frames: S sensor (x forward, y left). Pictures: column 0 on the left, row 0 on top, the middle
/// of pixel (c, r) is at (c + 0.5, r + 0.5).
/// Unlike a real head's, a tilt moves the picture up or down as a lens that is shifted does, by
/// f tan(tilt): what stands upright stays upright in it, and a column sees what one ray on the
/// floor meets.
struct PinholeView {
  int width;                 ///< [pixels]
  int height;                ///< [pixels]
  double field_of_view_rad;  ///< from side to side, (0, pi)
  double tilt_rad = 0.0;     ///< upwards, (-pi/2, pi/2)

  /// f = (width / 2) / tan(view / 2) [pixels].
  [[nodiscard]] double focal_px() const;
  /// Slope y / x in S of what the middle of a column sees; > 0 on the left.
  [[nodiscard]] double slope(int column) const;
  /// Where a point stands in the picture, from its top edge [pixels]:
  /// height / 2 + f (tan(tilt) - rise / depth).
  /// @param depth_m  its x in S, > 0 [m].
  /// @param rise_m   how much higher than the lens it is [m]; may be infinite.
  [[nodiscard]] double row_px(double depth_m, double rise_m) const;
};

}  // namespace sim
