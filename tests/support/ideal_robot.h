// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include "drivers/navigator.h"
#include "sim/world/outline.h"

/// An ideal robot among walls, without a simulation, for tests of navigators.
namespace test {

inline constexpr double kPi = std::numbers::pi;
using sim::Pose;
using sim::Vec2;

using Segment = std::pair<Vec2, Vec2>;

inline std::vector<Segment> box(double x_min, double y_min, double x_max, double y_max) {
  const Vec2 a(x_min, y_min);
  const Vec2 b(x_max, y_min);
  const Vec2 c(x_max, y_max);
  const Vec2 d(x_min, y_max);
  return {{a, b}, {b, c}, {c, d}, {d, a}};
}

/// A scan of 270 beams over 270 degrees, from 3.5 cm ahead of the axle, as on an S1R.
inline playerlike::NavigationScan scan_at(const Pose& X_WB, const std::vector<Segment>& walls) {
  playerlike::NavigationScan scan;
  scan.X_BL = {0.035, 0.0, 0.0};
  scan.range_max_m = 5.0;
  scan.resolution_rad = kPi / 180.0;
  scan.angle_min_rad = -134.5 * scan.resolution_rad;
  const Pose X_WL = X_WB * scan.X_BL;
  for (int i = 0; i < 270; ++i) {
    const double angle_rad = X_WL.yaw_rad + scan.angle_min_rad + i * scan.resolution_rad;
    const Vec2 u(std::cos(angle_rad), std::sin(angle_rad));
    double range_m = scan.range_max_m;
    for (const auto& [a, b] : walls) {
      // p + r u = a + s (b - a), solved by Cramer's rule.
      const Vec2 e = b - a;
      const Vec2 d = a - X_WL.position();
      const double det = e.x() * u.y() - e.y() * u.x();
      if (std::abs(det) < 1e-12) continue;
      const double r = (e.x() * d.y() - e.y() * d.x()) / det;
      const double s = (u.x() * d.y() - u.y() * d.x()) / det;
      if (r >= 0.0 && s >= 0.0 && s <= 1.0) range_m = std::min(range_m, r);
    }
    scan.ranges_m.push_back(range_m);
  }
  return scan;
}

inline double distance_to(const Segment& wall, const Vec2& p) {
  return sim::distance_to_segment_m(p, wall.first, wall.second);
}

/// Drives an ideal robot until the state is no longer kMoving.
struct Drive {
  Pose X_WB;
  double time_s = 0.0;
  double least_m = std::numeric_limits<double>::infinity();  // between a wall and the centre
  double turned_rad = 0.0;  // sum of all turning in both directions
  double fastest_mps = 0.0;

  void run(playerlike::Navigator& navigation, const std::vector<Segment>& walls, double limit_s) {
    while (navigation.state() == playerlike::GoalState::kMoving && time_s < limit_s) {
      time_s += 0.1;
      const sim::Twist twist = navigation.step(time_s, X_WB, scan_at(X_WB, walls));
      fastest_mps = std::max(fastest_mps, twist.v_mps);
      turned_rad += std::abs(twist.omega_radps) * 0.1;
      for (int i = 0; i < 10; ++i) {
        X_WB = X_WB * Pose{twist.v_mps * 0.01, 0.0, twist.omega_radps * 0.01};
        for (const Segment& wall : walls) {
          least_m = std::min(least_m, distance_to(wall, X_WB.position()));
        }
      }
    }
  }
};

}  // namespace test
