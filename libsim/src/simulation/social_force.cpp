// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "simulation/social_force.h"

#include <cmath>

#include "sim/core/math.h"

namespace sim::social_force {
namespace {

constexpr double kLookahead_s = 2.0;    // of another's way
constexpr double kCosPhi = -0.1736482;  // cos(100 degrees)
constexpr double kBehind = 0.5;
constexpr double kReach = 7.0;  // exp(-7) is below a thousandth

}  // namespace

Vec2 towards(const Vec2& direction, double speed_mps, const Vec2& velocity,
             const SocialForce& constants) {
  return (speed_mps * direction - velocity) / constants.relaxation_s;
}

Vec2 repulsion(const Vec2& offset, const Vec2& velocity, const Vec2& direction,
               const SocialForce& constants) {
  const double distance_m = offset.norm();
  const Vec2 way = kLookahead_s * velocity;
  const double way_m = way.norm();
  const double reach_m = kReach * constants.repulsion_range_m;
  // A lower bound of b, from |r - s| >= |r| - |s|.
  if (distance_m > way_m && distance_m * (distance_m - way_m) > reach_m * reach_m)
    return {0.0, 0.0};
  const Vec2 ahead = offset - way;
  const double ahead_m = ahead.norm();
  const double sum_m = distance_m + ahead_m;
  const double b_m = 0.5 * std::sqrt((sum_m - way_m) * (sum_m + way_m));
  // On the way itself b is 0, and its gradient has no direction.
  if (!(b_m > 1e-6) || !(distance_m > 1e-6) || !(ahead_m > 1e-6) || b_m > reach_m) {
    return {0.0, 0.0};
  }
  const Vec2 gradient = sum_m / (4.0 * b_m) * (offset / distance_m + ahead / ahead_m);
  const Vec2 force = constants.repulsion_m2ps2 / constants.repulsion_range_m *
                     math::exp(-b_m / constants.repulsion_range_m) * gradient;
  const bool behind = direction.dot(-force) < force.norm() * kCosPhi;
  return behind ? Vec2(kBehind * force) : force;
}

Vec2 wall_repulsion(const Vec2& offset, const SocialForce& constants) {
  const double distance_m = offset.norm();
  if (!(distance_m > 1e-6) || distance_m > wall_reach_m(constants)) return {0.0, 0.0};
  return constants.wall_repulsion_m2ps2 / constants.wall_range_m *
         math::exp(-distance_m / constants.wall_range_m) / distance_m * offset;
}

double wall_reach_m(const SocialForce& constants) { return kReach * constants.wall_range_m; }

}  // namespace sim::social_force
