// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "drivers/local_obstacles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "sim/core/math.h"
#include "sim/core/pose.h"

namespace playerlike {
namespace {

constexpr double kMemorySpacing_m = 0.01;
constexpr std::size_t kMemories = 2000;
// A twist must be free of collisions for its period plus this time.
constexpr double kBraking_s = 0.15;

}  // namespace

bool LocalObstacles::View::covers(double bearing_rad) const {
  return std::abs(sim::normalize_angle(bearing_rad - middle_rad)) <= half_rad;
}

void LocalObstacles::update(double time_s, const sim::Pose& X_WB, const NavigationScan& scan) {
  const double span_rad = scan.resolution_rad * static_cast<double>(scan.ranges_m.size());
  view_ = {scan.angle_min_rad + 0.5 * (span_rad - scan.resolution_rad) + scan.X_BL.yaw_rad,
           std::min(0.5 * span_rad, std::numbers::pi)};
  const sim::Pose X_BW = X_WB.inverse();
  const auto add = [this](const sim::Vec2& p_BO) {
    obstacles_.push_back({p_BO, p_BO.norm(), sim::math::atan2(p_BO.y(), p_BO.x())});
  };
  const auto in_view = [&](const sim::Vec2& p_BO) {
    const sim::Vec2 p_LO = p_BO - scan.X_BL.position();
    return view_.covers(sim::math::atan2(p_LO.y(), p_LO.x()));
  };
  obstacles_.clear();
  std::erase_if(memory_, [&](const Memory& m) {
    const sim::Vec2 p_BO = X_BW * m.p_WO;
    return time_s - m.time_s > kMemory_s || p_BO.norm() > kHorizon_m || in_view(p_BO);
  });
  for (const Memory& m : last_scan_) {
    const sim::Vec2 p_BO = X_BW * m.p_WO;
    if (p_BO.norm() > kHorizon_m || in_view(p_BO) || memory_.size() >= kMemories) continue;
    const bool is_known = std::any_of(memory_.begin(), memory_.end(), [&](const Memory& known) {
      return (known.p_WO - m.p_WO).cwiseAbs().maxCoeff() < kMemorySpacing_m;
    });
    if (!is_known) memory_.push_back(m);
  }
  for (const Memory& m : memory_) add(X_BW * m.p_WO);
  last_scan_.clear();
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    if (scan.ranges_m[i] >= scan.range_max_m) continue;
    const double angle_rad = scan.angle_min_rad + static_cast<double>(i) * scan.resolution_rad;
    const sim::Vec2 p_LO = scan.ranges_m[i] * sim::unit_vector(angle_rad);
    add(scan.X_BL * p_LO);
    last_scan_.push_back({X_WB * obstacles_.back().p_BO, time_s});
  }
  std::stable_sort(obstacles_.begin(), obstacles_.end(), [](const Obstacle& a, const Obstacle& b) {
    return a.bearing_rad < b.bearing_rad;
  });
}

sim::Twist LocalObstacles::safe_twist(double speed_mps, double turn_radps, double period_s,
                                      double robot_radius_m) const {
  constexpr std::array kShares{1.0, 0.75, 0.5, 0.25, 0.1};
  for (const double share : kShares) {
    const sim::Twist twist{.v_mps = share * speed_mps, .omega_radps = turn_radps};
    if (is_safe(twist, period_s, robot_radius_m)) return twist;
  }
  return {0.0, turn_radps};
}

// Whether the robot's disc stays clear of all obstacles under this twist until it could have
// stopped. Leaving an obstacle that the disc overlaps already is safe.
bool LocalObstacles::is_safe(const sim::Twist& twist, double period_s,
                             double robot_radius_m) const {
  constexpr int kPlaces = 5;
  const double radius_m = robot_radius_m + kMargin_m;
  const double reach_m = std::abs(twist.v_mps) * (period_s + kBraking_s) + radius_m;
  const double step_s = (period_s + kBraking_s) / kPlaces;
  sim::Pose X_BP;
  std::array<sim::Vec2, kPlaces> places;
  for (sim::Vec2& place : places) {
    const double mid_rad = X_BP.yaw_rad + 0.5 * twist.omega_radps * step_s;
    X_BP.x_m += twist.v_mps * step_s * sim::math::cos(mid_rad);
    X_BP.y_m += twist.v_mps * step_s * sim::math::sin(mid_rad);
    X_BP.yaw_rad += twist.omega_radps * step_s;
    place = X_BP.position();
  }
  for (const Obstacle& o : obstacles_) {
    if (o.distance_m > reach_m) continue;
    double before_m = o.distance_m;
    for (const sim::Vec2& place : places) {
      const double distance_m = (o.p_BO - place).norm();
      if (distance_m < radius_m && distance_m < before_m) return false;
      before_m = distance_m;
    }
  }
  return true;
}

}  // namespace playerlike
