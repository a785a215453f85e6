// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

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

// The cost of a step with 50 obstacles that stand, and with 50 that move.
inline void moving_figures() {
  const auto [fixed_s, moving_s] =
      step_times_s(world_of_obstacles(false), world_of_obstacles(true), 300);
  figure("obstacles_fixed_step_us", fixed_s * 1e6);
  figure("obstacles_moving_step_us", moving_s * 1e6);
  figure("obstacles_moving_ratio", moving_s / fixed_s);
}

}  // namespace sim::bench
