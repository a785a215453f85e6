// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <cstddef>
#include <cstdio>
#include <iostream>

#include "commands.h"
#include "playerlike/messages/messages.h"
#include "playerlike/messages/snd_settings.h"
#include "sim/core/error.h"
#include "sim/simulation/simulation.h"

namespace playpen {
namespace {

std::string counted(std::size_t count, const std::string& one, const std::string& many) {
  return std::to_string(count) + " " + (count == 1 ? one : many);
}

/// "1 robot, 20 obstacles (6 retracted), 6 docks, 3.42 m x 3.72 m".
std::string describe(const sim::WorldDescription& world) {
  std::size_t retracted = 0;
  for (const sim::ObstacleDescription& obstacle : world.arena.obstacles) {
    if (obstacle.state == sim::ObstacleState::kRetracted) ++retracted;
  }
  std::string text = counted(world.robots.size(), "robot", "robots") + ", " +
                     counted(world.arena.obstacles.size(), "obstacle", "obstacles");
  if (retracted > 0) text += " (" + std::to_string(retracted) + " retracted)";
  if (!world.arena.docks.empty()) text += ", " + counted(world.arena.docks.size(), "dock", "docks");
  if (!world.arena.walls.empty()) {
    text += ", " + counted(world.arena.walls.size(), "wall outline", "wall outlines");
  }
  char size[64];
  std::snprintf(size, sizeof size, ", %.2f m x %.2f m", world.arena.size.x(), world.arena.size.y());
  return text + size;
}

}  // namespace

int check(const std::vector<std::string>& worlds) {
  int status = kOk;
  for (const std::string& world : worlds) {
    try {
      // First all that may throw, then the line.
      const sim::WorldDescription description = sim::load_world(find_world(world));
      playerlike::check_drivers(description);
      playerlike::check_interfaces(description);
      const sim::Simulation wired(description);  // what devices are wired to is looked up there
      const std::string what = describe(description);
      std::cout << world << ": ok (" << what << ")\n";
    } catch (const sim::ConfigError& error) {
      std::cerr << error.what() << '\n';
      status = kBadInput;
    }
  }
  return status;
}

}  // namespace playpen
