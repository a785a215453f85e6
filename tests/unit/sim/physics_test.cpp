// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "outlines.h"
#include "physics/feasible_twist.h"
#include "physics/physics_world.h"
#include "polygon_overlap.h"

namespace sim {
namespace {

using test::box;

constexpr double kStep_s = 0.01;
constexpr double kPi = std::numbers::pi;

// An empty floor of 4 x 4 m with borders.
ArenaDescription floor_4x4() {
  ArenaDescription arena;
  arena.size = {4.0, 4.0};
  return arena;
}

void run(PhysicsWorld& world, int steps) {
  for (int i = 0; i < steps; ++i) world.step(kStep_s);
}

// Maximum overlap of the robots' footprints with obstacles, borders and one another [m].
double deepest_overlap_m(const PhysicsWorld& world, const ArenaDescription& arena) {
  double deepest_m = 0.0;
  std::vector<Polygon> robots;
  for (int i = 0; i < world.robot_count(); ++i) {
    robots.push_back(test::placed(s1r_model().footprint, world.body(i).X_WB));
  }
  for (std::size_t i = 0; i < robots.size(); ++i) {
    for (const Vec2& v : robots[i]) {
      deepest_m = std::max({deepest_m, arena.origin.x() - v.x(), arena.origin.y() - v.y(),
                            v.x() - arena.origin.x() - arena.size.x(),
                            v.y() - arena.origin.y() - arena.size.y()});
    }
    for (const ObstacleDescription& o : arena.obstacles) {
      if (o.state == ObstacleState::kRetracted) continue;
      deepest_m = std::max(deepest_m, test::overlap_depth_m(robots[i], test::box_polygon(o)));
    }
    for (std::size_t j = i + 1; j < robots.size(); ++j) {
      deepest_m = std::max(deepest_m, test::overlap_depth_m(robots[i], robots[j]));
    }
  }
  return deepest_m;
}

TEST(FeasibleTwist, NoContacts_TargetTwist) {
  const Twist target{0.3, -1.0, 0.0};
  EXPECT_EQ(feasible_twist(target, 2.0, 0.01, {}), target);
}

TEST(FeasibleTwist, HeadOnContact_StopsDriveKeepsTurn) {
  // Normal straight ahead, contact on the x axis: v <= 0.1, omega unconstrained.
  const Twist t = feasible_twist({0.3, 1.0, 0.0}, 2.0, 0.01, {{1.0, 0.0, 0.1}});
  EXPECT_NEAR(t.v_mps, 0.1, 1e-12);
  EXPECT_NEAR(t.omega_radps, 1.0, 1e-12);
}

TEST(FeasibleTwist, ObliqueContact_TradesSpeedForTurn) {
  // v + 0.1 omega <= 0 with m = 2, I = 0.01: the projection in the metric diag(m, I) moves along
  // (1/m, 0.1/I) = (0.5, 10) by lambda = 0.3 / (0.5 + 0.1 * 10) = 0.2.
  const Twist t = feasible_twist({0.3, 0.0, 0.0}, 2.0, 0.01, {{1.0, 0.1, 0.0}});
  EXPECT_NEAR(t.v_mps, 0.3 - 0.2 * 0.5, 1e-12);
  EXPECT_NEAR(t.omega_radps, -0.2 * 10.0, 1e-12);
}

TEST(FeasibleTwist, TwoContacts_BothConstraintsHold) {
  // v + 0.1 omega <= 0.1 and v - 0.1 omega <= 0.05 meet at (0.075, 0.25). The target differs from
  // it by (0.425, -0.25), which is a (0.5, 10) + b (0.5, -10) with a = 0.4125 and b = 0.4375: both
  // contacts push, so no other allowed twist is nearer in the metric diag(2, 0.01).
  const Twist t = feasible_twist({0.5, 0.0, 0.0}, 2.0, 0.01, {{1.0, 0.1, 0.1}, {1.0, -0.1, 0.05}});
  EXPECT_NEAR(t.v_mps, 0.075, 1e-12);
  EXPECT_NEAR(t.omega_radps, 0.25, 1e-12);
}

TEST(FeasibleTwist, Energy_NeverAboveTarget) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (int i = 0; i < 2000; ++i) {
    const Twist target{0.5 * uniform(random), 3.0 * uniform(random), 0.0};
    std::vector<TwistConstraint> constraints;
    for (int k = 0; k < 1 + i % 6; ++k) {
      const double a = kPi * uniform(random);
      constraints.push_back({std::cos(a), 0.09 * uniform(random), std::abs(0.1 * uniform(random))});
    }
    const Twist t = feasible_twist(target, 2.0, 0.008, constraints);
    for (const TwistConstraint& c : constraints) {
      EXPECT_LE(c.along * t.v_mps + c.turning * t.omega_radps, c.limit + 1e-8);
    }
    const auto energy = [](const Twist& x) {
      return 2.0 * x.v_mps * x.v_mps + 0.008 * x.omega_radps * x.omega_radps;
    };
    EXPECT_LE(energy(t), energy(target) + 1e-9);
  }
}

TEST(PhysicsWorld, FreeRobot_FollowsExactArc) {
  PhysicsWorld world(floor_4x4());
  world.add_robot(s1r_model(), {2.0, 1.0, 0.0});
  world.set_target(0, {0.4, 0.8, 0.0});
  run(world, 1000);
  // Radius v/omega = 0.5 m round (2, 1.5); after 10 s the heading is 8 rad.
  EXPECT_NEAR(world.body(0).X_WB.x_m, 2.0 + 0.5 * std::sin(8.0), 1e-9);
  EXPECT_NEAR(world.body(0).X_WB.y_m, 1.0 + 0.5 * (1.0 - std::cos(8.0)), 1e-9);
  EXPECT_NEAR(world.body(0).X_WB.yaw_rad, 8.0 - 2.0 * kPi, 1e-9);
}

TEST(PhysicsWorld, ManyTurns_AngleStaysExact) {
  PhysicsWorld world(floor_4x4());
  world.add_robot(s1r_model(), {2.0, 2.0, 0.0});
  world.set_target(0, {0.0, 3.0, 0.0});
  run(world, 20000);  // 200 s: 600 rad
  EXPECT_NEAR(world.body(0).X_WB.yaw_rad, std::remainder(600.0, 2.0 * kPi), 1e-7);
}

TEST(PhysicsWorld, FreeRobot_NeverSlidesSideways) {
  PhysicsWorld world(floor_4x4());
  world.add_robot(s1r_model(), {2.0, 2.0, 0.3});
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (int i = 0; i < 500; ++i) {
    world.set_target(0, {0.1 * uniform(random), 3.0 * uniform(random), 0.0});
    world.step(kStep_s);
    ASSERT_LT(std::abs(world.body(0).twist.lateral_mps), 1e-12);
  }
}

TEST(PhysicsWorld, Wall_RobotStands) {
  const ArenaDescription arena = floor_4x4();
  PhysicsWorld world(arena);
  world.add_robot(s1r_model(), {3.7, 2.0, 0.0});
  world.set_target(0, {0.5, 0.0, 0.0});
  run(world, 300);
  // The front of the footprint is 0.087 m ahead of the axle; the hulls rest 1.5 mm apart.
  EXPECT_NEAR(world.body(0).X_WB.x_m, 4.0 - 0.087 - 0.0015, 0.001);
  EXPECT_NEAR(world.body(0).X_WB.y_m, 2.0, 1e-6);
  EXPECT_LT(deepest_overlap_m(world, arena), 1e-9);
  EXPECT_TRUE(world.body(0).stalled);
  EXPECT_NEAR(world.body(0).twist.v_mps, 0.0, 1e-6);
}

TEST(PhysicsWorld, ObliqueWall_TurnsRobotWithoutSliding) {
  const ArenaDescription arena = floor_4x4();
  PhysicsWorld world(arena);
  // 30 degrees from the wall: the corner behind the slanted face touches it.
  world.add_robot(s1r_model(), {3.7, 1.0, kPi / 3.0});
  world.set_target(0, {0.3, 0.0, 0.0});
  for (int i = 0; i < 400; ++i) {
    world.step(kStep_s);
    // Box2D pushes the corner out again by the curvature of its path in one step, about 0.1 mm.
    ASSERT_LT(std::abs(world.body(0).twist.lateral_mps), 0.02) << "step " << i;
    ASSERT_LT(deepest_overlap_m(world, arena), 0.0005) << "step " << i;
    // Energy must not increase: the robot is never faster than commanded.
    ASSERT_LE(std::abs(world.body(0).twist.v_mps), 0.3 + 1e-4);  // single precision
  }
  // At the end it drives along the wall, upwards.
  EXPECT_NEAR(world.body(0).X_WB.yaw_rad, kPi / 2.0, 0.1);
  EXPECT_GT(world.body(0).X_WB.y_m, 1.6);
}

TEST(PhysicsWorld, Stall_RaisedAfterTwoTenthsOfSecond) {
  PhysicsWorld world(floor_4x4());
  world.add_robot(s1r_model(), {4.0 - 0.087 - 0.002, 2.0, 0.0});
  world.set_target(0, {0.3, 0.0, 0.0});
  run(world, 19);
  EXPECT_FALSE(world.body(0).stalled);
  run(world, 1);
  EXPECT_TRUE(world.body(0).stalled);
  world.set_target(0, {-0.3, 0.0, 0.0});
  run(world, 1);
  EXPECT_FALSE(world.body(0).stalled);
}

TEST(PhysicsWorld, PushedRobot_MovesNoFaster) {
  const ArenaDescription arena = floor_4x4();
  PhysicsWorld world(arena);
  world.add_robot(s1r_model(), {1.0, 2.0, 0.0});
  world.add_robot(s1r_model(), {1.3, 2.0, 0.0});
  world.set_target(0, {0.4, 0.0, 0.0});
  for (int i = 0; i < 500; ++i) {
    world.step(kStep_s);
    ASSERT_LT(deepest_overlap_m(world, arena), 0.002) << "step " << i;
    ASSERT_LE(world.body(0).twist.v_mps, 0.4 + 1e-6);
    ASSERT_LE(world.body(1).twist.v_mps, 0.4 + 1e-6);
  }
  EXPECT_GT(world.body(1).X_WB.x_m, 1.5);
}

TEST(PhysicsWorld, Contact_CountedOnceUntilItEnds) {
  ArenaDescription arena = floor_4x4();
  arena.obstacles.push_back(box("b", {2.5, 2.0}, {0.2, 1.0}));
  PhysicsWorld world(arena);
  world.add_robot(s1r_model(), {2.0, 2.0, 0.0});
  int begun = 0;
  const auto drive = [&](double v, int steps) {
    world.set_target(0, {v, 0.0, 0.0});
    for (int i = 0; i < steps; ++i) {
      world.step(kStep_s);
      for (const PhysicsWorld::Contact& c : world.new_contacts()) {
        EXPECT_EQ(c.robot, 0);
        EXPECT_EQ(c.kind, PhysicsWorld::Contact::Kind::kObstacle);
        EXPECT_EQ(c.index, 0);
        ++begun;
      }
    }
  };
  drive(0.3, 300);
  EXPECT_EQ(begun, 1);
  drive(-0.3, 50);
  EXPECT_EQ(begun, 1);
  drive(0.3, 300);
  EXPECT_EQ(begun, 2);
}

TEST(PhysicsWorld, ThirteenPushingRobots_OverlapBelowTwoMillimetres) {
  ArenaDescription arena = floor_4x4();
  arena.size = {1.6, 1.6};
  arena.obstacles.push_back(box("a", {0.8, 0.8}, {0.2, 0.2}, 0.4));
  arena.obstacles.push_back(box("b", {0.3, 1.1}, {0.1, 0.3}));
  PhysicsWorld world(arena);
  int count = 0;
  for (int row = 0; row < 4 && count < 13; ++row) {
    for (int column = 0; column < 4 && count < 13; ++column) {
      const Pose pose{0.2 + 0.4 * column, 0.2 + 0.4 * row, 0.0};
      const Polygon footprint = test::placed(s1r_model().footprint, pose);
      bool blocked = false;
      for (const ObstacleDescription& o : arena.obstacles) {
        blocked = blocked || test::overlap_depth_m(footprint, test::box_polygon(o)) > 0.0;
      }
      if (blocked) continue;
      world.add_robot(s1r_model(), pose);
      ++count;
    }
  }
  ASSERT_GE(count, 12);
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  double deepest_m = 0.0;
  for (int i = 0; i < 6000; ++i) {
    if (i % 50 == 0) {
      for (int r = 0; r < count; ++r) {
        world.set_target(r, {0.5 * uniform(random), 3.0 * uniform(random), 0.0});
      }
    }
    world.step(kStep_s);
    deepest_m = std::max(deepest_m, deepest_overlap_m(world, arena));
  }
  EXPECT_LT(deepest_m, 0.002);
}

TEST(PhysicsWorld, LongSteps_NoOverlap) {
  const ArenaDescription arena = floor_4x4();
  PhysicsWorld world(arena);
  world.add_robot(s1r_model(), {3.5, 2.0, 0.2});
  world.set_target(0, {0.5, 0.5, 0.0});
  for (int i = 0; i < 40; ++i) {
    world.step(0.1);
    ASSERT_LT(deepest_overlap_m(world, arena), 0.002);
  }
}

TEST(PhysicsWorld, RetractedObstacles_NotSolid) {
  ArenaDescription arena = floor_4x4();
  arena.obstacles.push_back(box("d", {2.5, 2.0}, {0.2, 1.0}));
  arena.obstacles[0].type = ObstacleType::kDynamic;
  arena.obstacles[0].state = ObstacleState::kRetracted;
  PhysicsWorld world(arena);
  world.add_robot(s1r_model(), {2.0, 2.0, 0.0});
  world.set_target(0, {0.5, 0.0, 0.0});
  run(world, 50);
  EXPECT_NEAR(world.body(0).X_WB.x_m, 2.25, 1e-9);
  EXPECT_EQ(world.robot_on(0), -1);  // its front is at 2.337, the block begins at 2.4
  run(world, 50);
  EXPECT_EQ(world.robot_on(0), 0);
}

TEST(PhysicsWorld, MapWalls_StopRobotFromOutsideOnly) {
  ArenaDescription arena = floor_4x4();
  arena.walls.push_back({{{2.5, 1.5}, {3.0, 1.5}, {3.0, 2.5}, {2.5, 2.5}}});
  PhysicsWorld world(arena);
  world.add_robot(s1r_model(), {2.0, 2.0, 0.0});
  world.set_target(0, {0.5, 0.0, 0.0});
  run(world, 300);
  EXPECT_NEAR(world.body(0).X_WB.x_m, 2.5 - 0.087 - 0.0015, 0.001);
  EXPECT_THAT(world.clearance_m(0, 1.0, 1.0), testing::DoubleNear(0.0015, 0.0005));
}

TEST(PhysicsWorld, RobotsAmongMapWalls_OverlapBelowTwoMillimetres) {
  ArenaDescription arena = floor_4x4();
  arena.size = {1.6, 1.6};
  ArenaDescription same_with_boxes = arena;
  for (const ObstacleDescription& o :
       {box("a", {0.8, 0.8}, {0.2, 0.2}, 0.4), box("b", {0.3, 1.1}, {0.1, 0.3}),
        box("c", {1.2, 0.5}, {0.3, 0.02}), box("d", {1.1, 1.2}, {0.1, 0.1}, 0.7)}) {
    same_with_boxes.obstacles.push_back(o);
    arena.walls.push_back({test::box_polygon(o)});
  }
  PhysicsWorld world(arena);
  for (const Vec2& p : {Vec2(0.2, 0.2), Vec2(0.6, 0.2), Vec2(1.4, 0.2), Vec2(0.2, 0.6),
                        Vec2(0.6, 1.4), Vec2(1.4, 1.4), Vec2(1.4, 1.0)}) {
    world.add_robot(s1r_model(), {p.x(), p.y(), 0.0});
  }
  ASSERT_EQ(deepest_overlap_m(world, same_with_boxes), 0.0);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  double deepest_m = 0.0;
  std::size_t touches = 0;
  for (int i = 0; i < 6000; ++i) {
    for (int r = 0; i % 50 == 0 && r < world.robot_count(); ++r) {
      world.set_target(r, {0.5 * uniform(random), 3.0 * uniform(random), 0.0});
    }
    world.step(kStep_s);
    for (const PhysicsWorld::Contact& contact : world.new_contacts()) {
      if (contact.kind == PhysicsWorld::Contact::Kind::kWall) ++touches;
    }
    deepest_m = std::max(deepest_m, deepest_overlap_m(world, same_with_boxes));
  }
  EXPECT_LT(deepest_m, 0.002);
  EXPECT_GT(touches, 20U);
}

// Three millimetres aside exceed the contact distance, but are less than the motion of a step.
TEST(PhysicsWorld, PassingRobot_NotDeflected) {
  double half_width_m = 0.0;
  for (const Vec2& v : s1r_model().footprint) half_width_m = std::max(half_width_m, v.y());
  constexpr double kAside_m = 0.003;
  const double y_m = 4.0 - half_width_m - kAside_m;
  const double wall_m = y_m - half_width_m - kAside_m;
  ArenaDescription arena = floor_4x4();
  arena.walls.push_back({{{1.5, 1.0}, {2.5, 1.0}, {2.5, wall_m}, {1.5, wall_m}}});
  PhysicsWorld world(arena);
  world.add_robot(s1r_model(), {1.0, y_m, 0.0});
  world.set_target(0, {0.5, 0.0, 0.0});
  for (int i = 1; i <= 400; ++i) {
    world.step(kStep_s);
    ASSERT_NEAR(world.body(0).X_WB.x_m, 1.0 + 0.005 * i, 1e-9);
    ASSERT_TRUE(world.new_contacts().empty());
  }
  EXPECT_EQ(world.body(0).X_WB.y_m, y_m);
  world.set_target(0, {0.5, 0.5, 0.0});  // towards the border
  run(world, 20);
  EXPECT_EQ(world.contacts_of(0).size(), 1U);
}

TEST(PhysicsWorld, RobotPlacedAtWall_TouchesUntilPlacedElsewhere) {
  PhysicsWorld world(floor_4x4());
  world.add_robot(s1r_model(), {2.0, 2.0, 0.0});
  run(world, 50);
  world.set_pose(0, {4.0 - 0.087 - 0.0016, 2.0, 0.0});
  world.step(kStep_s);
  ASSERT_EQ(world.new_contacts().size(), 1U);
  EXPECT_EQ(world.new_contacts()[0].kind, PhysicsWorld::Contact::Kind::kBorder);
  EXPECT_EQ(world.contacts_of(0).size(), 1U);
  run(world, 50);
  EXPECT_TRUE(world.new_contacts().empty()) << "it is still the same";
  EXPECT_EQ(world.contacts_of(0).size(), 1U);
  world.set_pose(0, {2.0, 2.0, 0.0});
  world.step(kStep_s);
  EXPECT_TRUE(world.contacts_of(0).empty());
}

TEST(PhysicsWorld, IsolatedRobots_Solid) {
  const PhysicsWorld::Contact kNothing{-1, PhysicsWorld::Contact::Kind::kObstacle, -1};
  PhysicsWorld world(floor_4x4());
  world.add_robot(s1r_model(), {1.4, 2.0, 0.0});
  world.add_robot(s1r_model(), {2.0, 2.0, 0.0});
  world.set_target(1, {0.2, 0.0, 0.0});
  run(world, 300);  // to (2.6, 2)
  EXPECT_TRUE(world.is_inside_solid({2.6, 2.0}, 0.1, 0));
  EXPECT_FALSE(world.is_inside_solid({2.6, 2.0}, 0.1, 1)) << "its own body does not count";
  EXPECT_FALSE(world.is_inside_solid({2.6, 2.0}, 0.3, 0)) << "above it";
  EXPECT_FALSE(world.is_inside_solid({2.0, 2.0}, 0.1, 0)) << "where it was";
  EXPECT_FALSE(world.is_line_free({1.4, 2.0}, {3.5, 2.0}, 0.1, 0, kNothing));
  EXPECT_TRUE(world.is_line_free({1.4, 2.0}, {3.5, 2.0}, 0.3, 0, kNothing));
  EXPECT_TRUE(world.is_line_free({1.4, 2.0}, {3.5, 2.0}, 0.1, 0,
                                 {0, PhysicsWorld::Contact::Kind::kRobot, 1}));
  EXPECT_TRUE(world.is_line_free({1.4, 2.0}, {2.5, 2.0}, 0.1, 0, kNothing)) << "ends before it";
  EXPECT_TRUE(world.is_line_free({1.4, 2.5}, {3.5, 2.5}, 0.1, 0, kNothing)) << "passes it";
  EXPECT_NEAR(world.ray_cast_m({1.4, 2.0}, 0.0, 5.0, 0), 2.6 - 0.087 - 1.4, 1e-5);
  EXPECT_NEAR(world.clearance_m(0, 5.0, 5.0), 2.6 - 0.087 - 1.487, 1e-5);
  ObstacleDescription place = box("place", {2.6, 2.0}, {0.1, 0.1});
  EXPECT_EQ(world.robot_within(place), 1);
}

TEST(PhysicsWorld, RobotsFromAfar_CollideOnceAndPushEvenly) {
  const ArenaDescription arena = floor_4x4();
  PhysicsWorld world(arena);
  world.add_robot(s1r_model(), {1.0, 2.0, 0.0});
  world.add_robot(s1r_model(), {3.0, 2.0, kPi});
  for (int r = 0; r < 2; ++r) world.set_target(r, {0.4, 0.0, 0.0});
  std::size_t begun = 0;
  for (int i = 0; i < 500; ++i) {
    world.step(kStep_s);
    begun += world.new_contacts().size();
    ASSERT_LT(deepest_overlap_m(world, arena), 0.002) << "step " << i;
  }
  EXPECT_EQ(begun, 2U) << "once for each";
  EXPECT_NEAR(world.body(0).X_WB.x_m + world.body(1).X_WB.x_m, 4.0, 0.01);
  EXPECT_TRUE(world.body(0).stalled);
  EXPECT_TRUE(world.body(1).stalled);
}

TEST(PhysicsWorld, Clearance_DistanceToNearestSolid) {
  ArenaDescription arena = floor_4x4();
  arena.obstacles.push_back(box("b", {2.0, 2.0}, {0.2, 0.2}));
  PhysicsWorld world(arena);
  // The side of the footprint is 0.081 m from the axle's centre; the block's face is at x = 2.1.
  // The robot is rotated by 90 degrees, so its left side is at x - 0.081.
  world.add_robot(s1r_model(), {2.5, 2.0, kPi / 2.0});
  EXPECT_NEAR(world.clearance_m(0, 1.0, 1.0), 2.5 - 0.081 - 2.1, 1e-5);
  EXPECT_EQ(world.clearance_m(0, 0.1, 0.1), 0.1);
  // Above 0.2 m a bound is sufficient.
  EXPECT_GE(world.clearance_m(0, 1.0, 0.2), 0.2);
  EXPECT_LE(world.clearance_m(0, 1.0, 0.2), 2.5 - 0.081 - 2.1 + 1e-5);
}

}  // namespace
}  // namespace sim
