// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <numbers>

#include "sim/core/math.h"

namespace sim {

/// A point or a vector in the plane, in metres unless its name says otherwise.
using Vec2 = Eigen::Vector2d;

/// The vector of length 1 in a direction [rad].
[[nodiscard]] inline Vec2 unit_vector(double angle_rad) {
  const auto [s, c] = math::sin_cos(angle_rad);
  return {c, s};
}

/// Wraps an angle into (-pi, pi].
/// @param angle_rad  any finite angle [rad].
[[nodiscard]] inline double normalize_angle(double angle_rad) {
  constexpr double kHalfTurn = std::numbers::pi;
  constexpr double kTurn = 2.0 * kHalfTurn;
  if (angle_rad > -kHalfTurn && angle_rad <= kHalfTurn) return angle_rad;
  // Up to four turns, their multiples are exact, since three bits at the end of kTurn are zero. So
  // are these differences (Sterbenz), which makes them the remainder.
  constexpr double kExact_rad = 28.0;
  if (angle_rad > -kExact_rad && angle_rad < kExact_rad) {
    const double nearest = angle_rad * (1.0 / kTurn) + (angle_rad > 0.0 ? 0.5 : -0.5);
    const double wrapped = angle_rad - kTurn * static_cast<int>(nearest);
    if (wrapped > kHalfTurn) return wrapped - kTurn;
    return wrapped <= -kHalfTurn ? wrapped + kTurn : wrapped;
  }
  const double wrapped = std::remainder(angle_rad, kTurn);
  return wrapped == -kHalfTurn ? kHalfTurn : wrapped;
}

/// Pose of a frame B in a frame A: the position of B's origin in A, and the rotation of B against
/// A.
///
/// Written X_AB (frames as in docs/conventions.md: W world, B body, L laser); p_AQ = X_AB * p_BQ.
/// Axes: x forward, y left; yaw counter-clockwise.
struct Pose {
  double x_m = 0.0;      ///< position of B's origin along A's x axis [m]
  double y_m = 0.0;      ///< position of B's origin along A's y axis [m]
  double yaw_rad = 0.0;  ///< turn from A's to B's x axis, counter-clockwise [rad], (-pi, pi]

  [[nodiscard]] Vec2 position() const { return {x_m, y_m}; }

  /// p_AQ = X_AB * p_BQ: a point given in B, expressed in A [m].
  [[nodiscard]] friend Vec2 operator*(const Pose& X_AB, const Vec2& p_BQ) {
    const auto [s, c] = math::sin_cos(X_AB.yaw_rad);
    return {X_AB.x_m + c * p_BQ.x() - s * p_BQ.y(), X_AB.y_m + s * p_BQ.x() + c * p_BQ.y()};
  }

  /// X_BA, the pose of A in B.
  [[nodiscard]] Pose inverse() const {
    const auto [s, c] = math::sin_cos(yaw_rad);
    return {-c * x_m - s * y_m, s * x_m - c * y_m, normalize_angle(-yaw_rad)};
  }

  friend bool operator==(const Pose&, const Pose&) = default;
};

/// A pose with the cosine and the sine of its yaw, for several products with it. They have the same
/// bits as those of the pose.
struct Frame {
  explicit Frame(const Pose& pose) : Frame(pose, math::sin_cos(pose.yaw_rad)) {}

  /// X_AC = X_AB * X_BC.
  [[nodiscard]] Pose operator*(const Pose& X_BC) const {
    return {X_AB.x_m + cos_yaw * X_BC.x_m - sin_yaw * X_BC.y_m,
            X_AB.y_m + sin_yaw * X_BC.x_m + cos_yaw * X_BC.y_m,
            normalize_angle(X_AB.yaw_rad + X_BC.yaw_rad)};
  }

  Pose X_AB;
  double cos_yaw, sin_yaw;

 private:
  Frame(const Pose& pose, const math::SinCos& yaw)
      : X_AB(pose), cos_yaw(yaw.cos), sin_yaw(yaw.sin) {}
};

/// X_AC = X_AB * X_BC.
[[nodiscard]] inline Pose operator*(const Pose& X_AB, const Pose& X_BC) {
  return Frame(X_AB) * X_BC;
}

/// Planar velocity of a body, in its own frame.
struct Twist {
  double v_mps = 0.0;        ///< forward speed, along the body's x axis [m/s]
  double omega_radps = 0.0;  ///< turning rate, counter-clockwise [rad/s]
  double lateral_mps =
      0.0;  ///< speed along the body's y axis (left) [m/s]; 0 for a differential drive

  friend bool operator==(const Twist&, const Twist&) = default;
};

}  // namespace sim
