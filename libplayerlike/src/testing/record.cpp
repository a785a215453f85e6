// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "testing/record.h"

#include <cmath>
#include <utility>

#include "sim/core/math.h"
#include "testing/clearance.h"

namespace playpen::testing {

Record::Record(const sim::Simulation& simulation, std::vector<GoalState> all_goals)
    : paths(static_cast<std::size_t>(simulation.robot_count())), goals(std::move(all_goals)) {
  for (int robot = 0; robot < simulation.robot_count(); ++robot) {
    path_lengths_m.push_back(simulation.statistics(robot).path_length_m);
    collision_counts.push_back(simulation.statistics(robot).collisions);
    add_sample(simulation, robot);
  }
}

void Record::add_sample(const sim::Simulation& simulation, int robot) {
  const sim::BodyState& body = simulation.body(robot);
  const NearestSolid nearest = nearest_solid(simulation, robot);
  paths[static_cast<std::size_t>(robot)].push_back(
      {sim::to_seconds(simulation.now_ns()),
       {body.X_WB.x_m, body.X_WB.y_m, body.X_WB.yaw_rad},
       sim::math::hypot(body.twist.v_mps, body.twist.lateral_mps),
       nearest.distance_m,
       nearest.solid});
  for (GoalState& goal : goals) {
    if (goal.robot != robot || goal.reached) continue;
    goal.reached = sim::math::hypot(body.X_WB.x_m - goal.point.x_m,
                                    body.X_WB.y_m - goal.point.y_m) <= goal.tolerance_m;
  }
}

void Record::observe(const sim::Simulation& simulation) {
  for (int robot = 0; robot < simulation.robot_count(); ++robot) {
    const auto index = static_cast<std::size_t>(robot);
    add_sample(simulation, robot);
    const int count = simulation.statistics(robot).collisions;
    if (count == std::exchange(collision_counts[index], count)) continue;
    paths[index].back().clearance_m = 0.0;
    const auto& all = simulation.collisions();
    for (auto found = all.rbegin(); found != all.rend(); ++found) {
      if (found->time_ns != simulation.now_ns()) break;
      if (found->robot != robot) continue;
      collisions.push_back({sim::to_seconds(found->time_ns),
                            simulation.world().robots[index].name,
                            found->partner,
                            {found->place.x(), found->place.y()}});
    }
  }
}

}  // namespace playpen::testing
