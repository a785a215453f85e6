// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "sim/simulation/simulation.h"

namespace playerlike {

/// A goal of a robot, with its times.
struct Goal {
  int robot = 0;                           ///< index
  sim::Vec2 place = sim::Vec2::Zero();     ///< in W [m]
  double tolerance_m = 0.0;                ///< distance within which the goal is reached [m]
  sim::SimTime set_ns = 0;                 ///< when the goal was set
  std::optional<sim::SimTime> reached_ns;  ///< when the robot first reached the goal
};

/// Records the goals of a run's robots: goals of waypoint devices, position goals of motors, and
/// goals that clients announce (NoteGoalRequest). It keeps the newest kMostGoals goals. Only the
/// newest goal of a robot can be reached. A goal within 1 mm of the robot's newest goal is not
/// recorded again.
/// Not thread-safe: guarded by the host's mutex.
class GoalBook {
 public:
  static constexpr std::size_t kMostGoals = 1024;

  /// Records a goal that a client announces.
  void note(int robot, const sim::Vec2& place, double tolerance_m, sim::SimTime now_ns);
  /// Updates the goals after a step.
  void observe(const sim::Simulation& simulation);
  /// Returns the goals, oldest first.
  [[nodiscard]] const std::vector<Goal>& goals() const noexcept { return goals_; }
  /// Returns the goals as marks for pictures.
  [[nodiscard]] std::vector<sim::GoalMark> marks() const;

 private:
  struct Devices {
    std::vector<int> waypoints;
    int motion = -1;
  };
  [[nodiscard]] Goal* newest(int robot);

  std::vector<Goal> goals_;
  std::vector<Devices> devices_;  // by robot
  std::vector<int> newest_;       // by robot: index of the newest goal; -1: none
};

}  // namespace playerlike
