// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "host/mirror/ghost.h"

#include "sim/devices/motion.h"

namespace playerlike {
namespace {

sim::WorldDescription world_of_ghost(sim::WorldDescription world, std::size_t robot) {
  world.robots = {world.robots[robot]};
  world.robots.front().real.reset();
  world.controller = {};
  world.simulation.duration_ns.reset();
  // Nobody looks at its canvas.
  world.canvas.width = 1;
  world.canvas.height = 1;
  return world;
}

}  // namespace

Ghost::Ghost(const sim::WorldDescription& world, std::size_t robot)
    : simulation_(world_of_ghost(world, robot)) {
  for (int i = 0; i < simulation_.device_count(0); ++i) {
    const sim::Device& device = simulation_.device(0, i);
    if (device.sensor() != nullptr && !device.pose_estimate()) {
      simulation_.set_active({0, i}, false);
    }
  }
}

bool Ghost::place(const sim::Pose& X_WB) {
  return !simulation_.place_object(simulation_.world().robots.front().name, X_WB);
}

void Ghost::apply(int device, const sim::Command& command) {
  // The ghost executes what it can. A refusal concerns the real robot, which reports it.
  if (simulation_.active({0, device})) static_cast<void>(simulation_.apply({0, device}, command));
}

void Ghost::stop() {
  for (int i = 0; i < simulation_.device_count(0); ++i) {
    if (simulation_.device(0, i).type() == "motion") apply(i, sim::TwistCommand{});
  }
}

void Ghost::step(const sim::WorldDescription& world) {
  const auto& now = world.arena.obstacles;
  for (std::size_t i = 0; i < now.size(); ++i) {
    const sim::ObstacleDescription& own = simulation_.world().arena.obstacles[i];
    if (own.state == now[i].state) continue;
    // Refused while the ghost stands there; the next step tries again.
    static_cast<void>(simulation_.set_obstacle_state(own.name, now[i].state));
  }
  simulation_.step();
}

sim::RobotSnapshot Ghost::snapshot() const {
  sim::RobotSnapshot shot = simulation_.robot_snapshot(0);
  shot.name += "_ghost";
  return shot;
}

}  // namespace playerlike
