// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "figures.h"
#include "realtime.h"
#include "sim/simulation/simulation.h"

namespace sim::bench {

// Adds 100 traps and 20 timers to a world of the SyRoTek arena: rectangles, circles and polygons on
// the floor, and surroundings of robots and obstacles. Each sends a message when it acts.
inline void add_controller(WorldDescription& world) {
  const auto name = [](const char* prefix, int i) {
    return std::string(prefix).append(std::to_string(i));
  };
  for (int i = 0; i < 100; ++i) {
    TrapDescription trap;
    trap.name = name("trap", i);
    const Vec2 p(0.25 + 0.32 * (i % 10), 0.3 + 0.34 * (i / 10));
    const auto at = static_cast<std::size_t>(i);
    if (i % 5 == 0) {
      trap.region = BoxRegion{p, {0.2, 0.1}, 0.1 * i};
    } else if (i % 5 == 1) {
      trap.region = CircleRegion{p, 0.1};
    } else if (i % 5 == 2) {
      trap.region = PolygonRegion{{p, p + Vec2(0.2, 0.0), p + Vec2(0.1, 0.1), p + Vec2(0.0, 0.2)}};
    } else if (i % 5 == 3) {
      trap.region = NearRegion{world.robots[at % world.robots.size()].name, 0.25};
    } else {
      trap.region = NearRegion{world.arena.obstacles[at % world.arena.obstacles.size()].name, 0.3};
    }
    trap.on = i % 3 == 0   ? TrapDescription::On::kStay
              : i % 3 == 1 ? TrapDescription::On::kLeave
                           : TrapDescription::On::kEnter;
    trap.stay_s = i % 3 == 0 ? 0.5 : 0.0;
    trap.actions.push_back(MessageAction{"sprung"});
    world.controller.traps.push_back(trap);
  }
  for (int i = 0; i < 20; ++i) {
    TimerDescription timer;
    timer.name = name("timer", i);
    timer.every_s = 1.0 + 0.3 * i;
    timer.jitter_s = i % 2 == 0 ? 0.2 : 0.0;
    timer.actions.push_back(MessageAction{"time"});
    world.controller.timers.push_back(timer);
  }
}

// The cost of a step of 13 robots without and with such a controller.
inline void controller_figures() {
  const WorldDescription plain_world = endless(kThirteen);
  WorldDescription world = plain_world;
  add_controller(world);
  const auto [plain_s, controlled_s] = step_times_s(plain_world, world, 1000);
  figure("controller_step_us", controlled_s * 1e6);
  figure("controller_us", (controlled_s - plain_s) * 1e6);
  figure("controller_overhead_ratio", controlled_s / plain_s);
}

}  // namespace sim::bench
