// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/navigation/odometry_motion.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/core/math.h"

namespace sim {
namespace {

constexpr double kNoDirection_m = 1e-3;

/// A turn, or what it differs from half a turn, whichever is smaller.
double turn_without_reverse(double turn_rad) {
  const double turn = std::abs(normalize_angle(turn_rad));
  return std::min(turn, std::numbers::pi - turn);
}

}  // namespace

OdometryMotion::OdometryMotion(const Pose& X_AB, const OdometryNoise& noise) {
  drive_m_ = math::hypot(X_AB.x_m, X_AB.y_m);
  turn1_rad_ = drive_m_ < kNoDirection_m ? 0.0 : math::atan2(X_AB.y_m, X_AB.x_m);
  turn2_rad_ = normalize_angle(X_AB.yaw_rad - turn1_rad_);
  const double a = turn_without_reverse(turn1_rad_);
  const double b = turn_without_reverse(turn2_rad_);
  const double drive2 = drive_m_ * drive_m_;
  turn1_deviation_rad_ = std::sqrt(noise.turn_from_turn * a * a + noise.turn_from_drive * drive2);
  turn2_deviation_rad_ = std::sqrt(noise.turn_from_turn * b * b + noise.turn_from_drive * drive2);
  drive_deviation_m_ =
      std::sqrt(noise.drive_from_drive * drive2 + noise.drive_from_turn * (a * a + b * b));
}

Pose OdometryMotion::sample(RandomStream& random) const {
  const double turn1 = turn1_rad_ + random.gaussian(turn1_deviation_rad_);
  const double drive = drive_m_ + random.gaussian(drive_deviation_m_);
  const double turn2 = turn2_rad_ + random.gaussian(turn2_deviation_rad_);
  const auto [s, c] = math::sin_cos(turn1);
  return {drive * c, drive * s, normalize_angle(turn1 + turn2)};
}

}  // namespace sim
