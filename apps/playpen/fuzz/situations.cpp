// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "fuzz/situations.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/core/math.h"

namespace playpen::fuzz {
namespace {

constexpr int kDirections = 8;
constexpr double kFar_m = kFarthestRoom_m;
constexpr double kNear_m = 0.25;
constexpr double kLook_s = 0.5;  // between situations

// The distance from a place to something solid in a direction, at most kFar_m, by steps of the
// distance to the nearest solid.
double free_m(const sim::DistanceField& field, const sim::Vec2& from, double angle_rad) {
  const sim::Vec2 way(sim::math::cos(angle_rad), sim::math::sin(angle_rad));
  double driven_m = 0.0;
  while (driven_m < kFar_m) {
    const double room_m = room_at(field, from + driven_m * way);
    if (room_m < field.cell_size_m) return driven_m;
    driven_m += room_m;
  }
  return kFar_m;
}

std::uint32_t level(double value, double low, double high) {
  return value < low ? 0U : value < high ? 1U : 2U;
}

}  // namespace

std::size_t Situations::add(const RunResult& result, const Base& base, const Base::World& world) {
  const auto way = std::ranges::find(result.trajectories, base.robot_description().name,
                                     &grade::Trajectory::robot);
  if (way == result.trajectories.end()) return 0;
  const std::size_t before = seen_.size();
  double next_s = 0.0;
  for (std::size_t i = 0; i < way->time_s.size(); ++i) {
    if (way->time_s[i] < next_s) continue;
    next_s = way->time_s[i] + kLook_s;
    std::uint32_t situation = 0;
    for (int k = 0; k < kDirections; ++k) {
      const double angle_rad = way->X_WB[i].yaw_rad + 2.0 * std::numbers::pi * k / kDirections;
      const double room_m =
          free_m(world.room, way->X_WB[i].position(), angle_rad) - base.robot_radius_m();
      situation = 3 * situation + level(room_m, kNear_m - base.robot_radius_m(), kFar_m / 2);
    }
    situation = 3 * situation + level(way->v_mps[i], -0.02, 0.05);
    situation = 3 * situation + level(way->omega_radps[i], -0.3, 0.3);
    seen_.insert(situation);
  }
  return seen_.size() - before;
}

}  // namespace playpen::fuzz
