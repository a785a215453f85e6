// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// A Pioneer with the drivers wavefront and snd goes to ten random goals of the office, for each of
// several seeds.
//
// To run a single seed: WAVEFRONT_SEED=3 wavefront_office_test
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <iostream>
#include <string>
#include <vector>

#include "drivers/distance_wave.h"
#include "libCCMorse/CCMorse.h"
#include "patient_host.h"
#include "playerlike/messages/messages.h"
#include "sim/core/random_stream.h"
#include "sim/simulation/simulation.h"

namespace {

using sim::Vec2;

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr int kSeeds = 1;
#else
constexpr int kSeeds = 10;
#endif
constexpr int kGoals = 10;
constexpr double kTolerance_m = 0.3;
// Longer than any path of the office takes at half speed.
constexpr double kLimit_s = 300.0;

sim::WorldDescription office() {
  return sim::load_world(std::string(PLAYPEN_SOURCE_DIR) + "/worlds/examples/wavefront.json");
}

// Random goals that the robot can reach, at least 3 m from one another.
std::vector<Vec2> goals_of(const sim::WorldDescription& world, int seed) {
  playerlike::WavefrontSettings settings;
  settings.robot_radius_m = 0.29;
  settings.safety_dist_m = 0.2;
  const playerlike::DistanceWave wave(
      sim::true_map(world.arena, playerlike::map_grid(world.arena, 0.05)), settings);
  sim::RandomStream random(static_cast<std::uint64_t>(seed), "wavefront");
  std::vector<Vec2> goals;
  Vec2 from = world.robots[0].pose.position();
  while (goals.size() < kGoals) {
    const double x_m = world.arena.origin.x() + random.uniform() * world.arena.size.x();
    const double y_m = world.arena.origin.y() + random.uniform() * world.arena.size.y();
    const Vec2 goal(x_m, y_m);
    if ((goal - from).norm() < 3.0 || !wave.plan(from, goal)) continue;
    goals.push_back(goal);
    from = goal;
  }
  return goals;
}

TEST(WavefrontOffice, APioneerReachesTenGoalsOfEachSeedWithoutACollision) {
  const char* const only = std::getenv("WAVEFRONT_SEED");
  const int first = only == nullptr ? 0 : std::atoi(only);
  const int end = only == nullptr ? kSeeds : first + 1;
  for (int seed = first; seed < end; ++seed) {
    sim::WorldDescription world = office();
    world.simulation.seed = static_cast<std::uint64_t>(seed);
    const std::vector<Vec2> goals = goals_of(world, seed);
    const auto host = test::patient_host(world);
    PlayerCc::PlayerClient client(host->connect(6665));
    PlayerCc::PlannerProxy planner(&client, 0);
    client.Read();
    double driven_m = 0.0;
    for (int g = 0; g < kGoals; ++g) {
      const Vec2& goal = goals[static_cast<std::size_t>(g)];
      planner.SetGoalPose(goal.x(), goal.y(), 0.0);
      const double start_s = CCMorse::MorseTime(client).Now();
      while (planner.GetPathDone() == 0 && CCMorse::MorseTime(client).Now() - start_s < kLimit_s) {
        client.Read();
      }
      EXPECT_EQ(planner.GetPathDone(), 1U)
          << "seed " << seed << ", goal " << g << " at " << goal.transpose() << ", robot at "
          << planner.GetPx() << ", " << planner.GetPy();
      EXPECT_LE(std::hypot(planner.GetPx() - goal.x(), planner.GetPy() - goal.y()),
                kTolerance_m + 0.02)
          << "seed " << seed << ", goal " << g;
      planner.RequestWaypoints();
    }
    driven_m = host->statistics(0).path_length_m;
    EXPECT_EQ(host->statistics(0).collisions, 0) << "seed " << seed;
    std::cout << "seed " << seed << ": " << driven_m << " m in " << CCMorse::MorseTime(client).Now()
              << " s, least clearance " << host->statistics(0).least_clearance_m << " m\n";
  }
}

}  // namespace
