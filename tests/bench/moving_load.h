// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <chrono>
#include <limits>
#include <string>

#include "figures.h"
#include "realtime.h"
#include "sim/simulation/simulation.h"
#include "sim/world/outline.h"

namespace sim::bench {

// 13 robots that drive among 50 obstacles, half of them round, on a floor of 12 x 12 m. The
// obstacles move back and forth, or stand.
inline WorldDescription world_of_obstacles(bool moving) {
  WorldDescription world = endless(kThirteen);
  world.arena = {};
  world.arena.size = {12.0, 12.0};
  for (int i = 0; i < 50; ++i) {
    ObstacleDescription o;
    o.name = std::string("m").append(std::to_string(i));
    o.center = {1.0 + 1.1 * (i % 10), 1.5 + 2.2 * (i / 10)};
    if (i % 2 == 0) make_circle(o, 0.1);
    if (moving) {
      ObstacleMotion motion;
      motion.law = MotionLaw::kPath;
      motion.repeat = PathRepeat::kBackAndForth;
      motion.points = {o.center + Vec2(i % 3 == 0 ? 0.0 : 0.4, i % 3 == 0 ? 0.4 : 0.0)};
      o.motion = motion;
    }
    world.arena.obstacles.push_back(o);
  }
  for (std::size_t i = 0; i < world.robots.size(); ++i) {
    world.robots[i].pose = Pose{0.8 + 0.8 * static_cast<double>(i), 0.6, 0.0};
  }
  return world;
}

// The cost of a step with 50 obstacles that stand, and with 50 that move. The two take turns, so
// that a slow moment of the machine affects both.
inline void moving_figures() {
  const WorldDescription fixed_world = world_of_obstacles(false);
  const WorldDescription moving_world = world_of_obstacles(true);
  using Seconds = std::chrono::duration<double>;
  Seconds best_fixed{std::numeric_limits<double>::infinity()};
  Seconds best_moving = best_fixed;
  for (int round = 0; round < 9; ++round) {
    Simulation fixed(fixed_world);
    Simulation moving(moving_world);
    Seconds fixed_time{};
    Seconds moving_time{};
    constexpr int kRounds = 300;
    const auto timed = [](Simulation& simulation) {
      wander(simulation);
      const auto begin = std::chrono::steady_clock::now();
      for (int i = 0; i < 10; ++i) simulation.step();
      return std::chrono::steady_clock::now() - begin;
    };
    for (int k = 0; k < kRounds; ++k) {
      fixed_time += timed(fixed);
      moving_time += timed(moving);
    }
    best_fixed = std::min(best_fixed, fixed_time / (10.0 * kRounds));
    best_moving = std::min(best_moving, moving_time / (10.0 * kRounds));
  }
  figure("obstacles_fixed_step_us", best_fixed.count() * 1e6);
  figure("obstacles_moving_step_us", best_moving.count() * 1e6);
  figure("obstacles_moving_ratio", best_moving / best_fixed);
}

}  // namespace sim::bench
