// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/core/elevation.h"

#include <algorithm>
#include <cmath>

namespace sim {

Eigen::Matrix3d rotation_of(double roll_rad, double pitch_rad, double yaw_rad) {
  return (Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()) *
          Eigen::AngleAxisd(pitch_rad, Eigen::Vector3d::UnitY()) *
          Eigen::AngleAxisd(roll_rad, Eigen::Vector3d::UnitX()))
      .toRotationMatrix();
}

EulerAngles euler_angles_of(const Eigen::Matrix3d& rotation) {
  return {std::atan2(rotation(2, 1), rotation(2, 2)),
          std::asin(std::clamp(-rotation(2, 0), -1.0, 1.0)),
          std::atan2(rotation(1, 0), rotation(0, 0))};
}

Eigen::Isometry3d in_space(const Pose& X_WB, const Elevation& elevation) {
  Eigen::Isometry3d made = Eigen::Isometry3d::Identity();
  made.linear() = rotation_of(elevation.roll_rad, elevation.pitch_rad, X_WB.yaw_rad);
  made.translation() = Eigen::Vector3d(X_WB.x_m, X_WB.y_m, elevation.z_m);
  return made;
}

std::array<double, 3> body_rates(const EulerAngles& angles, const EulerAngles& rates) {
  const double sr = std::sin(angles.roll_rad);
  const double cr = std::cos(angles.roll_rad);
  const double sp = std::sin(angles.pitch_rad);
  const double cp = std::cos(angles.pitch_rad);
  return {rates.roll_rad - sp * rates.yaw_rad, cr * rates.pitch_rad + cp * sr * rates.yaw_rad,
          -sr * rates.pitch_rad + cp * cr * rates.yaw_rad};
}

}  // namespace sim
