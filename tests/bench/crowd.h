// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <ctime>
#include <stdexcept>
#include <string>
#include <vector>

#include "figures.h"
#include "io/check_world.h"
#include "realtime.h"
#include "sim/world/robot_model.h"

namespace sim::bench {

// A world with so many robots: the first of those that it names, then copies of the last one at
// free places. Of their devices only those of `types`, if there are any.
[[nodiscard]] inline WorldDescription crowded(const char* file, int robots,
                                              const std::vector<std::string>& types) {
  WorldDescription world = endless(file);
  if (world.robots.empty()) throw std::runtime_error("the world has no robot to copy");
  for (RobotDescription& robot : world.robots) {
    if (types.empty()) break;
    robot.interfaces.clear();
    std::erase_if(robot.devices, [&](const DeviceDescription& device) {
      return std::find(types.begin(), types.end(), device.type) == types.end();
    });
  }
  RobotDescription copy = world.robots.back();
  if (world.robots.size() > static_cast<std::size_t>(robots)) {
    world.robots.resize(static_cast<std::size_t>(robots));
  }
  const Polygon& footprint = find_robot_model(world, copy.model)->footprint;
  std::size_t places_tried = 0;
  for (int i = static_cast<int>(world.robots.size()); i < robots; ++i) {
    const auto pose = io::find_free_pose(world, footprint, places_tried);
    if (!pose) throw std::runtime_error("only " + std::to_string(i) + " robots have a place");
    copy.name = "crowd" + std::to_string(i);
    copy.port = 20'000 + i;
    copy.pose = *pose;
    world.robots.push_back(copy);
  }
  return world;
}

// Processor time of a step for each robot [us], wandering; the least of five rounds of 5 s.
[[nodiscard]] inline double robot_step_us(const WorldDescription& world) {
  Simulation simulation(world);
  constexpr int kSteps = 500;
  double best_s = 1e30;
  for (int round = 0; round < 5; ++round) {
    const std::clock_t begin = std::clock();
    for (int i = 0; i < kSteps; ++i) {
      if (i % 10 == 0) wander(simulation);
      simulation.step();
    }
    best_s = std::min(best_s, static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
  }
  return best_s * 1e6 / (kSteps * simulation.robot_count());
}

// How the cost of a robot grows with the number of them.
inline void print_crowd(const char* file, const std::vector<int>& counts,
                        const std::vector<std::string>& types) {
  for (const int count : counts) {
    figure(("robot_step_us_of_" + std::to_string(count)).c_str(),
           robot_step_us(crowded(file, count, types)));
  }
}

}  // namespace sim::bench
