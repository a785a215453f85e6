// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause

// Course programs use this include guard in their own robot_types.h, so only the file that is
// included first takes effect. #include "robot_types.h" finds a file next to the program's sources
// first.
#ifndef __ROBOT_TYPES_H__
#define __ROBOT_TYPES_H__

namespace imr {
namespace robot {

/// Pose of a robot's body in the world frame, as course programs store it.
///
/// Frame: W, with x to the right and y up in the arena's plan; yaw is counter-clockwise from W's x
/// axis. Values are neither checked nor normalized. The struct has no lock: protect it with a mutex
/// if several threads use it.
struct SPosition {
  double x;    ///< Position along W's x axis [m]; 0 by default.
  double y;    ///< Position along W's y axis [m]; 0 by default.
  double yaw;  ///< Heading [rad]; 0 by default.

  /// Creates the origin of W, with heading along its x axis.
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
