// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// World files: any content is either read or refused with an error; a world that is read can be
// built and stepped.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>
#include <utility>

#include "sim/core/error.h"
#include "sim/simulation/simulation.h"

namespace {

// Larger worlds are read but not built, because each input must take only milliseconds.
constexpr std::size_t kMostRobots = 4;
constexpr std::size_t kMostDevices = 12;  // per robot
constexpr std::size_t kMostObstacles = 60;
constexpr std::size_t kMostWalls = 200;  // vertices
constexpr int kMostCanvasSide = 512;
constexpr int kSteps = 6;

bool is_small(const sim::WorldDescription& world) {
  if (world.robots.size() > kMostRobots || world.arena.obstacles.size() > kMostObstacles ||
      world.arena.dock_separators.size() > kMostObstacles || world.canvas.width > kMostCanvasSide ||
      world.canvas.height > kMostCanvasSide) {
    return false;
  }
  std::size_t vertices = 0;
  for (const sim::WallLoop& loop : world.arena.walls) vertices += loop.vertices.size();
  for (const sim::RobotDescription& robot : world.robots) {
    if (robot.devices.size() > kMostDevices) return false;
  }
  return vertices <= kMostWalls;
}

// Robots drive, so that they touch obstacles and the devices have something to measure.
void drive(sim::WorldDescription world) {
  sim::Simulation simulation(std::move(world));
  for (int robot = 0; robot < simulation.robot_count(); ++robot) {
    if (const auto motion = simulation.find_device(robot, "motion")) {
      static_cast<void>(simulation.apply({robot, *motion},
                                         sim::TwistCommand{{.v_mps = 0.5, .omega_radps = 1.0}}));
    }
  }
  for (int step = 0; step < kSteps; ++step) simulation.step();
  static_cast<void>(simulation.state_hash());
  simulation.reset();
  simulation.step();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  try {
    sim::WorldDescription world = sim::load_world_text(text, "<memory>");
    if (is_small(world)) drive(std::move(world));
  } catch (const sim::ConfigError& e) {
    if (e.issues().empty() || e.issues().front().id.empty()) std::abort();
  }
  return 0;
}
