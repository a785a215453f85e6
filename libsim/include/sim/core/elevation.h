// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <array>

#include "sim/core/pose.h"

namespace sim {

/// Height and inclination of a robot's body.
///
/// They are values only: physics and range sensing treat every robot as standing on the floor,
/// upright. Teleport and orientation devices set them; sensors that measure a pose in space show
/// them.
struct Elevation {
  double z_m = 0.0;        ///< height of the body's origin over the floor [m]
  double roll_rad = 0.0;   ///< about the body's x axis [rad]
  double pitch_rad = 0.0;  ///< about the body's y axis; positive: nose down [rad]

  friend bool operator==(const Elevation&, const Elevation&) = default;
};

/// Roll, pitch and yaw of a rotation R = Rz(yaw) Ry(pitch) Rx(roll) [rad].
struct EulerAngles {
  double roll_rad = 0.0;
  double pitch_rad = 0.0;  ///< [-pi/2, pi/2]
  double yaw_rad = 0.0;    ///< (-pi, pi]
};

/// A rotation from its angles about the moved axes z, y, x.
[[nodiscard]] Eigen::Matrix3d rotation_of(double roll_rad, double pitch_rad, double yaw_rad);

/// The rotation by an angle about an axis of length 1 (O. Rodrigues, 1840).
[[nodiscard]] Eigen::Matrix3d rotation_about(const Eigen::Vector3d& axis, double angle_rad);

/// The axis of a rotation, as long as its angle in [0, pi] [rad].
[[nodiscard]] Eigen::Vector3d rotation_vector_of(const Eigen::Matrix3d& rotation);

/// The angles of a rotation. Inverse of rotation_of() for a pitch in (-pi/2, pi/2).
[[nodiscard]] EulerAngles euler_angles_of(const Eigen::Matrix3d& rotation);

/// Pose of a body in space.
/// @param X_WB  its pose in the plane.
[[nodiscard]] Eigen::Isometry3d in_space(const Pose& X_WB, const Elevation& elevation);

/// Turn rates about the body's axes from the rates of its Euler angles (Diebel, Representing
/// attitude, Stanford University, 2006, sec. 5.6) [rad/s].
/// @param angles  of the body.
/// @param rates   of roll, pitch and yaw [rad/s].
[[nodiscard]] std::array<double, 3> body_rates(const EulerAngles& angles, const EulerAngles& rates);

}  // namespace sim
