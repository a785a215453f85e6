// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// A Pioneer with the drivers wavefront and snd goes to ten random goals of the office, for each of
// several seeds (2 per merge, 10 in nightly runs): with its true pose, and with the pose that amcl
// finds from a noisy laser and noisy odometry.
//
// To run a single seed: WAVEFRONT_SEED=3 wavefront_office_test
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <string>
#include <vector>

#include "drivers/distance_wave.h"
#include "libCCMorse/CCMorse.h"
#include "nightly.h"
#include "patient_host.h"
#include "playerlike/messages/messages.h"
#include "sim/core/random_stream.h"
#include "sim/simulation/simulation.h"

namespace {

using sim::Vec2;

constexpr int kGoals = 10;
constexpr double kTolerance_m = 0.3;  // of both worlds
// Longer than any path of the office takes at half speed.
constexpr double kLimit_s = 300.0;

sim::WorldDescription office(const std::string& name) {
  return sim::load_world(std::string(PLAYPEN_SOURCE_DIR) + "/worlds/examples/" + name);
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

// Drives to ten goals and checks where the robot has stopped.
// @param measured  index of the position2d that gives the true pose.
// @param error_m   how far the planner's pose may be from the true one.
void expect_ten_goals(const std::string& name, int seed, uint32_t measured, double error_m) {
  sim::WorldDescription world = office(name);
  world.simulation.seed = static_cast<std::uint64_t>(seed);
  const std::vector<Vec2> goals = goals_of(world, seed);
  const auto host = test::patient_host(world);
  PlayerCc::PlayerClient client(host->connect(6665));
  PlayerCc::PlannerProxy planner(&client, 0);
  PlayerCc::Position2dProxy position(&client, measured);
  client.Read();
  double largest_error_m = 0.0;
  for (int g = 0; g < kGoals; ++g) {
    const Vec2& goal = goals[static_cast<std::size_t>(g)];
    planner.SetGoalPose(goal.x(), goal.y(), 0.0);
    const double start_s = CCMorse::MorseTime(client).Now();
    while (planner.GetPathDone() == 0 && CCMorse::MorseTime(client).Now() - start_s < kLimit_s) {
      client.Read();
      if (planner.GetPathValid() == 0) continue;  // it may not know its pose yet
      largest_error_m = std::max(largest_error_m, std::hypot(planner.GetPx() - position.GetXPos(),
                                                             planner.GetPy() - position.GetYPos()));
    }
    EXPECT_EQ(planner.GetPathDone(), 1U)
        << name << ", seed " << seed << ", goal " << g << " at " << goal.transpose()
        << ", robot at " << position.GetXPos() << ", " << position.GetYPos();
    EXPECT_LE(std::hypot(position.GetXPos() - goal.x(), position.GetYPos() - goal.y()),
              kTolerance_m + 0.02 + error_m)
        << name << ", seed " << seed << ", goal " << g;
    planner.RequestWaypoints();
  }
  EXPECT_EQ(host->statistics(0).collisions, 0) << name << ", seed " << seed;
  EXPECT_LE(largest_error_m, error_m + 0.1) << name << ", seed " << seed;
  std::cout << "seed " << seed << ": " << host->statistics(0).path_length_m << " m in "
            << CCMorse::MorseTime(client).Now() << " s, least clearance "
            << host->statistics(0).least_clearance_m << " m, largest error of the pose "
            << largest_error_m << " m\n";
}

void expect_ten_goals_of_each_seed(const std::string& name, uint32_t measured, double error_m) {
  const char* const only = std::getenv("WAVEFRONT_SEED");
  const int first = only == nullptr ? 0 : std::atoi(only);
  const int end = only == nullptr ? test_support::cases(2, 10) : first + 1;
  for (int seed = first; seed < end; ++seed) expect_ten_goals(name, seed, measured, error_m);
}

TEST(WavefrontOffice, Pioneer_ReachesTenGoalsPerSeedWithoutCollision) {
  expect_ten_goals_of_each_seed("wavefront.json", 0, 0.0);
}

// amcl and SND have the same noisy odometry and laser; the robot starts at a known pose.
TEST(WavefrontOffice, SelfLocalisingPioneer_ReachesTenGoalsPerSeedWithoutCollision) {
  expect_ten_goals_of_each_seed("wavefront_amcl.json", 1, 0.2);
}

}  // namespace
