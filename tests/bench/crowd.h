// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <ctime>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "figures.h"
#include "io/check_world.h"
#include "realtime.h"
#include "sim/world/robot_model.h"

namespace sim::bench {

// The k-th number of van der Corput's sequence in a base, in 0 to 1: any number of them is evenly
// distributed. In two bases without a common factor they are Halton's points of the plane (Halton,
// On the efficiency of certain quasi-random sequences of points, Numer. Math. 2, 84, 1960).
[[nodiscard]] inline double van_der_corput(int k, int base) {
  double value = 0.0;
  for (double digit = 1.0 / base; k > 0; k /= base, digit /= base) value += digit * (k % base);
  return value;
}

// A world with the given number of robots: the first of those that the world has, then copies of
// the last one, spread evenly over the floor. They keep only devices of `types`, or all if it is
// empty.
[[nodiscard]] inline WorldDescription crowd_of(WorldDescription world, int robots,
                                               const std::vector<std::string>& types) {
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
  std::vector<Pose> poses;
  for (const RobotDescription& robot : world.robots) poses.push_back(robot.pose);
  const ArenaDescription& arena = world.arena;
  constexpr int kMostTries = 100'000;
  int tries = 0;
  for (int i = static_cast<int>(world.robots.size()); i < robots; ++i) {
    copy.name = "crowd" + std::to_string(i);
    copy.port = 20'000 + i;
    world.robots.push_back(copy);
    poses.emplace_back();
    do {
      if (++tries > kMostTries) {
        throw std::runtime_error("only " + std::to_string(i) + " robots have a place");
      }
      poses.back() = {arena.origin.x() + arena.size.x() * van_der_corput(tries, 2),
                      arena.origin.y() + arena.size.y() * van_der_corput(tries, 3),
                      2.0 * std::numbers::pi * van_der_corput(tries, 5)};
    } while (io::blocked_by(world, poses, world.robots.size() - 1, poses.back()));
    world.robots.back().pose = poses.back();
  }
  return world;
}

// The same for a world file.
[[nodiscard]] inline WorldDescription crowded(const char* file, int robots,
                                              const std::vector<std::string>& types) {
  return crowd_of(endless(file), robots, types);
}

// Processor time of a step per robot [us], while the robots wander for 25 s after the first 5 s.
// Each round has the same number of robot steps, whatever the number of robots, and the median of
// the rounds counts. So other processes matter little, and equally for few and many robots.
[[nodiscard]] inline double robot_step_us(const WorldDescription& world) {
  constexpr int kWarmUpSteps = 500;
  constexpr int kSteps = 2500;
  constexpr int kRobotStepsPerRound = 5000;
  constexpr std::size_t kLeastRounds = 50;
  const int robots = static_cast<int>(world.robots.size());
  // Lasers measure every tenth step: each round has the same number of scans.
  const int round = std::clamp(kRobotStepsPerRound / robots / 10 * 10, 10, kSteps);
  std::vector<double> rounds_us;
  while (rounds_us.size() < kLeastRounds) {
    Simulation simulation(world);
    const auto go = [&simulation](int steps) {
      for (int i = 0; i < steps; ++i) {
        if (i % 10 == 0) wander(simulation);
        simulation.step();
      }
    };
    go(kWarmUpSteps);
    for (int i = 0; i + round <= kSteps; i += round) {
      const std::clock_t begin = std::clock();
      go(round);
      const double used_s = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
      rounds_us.push_back(used_s * 1e6 / (round * robots));
    }
  }
  const auto median = rounds_us.begin() + static_cast<std::ptrdiff_t>(rounds_us.size() / 2);
  std::nth_element(rounds_us.begin(), median, rounds_us.end());
  return *median;
}

// Prints the cost per robot for different numbers of robots.
inline void print_crowd(const char* file, const std::vector<int>& counts,
                        const std::vector<std::string>& types) {
  for (const int count : counts) {
    figure(("robot_step_us_of_" + std::to_string(count)).c_str(),
           robot_step_us(crowded(file, count, types)));
  }
}

}  // namespace sim::bench
