// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause

// The guard has the name that course programs use in their own robot_types.h, so whichever of the
// two is included first is the only one seen. A program's own file next to its sources is found
// first by #include "robot_types.h".
#ifndef __ROBOT_TYPES_H__
#define __ROBOT_TYPES_H__

namespace imr {
namespace robot {

/// Pose of a robot's body in the world frame, as course programs store it.
///
/// Frame: W, x right and y up on the arena's plan, yaw counter-clockwise from W's x axis.
/// Nothing is checked or normalised. A plain value: share it between threads under a lock only.
struct SPosition {
  double x;    ///< Position along W's x axis [m]; 0 by default.
  double y;    ///< Position along W's y axis [m]; 0 by default.
  double yaw;  ///< Heading [rad]; 0 by default.

  /// The origin of W, heading along its x axis.
  constexpr SPosition() noexcept : x(0.0), y(0.0), yaw(0.0) {}

  /// @param x_m      position along W's x axis [m].
  /// @param y_m      position along W's y axis [m].
  /// @param yaw_rad  heading, counter-clockwise [rad].
  constexpr SPosition(double x_m, double y_m, double yaw_rad = 0.0) noexcept
      : x(x_m), y(y_m), yaw(yaw_rad) {}
};

}  // namespace robot
}  // namespace imr

#endif  // __ROBOT_TYPES_H__
