// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/core/elevation.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "sim/core/math.h"

namespace sim {

Eigen::Matrix3d rotation_of(double roll_rad, double pitch_rad, double yaw_rad) {
  const auto [sr, cr] = math::sin_cos(roll_rad);
  const auto [sp, cp] = math::sin_cos(pitch_rad);
  const auto [sy, cy] = math::sin_cos(yaw_rad);
  Eigen::Matrix3d R;
  R << cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr,  //
      sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr,   //
      -sp, cp * sr, cp * cr;
  return R;
}

Eigen::Matrix3d rotation_about(const Eigen::Vector3d& axis, double angle_rad) {
  const auto [s, c] = math::sin_cos(angle_rad);
  Eigen::Matrix3d cross;
  cross << 0.0, -axis.z(), axis.y(), axis.z(), 0.0, -axis.x(), -axis.y(), axis.x(), 0.0;
  return c * Eigen::Matrix3d::Identity() + s * cross + (1.0 - c) * (axis * axis.transpose());
}

Eigen::Vector3d rotation_vector_of(const Eigen::Matrix3d& rotation) {
  const Eigen::Quaterniond turn(rotation);
  const double size = turn.vec().norm();  // sine of half the angle
  if (size == 0.0) return Eigen::Vector3d::Zero();
  const double half_rad = math::atan2(size, std::abs(turn.w()));
  return (std::copysign(2.0 * half_rad, turn.w()) / size) * turn.vec();
}

EulerAngles euler_angles_of(const Eigen::Matrix3d& rotation) {
  return {math::atan2(rotation(2, 1), rotation(2, 2)),
          math::asin(std::clamp(-rotation(2, 0), -1.0, 1.0)),
          math::atan2(rotation(1, 0), rotation(0, 0))};
}

Eigen::Isometry3d in_space(const Pose& X_WB, const Elevation& elevation) {
  Eigen::Isometry3d made = Eigen::Isometry3d::Identity();
  made.linear() = rotation_of(elevation.roll_rad, elevation.pitch_rad, X_WB.yaw_rad);
  made.translation() = Eigen::Vector3d(X_WB.x_m, X_WB.y_m, elevation.z_m);
  return made;
}

std::array<double, 3> body_rates(const EulerAngles& angles, const EulerAngles& rates) {
  const auto [sr, cr] = math::sin_cos(angles.roll_rad);
  const auto [sp, cp] = math::sin_cos(angles.pitch_rad);
  return {rates.roll_rad - sp * rates.yaw_rad, cr * rates.pitch_rad + cp * sr * rates.yaw_rad,
          -sr * rates.pitch_rad + cp * cr * rates.yaw_rad};
}

}  // namespace sim
