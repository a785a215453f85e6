// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "simulation/simulation_impl.h"

namespace sim {

/// The objects that robots carry.
class Simulation::Impl::Loads {
 public:
  explicit Loads(Impl& owner) : impl_(owner) {}

  /// @return why it cannot.
  std::optional<std::string> pick_up(std::size_t robot, int index);
  void carry_at(std::size_t robot, int index, const Pose& X_BT, bool inside);
  /// @return why it cannot.
  std::optional<std::string> put_down(std::size_t robot, int index);
  /// The obstacle stands in the pose of its description again; the caller must update the physics.
  void detach(int index);
  /// Moves the obstacles with the robots. Must be called after robots have moved.
  void follow_robots();
  /// Updates what the sensors of others see of a robot's load.
  void update_outlines(std::size_t robot);
  /// Nobody carries anything.
  void reset() { loads_.clear(); }
  void archive(StateArchive& archive);

 private:
  struct Load {
    std::size_t robot;
    int obstacle;
    Pose X_BT;    // pose of the object in B
    bool inside;  // inside the robot, where no sensor sees it
  };

  [[nodiscard]] const Pose& body_pose(std::size_t robot) const {
    return impl_.physics->body(static_cast<int>(robot)).X_WB;
  }

  Impl& impl_;
  std::vector<Load> loads_;
};

}  // namespace sim
