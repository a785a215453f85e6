// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "sim/simulation/simulation.h"

namespace playerlike {

/// Where a robot was to drive, and when.
struct Goal {
  int robot = 0;                           ///< index
  sim::Vec2 place = sim::Vec2::Zero();     ///< in W [m]
  double tolerance_m = 0.0;                ///< the robot has arrived when it is so near
  sim::SimTime set_ns = 0;                 ///< when the goal was set
  std::optional<sim::SimTime> reached_ns;  ///< when the robot first arrived
};

/// The goals of a run's robots: those of their waypoint devices, those that their motors drive to,
/// and those that client programs tell of (NoteGoalRequest). The newest kMostGoals are kept. A
/// robot's newest goal is the one that it can reach. Setting the same goal again, within 1 mm, is
/// no new goal.
/// Not thread-safe: guarded by the host's mutex.
class GoalBook {
 public:
  static constexpr std::size_t kMostGoals = 1024;

  /// A client says that a robot is to drive somewhere.
  void note(int robot, const sim::Vec2& place, double tolerance_m, sim::SimTime now_ns);
  /// Looks at the robots after a step.
  void observe(const sim::Simulation& simulation);
  /// Oldest first.
  [[nodiscard]] const std::vector<Goal>& goals() const noexcept { return goals_; }
  /// The same for pictures.
  [[nodiscard]] std::vector<sim::GoalMark> marks() const;

 private:
  struct Devices {
    std::vector<int> waypoints;
    int motion = -1;
  };
  [[nodiscard]] Goal* newest(int robot);

  std::vector<Goal> goals_;
  std::vector<Devices> devices_;  // by robot
  std::vector<int> newest_;       // by robot: index of its newest goal, -1: none
};

}  // namespace playerlike
