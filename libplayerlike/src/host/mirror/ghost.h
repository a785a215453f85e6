// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "sim/simulation/simulation.h"

namespace playerlike {

/// A simulated copy of a robot that mirrors a real one. It gets the same commands and shows where
/// the model expects the real robot.
///
/// The ghost has a simulation of its own: the world's arena with this robot alone. So it collides
/// with the arena, but no other robot sees or pushes it. Its sensors are off, except those that
/// estimate its pose. Obstacles that are extended or retracted follow the world. Not thread-safe.
class Ghost {
 public:
  /// @param robot  index in the world.
  Ghost(const sim::WorldDescription& world, std::size_t robot);

  /// Puts the ghost at a pose, at rest. @return false: an obstacle is in the way.
  bool place(const sim::Pose& X_WB);
  /// Executes a command for one of the robot's devices, by index.
  void apply(int device, const sim::Command& command);
  /// Stops the motors.
  void stop();
  /// Advances by a step of the world. @param world  in its present state.
  void step(const sim::WorldDescription& world);

  [[nodiscard]] const sim::Pose& pose() const { return simulation_.body(0).X_WB; }
  /// What pictures show of it.
  [[nodiscard]] sim::RobotSnapshot snapshot() const;

 private:
  sim::Simulation simulation_;
};

}  // namespace playerlike
