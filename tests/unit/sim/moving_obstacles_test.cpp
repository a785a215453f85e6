// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// How obstacles move in a world: paths, random walks, pedestrians, orders, events and state.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "circle_range.h"
#include "sim/devices/laser.h"
#include "sim/render/render.h"
#include "sim/simulation/simulation.h"
#include "sim/simulation/world_hash.h"
#include "simulation/social_force.h"
#include "simulation_runs.h"

namespace sim {
namespace {

using test::drive;
using test::events_of;
using test::run;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

constexpr double kPi = std::numbers::pi;

// A room of 6 x 6 m with one obstacle "o", round, at (1, 1), and a robot in a corner.
WorldDescription room(const std::string& settings, const std::string& more = "",
                      const std::string& more_obstacles = "") {
  return load_world_text(R"({"arena": {"size": [6, 6], "obstacles": [
      {"name": "o", "shape": "circle", "radius": 0.1, "center": [1, 1], )" +
                         settings + "}" + more_obstacles +
                         R"(]}, "robots": [{"name": "r1", "pose": {"x": 5.5, "y": 5.5}}])" + more +
                         "}");
}

std::string path(const std::string& settings) {
  return R"("motion": {"type": "path", )" + settings + "}";
}

const ObstacleDescription& obstacle(const Simulation& simulation, std::size_t index = 0) {
  return simulation.world().arena.obstacles.at(index);
}

Vec2 place_after(const std::string& settings, double duration_s) {
  Simulation simulation(room(settings));
  run(simulation, duration_s);
  return obstacle(simulation).center;
}

void expect_near(const Vec2& found, const Vec2& expected) {
  EXPECT_NEAR(found.x(), expected.x(), 1e-9);
  EXPECT_NEAR(found.y(), expected.y(), 1e-9);
}

// --- paths

TEST(ObstaclePath, Once_VisitsEachPoint) {
  // 1 m each at 0.5 m/s.
  const std::string settings = path(R"("speed": 0.5, "points": [[2, 1], [2, 2]])");
  expect_near(place_after(settings, 0.0), {1, 1});
  expect_near(place_after(settings, 1.0), {1.5, 1});
  expect_near(place_after(settings, 2.0), {2, 1});
  expect_near(place_after(settings, 3.0), {2, 1.5});
  expect_near(place_after(settings, 9.0), {2, 2});
  Simulation simulation(room(settings));
  run(simulation, 5.0);
  EXPECT_THAT(events_of(simulation), ElementsAre("4.00 obstacle o is at the end of its path"));
}

TEST(ObstaclePath, BackAndForth_Repeats) {
  const std::string settings =
      path(R"("speed": 0.5, "repeat": "back_and_forth", "points": [[2, 1], [2, 2]])");
  expect_near(place_after(settings, 4.0), {2, 2});
  expect_near(place_after(settings, 5.0), {2, 1.5});
  expect_near(place_after(settings, 7.0), {1.5, 1});
  expect_near(place_after(settings, 8.0), {1, 1});
  expect_near(place_after(settings, 9.0), {1.5, 1});
}

TEST(ObstaclePath, Loop_Repeats) {
  // The diagonal back to the start takes sqrt(2) / 0.5 s = 2.83 s, in whole steps.
  const std::string settings =
      path(R"("speed": 0.5, "repeat": "round", "points": [[2, 1], [2, 2]])");
  const double diagonal = std::sqrt(0.5);
  expect_near(place_after(settings, 5.0), {2.0 - 0.5 * diagonal, 2.0 - 0.5 * diagonal});
  expect_near(place_after(settings, 6.83), {1, 1});
  expect_near(place_after(settings, 7.83), {1.5, 1});
}

TEST(ObstaclePath, Waits_AtEachPoint) {
  const std::string settings = path(R"("speed": 0.5, "wait": 1, "points": [[2, 1], [2, 2]])");
  expect_near(place_after(settings, 2.9), {2, 1});
  expect_near(place_after(settings, 4.0), {2, 1.5});
}

TEST(ObstaclePath, FacesPathIfRequested) {
  // It turns 90 degrees at 90 degrees/s before the second leg.
  const std::string settings =
      path(R"("speed": 0.5, "facing": "forward", "turn_rate_deg": 90, "points": [[2, 1], [2, 2]])");
  Simulation simulation(room(settings));
  run(simulation, 2.5);
  EXPECT_NEAR(obstacle(simulation).yaw_rad, 0.25 * kPi, 1e-9);
  expect_near(obstacle(simulation).center, {2, 1});
  run(simulation, 1.5);
  EXPECT_NEAR(obstacle(simulation).yaw_rad, 0.5 * kPi, 1e-9);
  expect_near(obstacle(simulation).center, {2, 1.5});
}

TEST(ObstaclePath, HighSpeed_FollowsExactly) {
  // 0.1 m per step, in many substeps of the physics.
  expect_near(place_after(path(R"("speed": 10, "points": [[5, 1], [5, 2]])"), 0.5), {5, 2});
}

TEST(ObstaclePath, Placed_ContinuesFromThere) {
  Simulation simulation(room(path(R"("speed": 0.5, "points": [[2, 1], [2, 2]])")));
  run(simulation, 1.0);
  ASSERT_FALSE(simulation.place_object("o", {2, 0.5, 0}));
  run(simulation, 1.0);
  expect_near(obstacle(simulation).center, {2, 1});
  EXPECT_THAT(simulation.place_object("o", {5.5, 5.5, 0}).value_or(""), HasSubstr("robot r1"));
}

TEST(ObstaclePath, Solid_Blocks) {
  Simulation simulation(room(path(R"("speed": 0.5, "points": [[3, 1]])"), "",
                             R"(, {"name": "wall", "center": [2, 1]})"));
  run(simulation, 4.0);
  // The block's side is at 1.9. It touches after 0.8 m, 1.6 s, and is stopped for 0.2 s then.
  EXPECT_NEAR(obstacle(simulation).center.x(), 1.8, 0.003);
  EXPECT_THAT(events_of(simulation), ElementsAre(HasSubstr("obstacle o is blocked by wall")));
}

TEST(ObstaclePath, PushedByRobot_Reported) {
  // An S1R of 2 kg pushes one of 0.2 kg sideways off its path.
  Simulation simulation(load_world_text(R"({"arena": {"size": [6, 6], "obstacles": [
      {"name": "o", "shape": "circle", "radius": 0.1, "center": [1, 1], "mass": 0.2,
       "motion": {"type": "path", "speed": 0.2, "repeat": "back_and_forth", "points": [[3, 1]]}}]},
      "robots": [{"name": "r1", "pose": {"x": 1.3, "y": 0.6, "yaw_deg": 90}}]})"));
  drive(simulation, 0.3);
  run(simulation, 4.0);
  EXPECT_THAT(events_of(simulation), Contains(HasSubstr("obstacle o is off its path by robot r1")));
}

TEST(ObstaclePath, SuspendedDynamics_Stands) {
  Simulation simulation(room(path(R"("speed": 0.5, "points": [[3, 1]])")));
  run(simulation, 1.0);
  ASSERT_FALSE(simulation.set_object_dynamics("o", false));
  run(simulation, 1.0);
  expect_near(obstacle(simulation).center, {1.5, 1});
  ASSERT_FALSE(simulation.set_object_dynamics("o", true));
  run(simulation, 1.0);
  expect_near(obstacle(simulation).center, {2, 1});
}

TEST(ObstaclePath, Reset_StartsAnew) {
  Simulation simulation(room(path(R"("speed": 0.5, "points": [[3, 1]])")));
  run(simulation, 3.0);
  simulation.reset();
  expect_near(obstacle(simulation).center, {1, 1});
  run(simulation, 1.0);
  expect_near(obstacle(simulation).center, {1.5, 1});
}

TEST(ObstaclePath, FollowingTrap_Springs) {
  // It comes within 0.5 m of the robot's centre after 3.5 m, 7 s.
  Simulation simulation(load_world_text(R"({"arena": {"size": [6, 4], "obstacles": [
      {"name": "o", "shape": "circle", "radius": 0.1, "center": [1, 1],
       "motion": {"type": "path", "speed": 0.5, "points": [[5.5, 1]]}}]},
      "robots": [{"name": "r1", "pose": {"x": 5, "y": 1.0001}}],
      "controller": {"traps": [{"name": "met", "near": {"object": "o", "distance": 0.5},
                                "do": [{"message": "hello"}]}]}})"));
  run(simulation, 7.2);
  EXPECT_THAT(events_of(simulation), Contains(HasSubstr("7.01 robot r1 springs trap met")));
}

// --- sensors

TEST(MovingObstacle, MovingCircle_MeasuredExactly) {
  Simulation simulation(load_world_text(R"({"arena": {"size": [6, 6], "obstacles": [
      {"name": "o", "shape": "circle", "radius": 0.4, "center": [3, 1],
       "motion": {"type": "path", "speed": 0.7, "points": [[3, 5]]}}]},
      "robots": [{"name": "r1", "pose": {"x": 1, "y": 2},
                  "devices": {"laser": {"noise": 0, "range_max": 6}}}]})"));
  const auto& laser =
      dynamic_cast<const Laser&>(simulation.device(0, simulation.find_device(0, "laser").value()));
  int met = 0;
  SimTime seen_ns = 0;
  for (int step = 0; step < 300; ++step) {
    simulation.step();
    const LaserReading& scan = laser.reading();
    if (scan.time_ns == seen_ns || scan.ranges_m.empty()) continue;
    seen_ns = scan.time_ns;
    ASSERT_EQ(seen_ns, simulation.now_ns());
    const Vec2 center(3.0, 1.0 + 0.7 * to_seconds(seen_ns));
    expect_near(obstacle(simulation).center, center);
    const Pose X_WL = scan.X_WB * laser.params().X_BL;
    for (std::size_t beam = 0; beam < scan.ranges_m.size(); ++beam) {
      const double angle_rad =
          X_WL.yaw_rad + scan.angle_min_rad + scan.resolution_rad * static_cast<double>(beam);
      const double expected_m = test::circle_range_m(X_WL.position(), angle_rad, center, 0.4, 6.0);
      if (expected_m == 6.0) continue;
      ++met;
      EXPECT_NEAR(scan.ranges_m[beam], expected_m, 1e-6);
    }
  }
  EXPECT_GT(met, 1000);
}

TEST(MovingObstacle, MovingBox_MeasuredWhereItIs) {
  Simulation simulation(load_world_text(R"({"arena": {"size": [6, 6], "obstacles": [
      {"name": "o", "center": [5, 2], "size": [0.4, 0.4],
       "motion": {"type": "path", "speed": 0.5, "points": [[2, 2]]}}]},
      "robots": [{"name": "r1", "pose": {"x": 1, "y": 2},
                  "devices": {"laser": {"noise": 0, "range_max": 6, "pose": {"x": 0}}}}]})"));
  const auto& laser =
      dynamic_cast<const Laser&>(simulation.device(0, simulation.find_device(0, "laser").value()));
  run(simulation, 2.0);
  const std::vector<double>& ranges = laser.reading().ranges_m;
  // The front side is at 5 - 0.2 - 0.5 t. The middle beams are 0.2 degrees off the axis.
  EXPECT_NEAR(ranges[ranges.size() / 2], 4.8 - 0.5 * to_seconds(laser.reading().time_ns) - 1.0,
              1e-4);
}

// --- random walks

TEST(RandomWalk, StaysInArea) {
  Simulation simulation(room(R"("motion": {"type": "random_walk", "speed": 0.5, "leg": 0.3,
      "area": {"center": [1.2, 1.2], "size": [1, 0.8]}})"));
  Vec2 low(6, 6);
  Vec2 high(0, 0);
  for (int i = 0; i < 20'000; ++i) {
    simulation.step();
    low = low.cwiseMin(obstacle(simulation).center);
    high = high.cwiseMax(obstacle(simulation).center);
  }
  // The whole circle stays in the area: its centre in [0.8, 1.6] x [0.9, 1.5]. It comes near all
  // sides.
  EXPECT_TRUE((low.array() >= Vec2(0.8, 0.9).array() - 1e-9).all()) << low.transpose();
  EXPECT_TRUE((high.array() <= Vec2(1.6, 1.5).array() + 1e-9).all()) << high.transpose();
  EXPECT_TRUE((low.array() < Vec2(0.85, 0.95).array()).all()) << low.transpose();
  EXPECT_TRUE((high.array() > Vec2(1.55, 1.45).array()).all()) << high.transpose();
}

TEST(RandomWalk, LegsHaveRandomLengthAndDirection) {
  // In a large room no leg is drawn again. Legs of 0.5 to 1.5 times 0.2 m.
  Simulation simulation(load_world_text(R"({"arena": {"size": [100, 100], "obstacles": [
      {"name": "o", "center": [50, 50], "motion": {"type": "random_walk", "speed": 1, "leg": 0.2}}]},
      "robots": []})"));
  std::vector<Vec2> legs;
  Vec2 corner = obstacle(simulation).center;
  Vec2 before = corner;
  std::optional<Vec2> way;
  for (int i = 0; i < 40'000; ++i) {
    simulation.step();
    const Vec2 now = obstacle(simulation).center;
    const Vec2 direction = (now - before).normalized();
    if (way && (direction - *way).norm() > 1e-6) {
      legs.emplace_back(before - corner);
      corner = before;
    }
    way = direction;
    before = now;
  }
  ASSERT_GT(legs.size(), 1500U);
  double sum_m = 0.0;
  double sum_cos = 0.0;
  for (const Vec2& leg : legs) {
    EXPECT_GE(leg.norm(), 0.1 - 1e-9);
    EXPECT_LE(leg.norm(), 0.3 + 1e-9);
    sum_m += leg.norm();
    sum_cos += leg.x() / leg.norm();
  }
  // Standard deviations: 0.2 / sqrt(12) of a length, sqrt(1 / 2) of a cosine.
  const auto n = static_cast<double>(legs.size());
  EXPECT_NEAR(sum_m / n, 0.2, 4.0 * 0.2 / std::sqrt(12.0 * n));
  EXPECT_NEAR(sum_cos / n, 0.0, 4.0 * std::sqrt(0.5 / n));
}

TEST(RandomWalk, FollowsSeed) {
  const auto place = [](int seed) {
    Simulation simulation(room(R"("motion": {"type": "random_walk"})",
                               R"(, "simulation": {"seed": )" + std::to_string(seed) + "}"));
    run(simulation, 20.0);
    return obstacle(simulation).center;
  };
  EXPECT_EQ(place(1), place(1));
  EXPECT_NE(place(1), place(2));
}

TEST(RandomWalk, TurnsAwayFromSolid) {
  // A pillar in the middle of the area.
  Simulation simulation(room(R"("motion": {"type": "random_walk", "speed": 0.5,
      "area": {"center": [1.5, 1], "size": [1.6, 1]}})",
                             "", R"(, {"name": "pillar", "center": [1.5, 1]})"));
  double farthest_m = 1.0;
  for (int i = 0; i < 10'000; ++i) {
    simulation.step();
    farthest_m = std::max(farthest_m, obstacle(simulation).center.x());
  }
  EXPECT_THAT(events_of(simulation), Contains(HasSubstr("blocked by pillar")));
  EXPECT_GT(farthest_m, 1.9) << "it gets past the pillar";
}

// --- pedestrians

// The potential of eq. (3) of the paper, without the factor for what is behind.
double potential(const Vec2& offset, const Vec2& velocity, const SocialForce& constants) {
  const Vec2 way = 2.0 * velocity;
  const double sum = offset.norm() + (offset - way).norm();
  const double b = 0.5 * std::sqrt(sum * sum - way.squaredNorm());
  return constants.repulsion_m2ps2 * std::exp(-b / constants.repulsion_range_m);
}

TEST(SocialForces, Repulsion_GradientOfPotential) {
  const SocialForce constants;
  for (const Vec2& velocity : {Vec2(0.0, 0.0), Vec2(0.4, 0.0), Vec2(-0.3, 0.5)}) {
    for (const Vec2& offset : {Vec2(0.5, 0.2), Vec2(-0.4, 0.1), Vec2(0.1, -0.7)}) {
      // Central differences; their error is h^2 times a third derivative of about 2.1 / 0.3^3.
      constexpr double kH = 1e-4;
      Vec2 expected;
      for (const int axis : {0, 1}) {
        Vec2 h = Vec2::Zero();
        h[axis] = kH;
        expected[axis] = -(potential(offset + h, velocity, constants) -
                           potential(offset - h, velocity, constants)) /
                         (2.0 * kH);
      }
      const Vec2 found = social_force::repulsion(offset, velocity, Vec2::Zero(), constants);
      EXPECT_NEAR((found - expected).norm(), 0.0, 1e-5);
    }
  }
}

TEST(SocialForces, Behind_CountsHalf) {
  const SocialForce constants;
  const Vec2 ahead = social_force::repulsion({-0.5, 0}, {0, 0}, {1, 0}, constants);
  const Vec2 behind = social_force::repulsion({0.5, 0}, {0, 0}, {1, 0}, constants);
  // 2.1 / 0.3 exp(-0.5 / 0.3) away from the other.
  EXPECT_NEAR(ahead.x(), -7.0 * std::exp(-0.5 / 0.3), 1e-12);
  EXPECT_NEAR(behind.x(), 0.5 * 7.0 * std::exp(-0.5 / 0.3), 1e-12);
}

TEST(SocialForces, Solids_RepelFromNearestPoint) {
  const Vec2 force = social_force::wall_repulsion({0, 0.3}, SocialForce{});
  EXPECT_NEAR(force.x(), 0.0, 1e-12);
  EXPECT_NEAR(force.y(), 50.0 * std::exp(-1.5), 1e-12);
  EXPECT_EQ(social_force::wall_repulsion({0, 2.0}, SocialForce{}), Vec2(0, 0));
}

TEST(SocialForces, Drive_ReachesDesiredVelocity) {
  const Vec2 force = social_force::towards({1, 0}, 1.34, {0.34, 0.5}, SocialForce{});
  EXPECT_NEAR(force.x(), 2.0, 1e-12);
  EXPECT_NEAR(force.y(), -1.0, 1e-12);
}

TEST(Pedestrian, AcceleratesAndStopsAtGoal) {
  Simulation simulation(load_world_text(R"({"arena": {"size": [20, 20], "obstacles": [
      {"name": "p", "shape": "circle", "radius": 0.2, "center": [3, 10],
       "motion": {"type": "pedestrian", "points": [[15, 10]]}}]}, "robots": []})"));
  run(simulation, 0.5);
  // Alone: v = v0 (1 - exp(-t / tau)), x = v0 (t - tau (1 - exp(-t / tau))). Euler's error is about
  // v0 dt / 2 = 0.007; the fluctuations have a deviation of 0.01 sqrt(t^3 / 3) = 0.002 at most.
  const double share = 1.0 - std::exp(-1.0);
  EXPECT_NEAR(obstacle(simulation).center.x(), 3.0 + 1.34 * (0.5 - 0.5 * share), 0.015);
  run(simulation, 20.0);
  EXPECT_THAT(events_of(simulation), ElementsAre(HasSubstr("p is at the end of its path")));
  // It stops after 0.2 m - v0 tau.
  EXPECT_NEAR(obstacle(simulation).center.x(), 15.0 - 0.2 + 1.34 * 0.5, 0.03);
}

TEST(Pedestrian, MeetingPedestrians_PassEachOther) {
  Simulation simulation(load_world_text(R"({"arena": {"size": [12, 4], "obstacles": [
      {"name": "a", "shape": "circle", "radius": 0.2, "center": [1, 2],
       "motion": {"type": "pedestrian", "points": [[11, 2]]}},
      {"name": "b", "shape": "circle", "radius": 0.2, "center": [11, 2.05],
       "motion": {"type": "pedestrian", "points": [[1, 2.05]]}}]}, "robots": []})"));
  double least_m = 12.0;
  for (int i = 0; i < 2000; ++i) {
    simulation.step();
    least_m =
        std::min(least_m, (obstacle(simulation, 0).center - obstacle(simulation, 1).center).norm());
  }
  EXPECT_GT(least_m, 0.45) << "0.4 m is a touch";
  EXPECT_THAT(events_of(simulation), SizeIs(2)) << "both arrive";
}

TEST(Pedestrian, HeadOnPedestrians_PassEachOther) {
  Simulation simulation(load_world_text(R"({"arena": {"size": [12, 4], "obstacles": [
      {"name": "a", "shape": "circle", "radius": 0.2, "center": [1, 2],
       "motion": {"type": "pedestrian", "points": [[11, 2]]}},
      {"name": "b", "shape": "circle", "radius": 0.2, "center": [11, 2],
       "motion": {"type": "pedestrian", "points": [[1, 2]]}}]}, "robots": []})"));
  run(simulation, 25.0);
  EXPECT_THAT(events_of(simulation), SizeIs(2)) << "both arrive";
}

TEST(Pedestrian, StandingRobot_Avoided) {
  Simulation simulation(load_world_text(R"({"arena": {"size": [12, 4], "obstacles": [
      {"name": "a", "shape": "circle", "radius": 0.2, "center": [1, 2],
       "motion": {"type": "pedestrian", "points": [[11, 2]]}}]},
      "robots": [{"name": "r1", "pose": {"x": 6, "y": 1.95}}]})"));
  double least_m = 12.0;
  for (int i = 0; i < 2000; ++i) {
    simulation.step();
    least_m = std::min(least_m,
                       (obstacle(simulation).center - simulation.body(0).X_WB.position()).norm());
  }
  EXPECT_GT(least_m, 0.35);
  EXPECT_EQ(simulation.body(0).X_WB.x_m, 6.0) << "nobody touched it";
  EXPECT_THAT(events_of(simulation), ElementsAre(HasSubstr("a is at the end of its path")));
}

TEST(Pedestrian, Door_Passed) {
  Simulation simulation(load_world_text(R"({"arena": {"size": [10, 4], "obstacles": [
      {"name": "a", "shape": "circle", "radius": 0.2, "center": [1, 1],
       "motion": {"type": "pedestrian", "points": [[5, 2], [9, 1]]}},
      {"name": "left", "center": [5, 0.6], "size": [0.2, 1.2]},
      {"name": "right", "center": [5, 3.4], "size": [0.2, 1.2]}]}, "robots": []})"));
  run(simulation, 15.0);
  EXPECT_THAT(events_of(simulation), ElementsAre(HasSubstr("a is at the end of its path")));
}

// --- orders of the controller

std::string order(const std::string& move) {
  return R"(, "controller": {"timers": [{"name": "t", "at": 1, "do": [{"move": {"obstacle": "o", )" +
         move + "}}]}]}";
}

TEST(MoveAction, Point_MovesObstacle) {
  Simulation simulation(room(R"("height": 0.2)", order(R"("to": [2, 1], "speed": 0.5)")));
  run(simulation, 2.0);
  expect_near(obstacle(simulation).center, {1.5, 1});
  run(simulation, 3.0);
  EXPECT_THAT(events_of(simulation),
              ElementsAre("1.00 timer t acts", "1.00 obstacle o begins to move",
                          "3.00 obstacle o is at the end of its path"));
}

TEST(MoveAction, Angle_TurnsAtEnd) {
  Simulation simulation(
      room(R"("height": 0.2)",
           order(R"("path": [[2, 1], [2, 2]], "speed": 1, "yaw_deg": 180, "turn_rate_deg": 90)")));
  run(simulation, 4.0);
  expect_near(obstacle(simulation).center, {2, 2});
  EXPECT_NEAR(obstacle(simulation).yaw_rad, 0.5 * kPi, 1e-9);
  run(simulation, 2.0);
  EXPECT_NEAR(std::abs(obstacle(simulation).yaw_rad), kPi, 1e-9);
  EXPECT_EQ(events_of(simulation).back(), "5.00 obstacle o is at the end of its path");
}

TEST(MoveAction, AngleOnly_TurnsInPlace) {
  Simulation simulation(room(R"("height": 0.2)", order(R"("yaw_deg": -90)")));
  run(simulation, 3.0);
  expect_near(obstacle(simulation).center, {1, 1});
  EXPECT_NEAR(obstacle(simulation).yaw_rad, -0.5 * kPi, 1e-9);
}

TEST(MoveAction, Stop_ReplacesMotion) {
  const std::string moving = path(R"("speed": 0.5, "points": [[5, 1]])");
  Simulation stopped(room(moving, order(R"("stop": true)")));
  run(stopped, 3.0);
  expect_near(obstacle(stopped).center, {1.5, 1});
  Simulation diverted(room(moving, order(R"("to": [1.5, 2], "speed": 1)")));
  run(diverted, 1.5);
  expect_near(obstacle(diverted).center, {1.5, 1.5});
}

TEST(MoveAction, Reset_StartsAnew) {
  Simulation simulation(room(R"("height": 0.2)", order(R"("to": [2, 1], "speed": 0.5)")));
  run(simulation, 2.0);
  simulation.reset();
  expect_near(obstacle(simulation).center, {1, 1});
  run(simulation, 1.0);
  expect_near(obstacle(simulation).center, {1, 1});
  run(simulation, 1.0);
  expect_near(obstacle(simulation).center, {1.5, 1});
}

// --- state

// Everything that moves, with a robot that pushes a crate through it.
WorldDescription busy_world(int seed = 1) {
  return load_world_text(R"({"arena": {"size": [5, 5], "obstacles": [
      {"name": "cart", "center": [1, 1], "size": [0.3, 0.2],
       "motion": {"type": "path", "speed": 0.4, "repeat": "round", "facing": "forward",
                  "wait": 0.3, "points": [[3, 1], [3, 3]]}},
      {"name": "ghost", "shape": "circle", "radius": 0.1, "center": [2, 2],
       "motion": {"type": "random_walk", "leg": 0.4}},
      {"name": "ann", "shape": "circle", "radius": 0.15, "center": [4, 4],
       "motion": {"type": "pedestrian", "speed": 0.6, "repeat": "random",
                  "points": [[1, 4], [4, 1], [2.5, 2.5]]}},
      {"name": "bob", "shape": "circle", "radius": 0.15, "center": [1, 4],
       "motion": {"type": "pedestrian", "speed": 0.5, "repeat": "round", "points": [[4, 4]]}},
      {"name": "wedge", "shape": "polygon", "center": [4.2, 2.2],
       "outline": [[0, 0], [0.4, 0], [0, 0.2]]},
      {"name": "crate", "center": [2, 0.5], "size": [0.2, 0.2], "mass": 0.5},
      {"name": "drum", "shape": "circle", "radius": 0.1, "center": [2.5, 0.5], "mass": 0.4}]},
    "robots": [{"name": "r1", "pose": {"x": 0.5, "y": 0.5}, "devices": {"laser": {}}},
               {"name": "r2", "pose": {"x": 4.5, "y": 0.5, "yaw_deg": 170}}],
    "controller": {"timers": [{"name": "t", "every": 3, "do": [
      {"move": {"obstacle": "wedge", "path": [[4.2, 3], [4.2, 2.2]], "yaw_deg": 90}}]}]},
    "simulation": {"seed": )" +
                         std::to_string(seed) + "}}");
}

void interfere(Simulation& simulation, int step) {
  if (step % 100 != 0) return;
  for (int i = 0; i < simulation.robot_count(); ++i) {
    const int motion = simulation.find_device(i, "motion").value();
    const double turn_radps = step % 900 == 800 ? 1.0 : 0.1 * i;
    ASSERT_FALSE(
        simulation.apply({i, motion}, TwistCommand{{.v_mps = 0.4, .omega_radps = turn_radps}}));
  }
}

TEST(MovingObstacles, TwoRuns_Equal) {
  Simulation a(busy_world());
  Simulation b(busy_world());
  test::expect_equal_runs(a, b, interfere, 3000);
  EXPECT_GT((obstacle(a, 5).center - Vec2(2, 0.5)).norm(), 0.2) << "the crate was pushed";
  Simulation other(busy_world(2));
  run(other, 10.0);
  Simulation first(busy_world(1));
  run(first, 10.0);
  EXPECT_NE(obstacle(other, 1).center, obstacle(first, 1).center);
}

TEST(MovingObstacles, Snapshot_ContinuesFromAnyMoment) {
  test::expect_equal_after_snapshots(busy_world(), interfere, 2500, 23);
}

TEST(MovingObstacles, Fork_Works) {
  Simulation simulation(busy_world());
  run(simulation, 4.0);
  Simulation fork = simulation.fork();
  run(fork, 3.0);
  run(simulation, 3.0);
  EXPECT_EQ(fork.state_hash(), simulation.state_hash());
}

TEST(MovingObstacles, InHashOfWorld) {
  const auto hash = [](const std::string& settings) { return world_hash(room(settings)); };
  const std::uint64_t still = hash(R"("height": 0.16)");
  const std::uint64_t moves = hash(path(R"("points": [[2, 1]])"));
  EXPECT_NE(moves, still);
  EXPECT_NE(hash(path(R"("points": [[2, 2]])")), moves);
  EXPECT_NE(hash(path(R"("points": [[2, 1]], "speed": 0.31)")), moves);
  const std::uint64_t crate = hash(R"("mass": 1)");
  EXPECT_NE(crate, still);
  EXPECT_NE(hash(R"("mass": 1, "friction": 0.2)"), crate);
}

TEST(MovingObstacles, Size_Kept) {
  Simulation simulation(room(path(R"("points": [[2, 1]])")));
  EXPECT_THAT(simulation.set_block_size("o", {0.3, 0.3}, 0.2).value_or(""),
              HasSubstr("can move: it keeps its size"));
}

// --- pictures

// The middle of the pixels of one colour, from the left end of the picture.
double middle_of_blue(const render::Image& image) {
  double sum = 0.0;
  int count = 0;
  for (std::size_t i = 0; i < image.rgb.size(); i += 3) {
    if (image.rgb[i] > 20 || image.rgb[i + 1] > 20 || image.rgb[i + 2] < 200) continue;
    sum += static_cast<double>(i / 3 % static_cast<std::size_t>(image.width));
    ++count;
  }
  return count > 0 ? sum / count : -1.0;
}

TEST(MovingObstacles, DrawnWhereTheyAre) {
  // One renderer for all pictures, like that of a film: it keeps the picture of the static arena.
  Simulation simulation(
      room(path(R"("speed": 0.5, "points": [[5, 1]])") + R"(, "colour": "#00f")"));
  render::RenderOptions options;
  options.trails = false;
  render::SceneRenderer renderer(options);
  std::vector<double> places;
  for (int i = 0; i < 3; ++i) {
    const double place = middle_of_blue(renderer.draw(simulation.snapshot(), ViewMode::kGround));
    EXPECT_EQ(place, middle_of_blue(render::draw_scene(simulation.snapshot(), options)));
    places.push_back(place);
    run(simulation, 2.0);
  }
  ASSERT_GT(places[0], 0.0);
  EXPECT_GT(places[1], places[0] + 50.0);
  // Equal ways within a pixel.
  EXPECT_NEAR(places[2] - places[1], places[1] - places[0], 1.0);
}

TEST(MovingObstacles, Tracks_InPictures) {
  Simulation simulation(
      room(path(R"("speed": 0.5, "repeat": "round", "points": [[5, 1], [5, 5]])")));
  run(simulation, 1.0);
  const SceneSnapshot scene = simulation.snapshot();
  ASSERT_THAT(scene.tracks, SizeIs(1));
  EXPECT_EQ(scene.tracks[0].obstacle, 0);
  EXPECT_TRUE(scene.tracks[0].closed);
  EXPECT_EQ(scene.tracks[0].points, (std::vector<Vec2>{{1, 1}, {5, 1}, {5, 5}}));
  render::RenderOptions without;
  without.trails = false;
  EXPECT_NE(render::draw_scene(scene).rgb, render::draw_scene(scene, without).rgb);
}

TEST(MovingObstacles, WorldsWithoutThem_NoEvents) {
  Simulation simulation(room(R"("height": 0.2)"));
  run(simulation, 0.1);
  EXPECT_THAT(simulation.snapshot().tracks, IsEmpty());
  EXPECT_THAT(events_of(simulation), IsEmpty());
}

}  // namespace
}  // namespace sim
