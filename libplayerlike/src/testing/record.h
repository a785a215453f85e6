// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "playerlike/testing/run.h"
#include "sim/simulation/simulation.h"

namespace playpen::testing {

/// A goal of World::Goal() in a run.
struct GoalState {
  int robot = 0;  ///< index
  Point point;
  double tolerance_m = 0.0;
  bool reached = false;
};

/// What a run has recorded of its robots. Not thread-safe: guarded by the host's mutex.
struct Record {
  /// Begins a record at the present.
  Record(const sim::Simulation& simulation, std::vector<GoalState> all_goals);
  /// Records a step.
  void observe(const sim::Simulation& simulation);

  std::vector<std::vector<Sample>> paths;  ///< by robot; each begins with the start
  std::vector<double> path_lengths_m;      ///< at the start
  std::vector<int> collision_counts;       ///< up to now, those before the start included
  std::vector<Collision> collisions;
  std::vector<GoalState> goals;

 private:
  void add_sample(const sim::Simulation& simulation, int robot);
};

}  // namespace playpen::testing
