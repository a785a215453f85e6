// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <chrono>
#include <ctime>
#include <utility>

#include "figures.h"
#include "sim/devices/laser.h"
#include "sim/devices/motion.h"
#include "sim/simulation/simulation.h"

namespace sim::bench {

inline constexpr const char* kThirteen = PLAYPEN_SOURCE_DIR "/worlds/examples/thirteen_robots.json";
inline constexpr const char* kOne = PLAYPEN_SOURCE_DIR "/worlds/syrotek.json";

[[nodiscard]] inline WorldDescription endless(const char* file) {
  WorldDescription world = load_world(file);
  world.simulation.duration_ns.reset();
  return world;
}

// Makes the robots wander: they turn away from what the laser sees ahead, otherwise drive on.
inline void wander(Simulation& simulation) {
  for (int r = 0; r < simulation.robot_count(); ++r) {
    const int laser = simulation.find_device(r, "laser").value();
    const auto& scan = dynamic_cast<const LaserReading&>(
        dynamic_cast<const Sensor&>(simulation.device(r, laser)).reading());
    const bool blocked = scan.sequence > 0 && scan.least_range_m() < 0.25;
    const Twist twist = blocked ? Twist{0.0, scan.least_angle_rad() > 0.0 ? -1.5 : 1.5, 0.0}
                                : Twist{0.3, 0.1 * (r % 13 - 6), 0.0};
    simulation.apply({r, simulation.find_device(r, "motion").value()}, TwistCommand{twist});
  }
}

// Simulated seconds per second of processor time, with commands every tenth of a second; the best
// of five rounds.
[[nodiscard]] inline double realtime_factor(const char* file, double simulated_s) {
  Simulation simulation(endless(file));
  const auto steps = static_cast<int>(simulated_s * 100.0);
  double best_s = 1e30;
  for (int round = 0; round < 5; ++round) {
    const std::clock_t begin = std::clock();
    for (int i = 0; i < steps; ++i) {
      if (i % 10 == 0) wander(simulation);
      simulation.step();
    }
    best_s = std::min(best_s, static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
  }
  return simulated_s / best_s;
}

// Seconds that a step of each of two worlds takes while robots wander: the best of nine rounds. The
// worlds take turns, so that a slow moment of the machine affects both.
// @param tens  steps per round, in tens.
[[nodiscard]] inline std::pair<double, double> step_times_s(const WorldDescription& first,
                                                            const WorldDescription& second,
                                                            int tens) {
  using Seconds = std::chrono::duration<double>;
  const auto timed = [](Simulation& simulation) {
    wander(simulation);
    const auto begin = std::chrono::steady_clock::now();
    for (int i = 0; i < 10; ++i) simulation.step();
    return std::chrono::steady_clock::now() - begin;
  };
  std::pair best_s(1e30, 1e30);
  for (int round = 0; round < 9; ++round) {
    Simulation a(first);
    Simulation b(second);
    Seconds a_time{};
    Seconds b_time{};
    for (int k = 0; k < tens; ++k) {
      a_time += timed(a);
      b_time += timed(b);
    }
    best_s.first = std::min(best_s.first, a_time.count() / (10.0 * tens));
    best_s.second = std::min(best_s.second, b_time.count() / (10.0 * tens));
  }
  return best_s;
}

inline void print_realtime_factors() {
  figure("realtime_factor_1_robot", realtime_factor(kOne, 600.0));
  figure("realtime_factor_13_robots", realtime_factor(kThirteen, 60.0));
}

}  // namespace sim::bench
