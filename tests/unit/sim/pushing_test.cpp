// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Obstacles as bodies: pushing against the formulas, and drives that reach their poses.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

#include "outlines.h"
#include "physics/physics_world.h"
#include "random_numbers.h"
#include "sim/world/outline.h"
#include "sim/world/robot_model.h"

namespace sim {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kStep_s = 0.01;
constexpr double kGravity_mps2 = 9.81;
constexpr double kTraction = 0.75;  // of the wheels, see docs/decisions/moving_obstacles.md

ObstacleDescription circle(double x, double y, double radius_m) {
  return test::circle("", {x, y}, radius_m);
}

ObstacleDescription box(double x, double y, double side_m) {
  return test::box("", {x, y}, {side_m, side_m});
}

ObstacleDescription pushable(ObstacleDescription o, double mass_kg, double friction = 0.3) {
  o.mass_kg = mass_kg;
  o.friction = friction;
  return o;
}

ObstacleDescription driven(ObstacleDescription o) {
  o.motion.emplace();
  return o;
}

// A floor of 8 x 8 m with S1Rs (2 kg) that face along x, and obstacles.
class Floor {
 public:
  Floor(const std::vector<Pose>& robots, std::vector<ObstacleDescription> obstacles)
      : arena_(arena_of(std::move(obstacles))), world_(arena_) {
    for (const Pose& X_WB : robots) world_.add_robot(s1r_model(), X_WB);
    for (std::size_t i = 0; i < arena_.obstacles.size(); ++i) {
      if (!is_movable(arena_.obstacles[i])) continue;
      world_.add_moving_obstacle(static_cast<int>(i), arena_.obstacles[i]);
    }
  }

  PhysicsWorld* operator->() { return &world_; }
  [[nodiscard]] int body(int obstacle) const { return world_.body_of_obstacle(obstacle); }
  [[nodiscard]] Pose pose(int obstacle) const { return world_.obstacle_pose(body(obstacle)); }
  [[nodiscard]] double x_m(int obstacle) const { return pose(obstacle).x_m; }
  [[nodiscard]] double speed_mps(int obstacle) const {
    return world_.obstacle_velocity(body(obstacle)).norm();
  }
  void run(int steps) {
    for (int i = 0; i < steps; ++i) world_.step(kStep_s);
  }
  void drive(double v_mps, double omega_radps = 0.0, int robot = 0) {
    world_.set_target(robot, {v_mps, omega_radps, 0.0});
  }

 private:
  static ArenaDescription arena_of(std::vector<ObstacleDescription> obstacles) {
    ArenaDescription arena;
    arena.size = {8, 8};
    arena.obstacles = std::move(obstacles);
    return arena;
  }

  ArenaDescription arena_;
  PhysicsWorld world_;
};

TEST(Pushing, UntouchedObstacle_Stays) {
  Floor floor({{1, 1, 0}}, {pushable(circle(4, 4, 0.1), 0.5), pushable(box(5, 5, 0.2), 0.5, 0.0)});
  floor.drive(0.5, 1.0);
  floor.run(500);
  EXPECT_EQ(floor.pose(0), (Pose{4, 4, 0}));
  EXPECT_EQ(floor.pose(1), (Pose{5, 5, 0}));
}

TEST(Pushing, RobotFrontAndObstacle_MoveTogether) {
  for (const bool round : {true, false}) {
    Floor floor({{1, 4, 0}}, {pushable(round ? circle(2, 4, 0.1) : box(2, 4, 0.2), 0.5)});
    floor.drive(0.3);
    floor.run(600);
    const double robot_x_m = floor->body(0).X_WB.x_m;
    EXPECT_GT(robot_x_m, 2.0);
    // The front is 0.087 m ahead of the axle. Bodies that push each other are at most 2 mm apart.
    EXPECT_NEAR(floor.x_m(0) - robot_x_m, 0.187, 0.0025);
    EXPECT_NEAR(floor->body(0).twist.v_mps, 0.3, 0.002);
    EXPECT_NEAR(floor.speed_mps(0), 0.3, 0.002);
    EXPECT_FALSE(floor->body(0).stalled);
  }
}

// The way of something that slides at v_mps to its rest: each step first lowers the speed by mu g
// dt and then moves. That is v^2 / (2 mu g) - v dt / 2, up to the last step.
double way_to_rest_m(double v_mps, double friction) {
  const double loss_mps = friction * kGravity_mps2 * kStep_s;
  const double steps = std::floor(v_mps / loss_mps);
  const double way_m = (steps * v_mps - 0.5 * steps * (steps + 1.0) * loss_mps) * kStep_s;
  EXPECT_NEAR(way_m, v_mps * v_mps / (2.0 * friction * kGravity_mps2) - 0.5 * v_mps * kStep_s,
              loss_mps * kStep_s);
  return way_m;
}

TEST(Pushing, ReleasedObstacle_SlidesByFriction) {
  for (const double friction : {0.05, 0.1, 0.3, 0.6}) {
    for (const bool robot_vanishes : {true, false}) {
      Floor floor({{1, 4, 0}}, {pushable(circle(2, 4, 0.1), 0.2, friction)});
      floor.drive(0.5);
      floor.run(300);
      if (robot_vanishes) floor->set_pose(0, {1, 1, 0});
      floor.drive(0.0);
      floor.run(1);
      const double v_mps = floor.speed_mps(0);
      const double from_m = floor.x_m(0);
      ASSERT_GT(v_mps, 0.4);
      floor.run(400);
      // A robot that brakes, with its traction of 0.75 g, is slower than the obstacle, but Box2D
      // may still separate the two by 2 mm.
      EXPECT_NEAR(floor.x_m(0) - from_m, way_to_rest_m(v_mps, friction),
                  robot_vanishes ? 1e-6 : 0.0022)
          << friction << ' ' << robot_vanishes;
      EXPECT_EQ(floor.speed_mps(0), 0.0);
    }
  }
}

TEST(Pushing, Friction_StopsSlideAndRotationTogether) {
  // The robot meets the box beside its middle, so that it turns, and vanishes.
  Floor floor({{1, 4, 0}}, {pushable(box(2, 4.08, 0.2), 0.2, 0.2)});
  floor.drive(0.5);
  floor.run(195);
  floor->set_pose(0, {1, 1, 0});
  floor.drive(0.0);
  const int body = floor.body(0);
  // A square of side a has m a^2 / 6, like a disc of R = a / sqrt(3); c = 2 R / 3.
  const double arm_m = 2.0 / 3.0 * 0.2 / std::sqrt(3.0);
  const auto speed_mps = [&] {
    return std::hypot(floor.speed_mps(0), arm_m * floor->body(body).twist.omega_radps);
  };
  floor.run(1);
  const double ratio = floor->body(body).twist.omega_radps / floor.speed_mps(0);
  ASSERT_GT(std::abs(ratio), 0.5);
  double before_mps = speed_mps();
  const double loss_mps = 0.2 * kGravity_mps2 * kStep_s;
  while (before_mps > 1.1 * loss_mps) {
    floor.run(1);
    ASSERT_NEAR(before_mps - speed_mps(), loss_mps, 1e-6);
    ASSERT_NEAR(floor->body(body).twist.omega_radps, ratio * floor.speed_mps(0), 1e-5);
    before_mps = speed_mps();
  }
  floor.run(2);
  EXPECT_EQ(speed_mps(), 0.0);
}

TEST(Pushing, Traction_Limits) {
  // The wheels push with at most 0.75 * 2 kg * g, the floor holds with 0.3 m g: the limit is 5 kg.
  for (const double mass_kg : {4.5, 5.5}) {
    Floor floor({{1, 4, 0}}, {pushable(box(2, 4, 0.3), mass_kg)});
    floor.drive(0.3);
    floor.run(800);
    const bool moves = mass_kg < 5.0;
    EXPECT_EQ(floor.x_m(0) > 2.1, moves) << mass_kg;
    EXPECT_EQ(floor->body(0).stalled, !moves) << mass_kg;
    if (moves) continue;
    // The impact lasts until friction has used up the common momentum: v = 0.3 M / (M + m), and the
    // deceleration is (mu m - 0.75 M) g / (M + m).
    const double v_mps = 0.3 * 2.0 / (2.0 + mass_kg);
    const double slower_mps2 = (0.3 * mass_kg - kTraction * 2.0) * kGravity_mps2 / (2.0 + mass_kg);
    EXPECT_LT(floor.x_m(0) - 2.0, v_mps * v_mps / (2.0 * slower_mps2));
    const double rest_m = floor.x_m(0);
    floor.run(500);
    EXPECT_EQ(floor.x_m(0), rest_m);
  }
}

TEST(Pushing, RobotAndObstacle_AccelerateTogether) {
  // Standing at the obstacle first: (0.75 M - mu m) g / (M + m) = 1.28 m/s^2 for m = 3 kg.
  Floor floor({{1.75, 4, 0}}, {pushable(box(2, 4, 0.3), 3.0)});
  floor.drive(0.02);
  floor.run(100);
  floor.drive(0.5);
  const double before_mps = floor->body(0).twist.v_mps;
  constexpr int kSteps = 20;
  floor.run(kSteps);
  const double expected_mps2 = (kTraction * 2.0 - 0.3 * 3.0) * kGravity_mps2 / (2.0 + 3.0);
  const double found_mps2 = (floor->body(0).twist.v_mps - before_mps) / (kSteps * kStep_s);
  EXPECT_NEAR(found_mps2, expected_mps2, 0.1 * expected_mps2);
  EXPECT_NEAR(floor.speed_mps(0), floor->body(0).twist.v_mps, 0.01);
}

TEST(Pushing, Obstacles_ExchangeMomentumWithoutRestitution) {
  // Without friction: one of 1 kg meets one of 3 kg at rest. v' = v / 4 for both.
  Floor floor({{1, 4, 0}},
              {pushable(circle(2, 4, 0.1), 1.0, 0.0), pushable(circle(4, 4, 0.1), 3.0, 0.0)});
  floor.drive(0.4);
  floor.run(240);
  floor.drive(-0.4);
  const double v_mps = floor.speed_mps(0);
  ASSERT_NEAR(v_mps, 0.4, 0.03);
  for (int i = 0; i < 1000 && floor.speed_mps(1) == 0.0; ++i) floor.run(1);
  floor.run(30);
  EXPECT_NEAR(1.0 * floor.speed_mps(0) + 3.0 * floor.speed_mps(1), v_mps, 0.002);
  EXPECT_NEAR(floor.speed_mps(1), 0.25 * v_mps, 0.002);
  EXPECT_NEAR(floor.speed_mps(0), 0.25 * v_mps, 0.002);
}

TEST(Pushing, RowAtWall_StopsRobot) {
  Floor floor({{5, 4, 0}}, {pushable(box(6, 4, 0.2), 0.3), pushable(circle(6.5, 4, 0.1), 0.3)});
  floor.drive(0.5);
  floor.run(900);
  EXPECT_TRUE(floor->body(0).stalled);
  EXPECT_GT(floor.x_m(1), 8.0 - 0.1 - 0.01);
  EXPECT_LT(floor.x_m(1), 8.0 - 0.1 + 0.001);
  EXPECT_NEAR(floor.x_m(1) - floor.x_m(0), 0.2, 0.004);
  EXPECT_NEAR(floor.x_m(0) - floor->body(0).X_WB.x_m, 0.187, 0.004);
}

TEST(Pushing, RobotsAtOtherObstacles_Free) {
  // A robot that touches nothing keeps its unlimited acceleration, also in a world with a crate.
  Floor floor({{1, 1, 0}}, {pushable(box(6, 6, 0.2), 0.3)});
  floor.drive(0.5);
  floor.run(1);
  EXPECT_NEAR(floor->body(0).twist.v_mps, 0.5, 1e-12);
}

TEST(DrivenObstacle, Pose_ReachedExactly) {
  // An off-centre triangle that turns while it moves, at one and at several substeps a step.
  for (const double step_m : {0.001, 0.05}) {
    ObstacleDescription o;
    o.center = {2, 4};
    make_polygon(o, {{0, 0}, {0.5, 0}, {0, 0.3}});
    Floor floor({}, {driven(o)});
    Pose goal = floor.pose(0);
    for (int i = 0; i < 60; ++i) {
      goal = {goal.x_m + step_m, goal.y_m - 0.3 * step_m, normalize_angle(goal.yaw_rad + 0.1)};
      floor->drive_obstacle(floor.body(0), goal, kStep_s);
      floor.run(1);
      const Pose found = floor.pose(0);
      EXPECT_NEAR(found.x_m, goal.x_m, 1e-12);
      EXPECT_NEAR(found.y_m, goal.y_m, 1e-12);
      EXPECT_NEAR(normalize_angle(found.yaw_rad - goal.yaw_rad), 0.0, 1e-12);
    }
  }
}

TEST(DrivenObstacle, Wall_Stops) {
  for (const bool round : {true, false}) {
    Floor floor({}, {driven(round ? circle(7, 4, 0.1) : box(7, 4, 0.2)), box(7.6, 4, 0.3)});
    for (int i = 0; i < 300; ++i) {
      const Pose at = floor.pose(0);
      floor->drive_obstacle(floor.body(0), {at.x_m + 0.005, at.y_m, at.yaw_rad}, kStep_s);
      floor.run(1);
    }
    // Bodies rest 1.5 mm apart, within Box2D's tolerance of 0.5 mm.
    EXPECT_NEAR(floor.x_m(0), 7.45 - 0.1 - 0.0015, 6e-4);
    EXPECT_TRUE(floor->body(floor.body(0)).stalled);
  }
}

TEST(DrivenObstacle, StandingRobot_Pushed) {
  // A drive of 10 kg against 2 kg: the robot, whose wheels stand, takes part of the momentum.
  Floor floor({{3, 4, kPi / 2}}, {driven(circle(2, 4, 0.2))});
  for (int i = 0; i < 500; ++i) {
    const Pose at = floor.pose(0);
    floor->drive_obstacle(floor.body(0), {at.x_m + 0.004, at.y_m, at.yaw_rad}, kStep_s);
    floor.run(1);
  }
  EXPECT_GT(floor->body(0).X_WB.x_m, 3.3);
  EXPECT_GT(floor->body(0).X_WB.x_m - floor.x_m(0), 0.2 + 0.08 - 0.002) << "they do not overlap";
}

TEST(DrivenObstacle, Suspended_Stands) {
  Floor floor({}, {driven(circle(2, 4, 0.2))});
  floor->set_suspended(floor.body(0), true);
  floor->drive_obstacle(floor.body(0), {2.1, 4, 0}, kStep_s);
  floor.run(1);
  EXPECT_EQ(floor.pose(0), (Pose{2, 4, 0}));
}

TEST(DrivenObstacle, RobotOrCrateAtWall_NotCrushed) {
  for (const double speed_mps : {0.3, 10.0}) {
    for (const bool robot : {true, false}) {
      const Pose X_WB{robot ? 7.0 : 1.0, robot ? 4.0 : 1.0, kPi / 2};
      Floor floor({X_WB}, {driven(circle(5, 4, 0.2)),
                           pushable(robot ? circle(1, 7, 0.1) : circle(7, 4, 0.1), 0.5)});
      double least_m = 8.0;
      for (int i = 0; i < 1000; ++i) {
        const Pose at = floor.pose(0);
        floor->drive_obstacle(floor.body(0), {at.x_m + speed_mps * kStep_s, at.y_m, 0}, kStep_s);
        floor.run(1);
        // Of the centres, without the radii; the side of an S1R is 0.081 m from its centre.
        const double other_m = robot ? floor->body(0).X_WB.x_m - 0.081 : floor.x_m(1) - 0.1;
        least_m = std::min(least_m, other_m - floor.x_m(0) - 0.2);
      }
      // The impact at 10 m/s lets a light crate sink in a little for one step.
      EXPECT_GT(least_m, -0.002) << speed_mps << ' ' << robot;
      EXPECT_LT(floor.x_m(0), 8.0 - 0.2 - 2.0 * (robot ? 0.081 : 0.1)) << speed_mps << ' ' << robot;
    }
  }
}

TEST(MovableObstacle, RandomCrowds_DoNotOverlap) {
  // Every third of 24 circles is driven, every third can be pushed, the others stand.
  test::Random random(5);
  std::vector<ObstacleDescription> obstacles;
  for (int i = 0; i < 24; ++i) {
    ObstacleDescription o = circle(0.6 + 0.75 * (i % 6), 0.6 + i / 6, random.uniform(0.03, 0.15));
    if (i % 3 == 0) o = driven(o);
    if (i % 3 == 1) o = pushable(o, random.uniform(0.1, 3.0), random.uniform(0.0, 0.6));
    obstacles.push_back(o);
  }
  // A wall at y = 5 keeps all together.
  obstacles.push_back(box(4, 6.5, 0.1));
  obstacles.back().size = {8.0, 3.0};
  Floor floor({{0.4, 4.4, 0}, {1.4, 4.4, 1}, {2.4, 4.4, 2}, {3.4, 4.4, 3}}, obstacles);
  std::vector<Vec2> velocities(24);
  double deepest_m = 1.0;
  for (int step = 0; step < 4000; ++step) {
    if (step % 50 == 0) {
      for (int i = 0; i < 4; ++i)
        floor.drive(random.uniform(-0.5, 0.5), random.uniform(-3.0, 3.0), i);
      for (Vec2& v : velocities) v = {random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5)};
    }
    for (std::size_t i = 0; i < 24; i += 3) {
      const int index = static_cast<int>(i);
      const Vec2 p = floor.pose(index).position() + kStep_s * velocities[i];
      floor->drive_obstacle(floor.body(index), {p.x(), p.y(), 0}, kStep_s);
    }
    floor.run(1);
    for (std::size_t i = 0; i < 24; ++i) {
      if (is_movable(obstacles[i])) {
        obstacles[i].center = floor.pose(static_cast<int>(i)).position();
      }
      for (std::size_t k = 0; k < i; ++k) {
        if (!is_movable(obstacles[i]) && !is_movable(obstacles[k])) continue;
        const double apart_m = (obstacles[i].center - obstacles[k].center).norm();
        deepest_m = std::min(deepest_m, apart_m - radius_m(obstacles[i]) - radius_m(obstacles[k]));
      }
    }
  }
  // Box2D lets bodies that push each other sink in by its tolerance of 0.5 mm, and a little more
  // where several push.
  EXPECT_GT(deepest_m, -0.0015);
  EXPECT_LT(deepest_m, 0.002) << "some touched";
}

TEST(MovableObstacle, Contacts_NameObstacle) {
  Floor floor({{1, 4, 0}}, {box(6, 6, 0.2), pushable(box(2, 4, 0.2), 0.5)});
  floor.drive(0.3);
  floor.run(400);
  const auto contacts = floor->contacts_of(0);
  ASSERT_EQ(contacts.size(), 1U);
  EXPECT_EQ(contacts[0].kind, PhysicsWorld::Contact::Kind::kObstacle);
  EXPECT_EQ(contacts[0].index, 1);
}

TEST(MovableObstacle, RobotWithin_NamesIt) {
  Floor floor({{1, 4, 0}}, {pushable(circle(3, 4, 0.2), 0.5)});
  EXPECT_EQ(floor->robot_within(box(3, 4, 0.1)), floor.body(0));
  EXPECT_EQ(floor->robot_within(box(3, 4, 0.1), floor.body(0)), -1);
  EXPECT_EQ(floor->robot_within(box(1, 4, 0.1)), 0);
}

}  // namespace
}  // namespace sim
