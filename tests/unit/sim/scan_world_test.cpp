// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// The scan of a robot, with edges collected from the physics, compared with b2World::RayCast.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "physics/physics_world.h"
#include "random_numbers.h"
#include "sim/devices/laser.h"
#include "sim/simulation/simulation.h"

namespace sim {
namespace {

// True if the ranges jump near a beam: a corner is within half a beam of it.
bool near_corner(const PhysicsWorld& physics, const Vec2& p_WL, double angle_rad, double step_rad,
                 double range_max_m, int own) {
  const double middle = physics.ray_cast_m(p_WL, angle_rad, range_max_m, own);
  for (const double offset : {-0.5, -0.25, -0.1, 0.1, 0.25, 0.5}) {
    const double r = physics.ray_cast_m(p_WL, angle_rad + offset * step_rad, range_max_m, own);
    if (std::abs(r - middle) > 0.02) return true;
  }
  return false;
}

TEST(ScanOfTheWorld, ThirteenRobots_MatchRayCastsAtTenThousandPoses) {
  const WorldDescription world =
      load_world(PLAYPEN_SOURCE_DIR "/worlds/examples/thirteen_robots.json");
  PhysicsWorld physics(world.arena);
  for (const RobotDescription& robot : world.robots) {
    physics.add_robot(*find_robot_model(world, robot.model), robot.pose);
  }
  const LaserParams laser;
  scan::ScanKernel kernel({laser.beam_count, laser.resolution_rad, laser.range_max_m});
  scan::EdgeBuffer edges;
  std::vector<double> ranges(static_cast<std::size_t>(laser.beam_count));
  test::Random random(1);
  long beams = 0;
  long at_corners = 0;
  for (int pose = 0; pose < 10'000; ++pose) {
    const Vec2 p_WL(random.uniform(0.01, 3.41), random.uniform(0.01, 3.71));
    const double yaw = random.uniform(-std::numbers::pi, std::numbers::pi);
    const int own = pose % 14 - 1;  // none, or one of the robots that the scan ignores
    physics.collect_edges(p_WL, laser.range_max_m, laser.height_m, own, true, edges);
    if (edges.inside) {
      --pose;  // inside a block or a robot there is nothing to compare: Box2D sees nothing there
      continue;
    }
    kernel.scan(edges, yaw, ranges);
    // Every eleventh beam, with a different offset each time, keeps the test short.
    for (int beam = pose % 11; beam < laser.beam_count; beam += 11) {
      ++beams;
      const double angle = yaw + kernel.geometry().angle_rad(beam);
      const double cast = physics.ray_cast_m(p_WL, angle, laser.range_max_m, own);
      if (std::abs(ranges[static_cast<std::size_t>(beam)] - cast) <= 0.001) continue;
      ++at_corners;
      ASSERT_TRUE(near_corner(physics, p_WL, angle, laser.resolution_rad, laser.range_max_m, own))
          << "pose " << p_WL.transpose() << ", angle " << angle << ": scan "
          << ranges[static_cast<std::size_t>(beam)] << ", ray cast " << cast;
    }
  }
  EXPECT_LE(at_corners, beams / 500) << "of " << beams;  // 0.2 %
}

TEST(ScanOfTheWorld, HiddenRobotsOfCrowd_LeftOutWithoutDifference) {
  const WorldDescription world = load_world(PLAYPEN_SOURCE_DIR "/worlds/cave.json");
  const RobotModel& model = *find_robot_model(world, "pioneer2dx");
  test::Random random(2);
  PhysicsWorld physics(world.arena);
  for (int i = 0; i < 200; ++i) {
    physics.add_robot(
        model, {random.uniform(-8.0, 8.0), random.uniform(-8.0, 8.0), random.uniform(-3.0, 3.0)});
  }
  scan::EdgeBuffer edges;
  for (const scan::ScanGeometry& geometry :
       {scan::ScanGeometry{181, std::numbers::pi / 180.0, 8.0},
        scan::ScanGeometry{682, 0.0069, 5.0}, scan::ScanGeometry{361, 0.0174, 30.0}}) {
    scan::ScanKernel kernel(geometry);
    std::vector<double> whole(static_cast<std::size_t>(geometry.beam_count));
    std::vector<double> parts(whole.size());
    for (int pose = 0; pose < 400; ++pose) {
      const Pose X_WL{random.uniform(-7.9, 7.9), random.uniform(-7.9, 7.9),
                      random.uniform(-4.0, 4.0)};
      const int own = pose % 201 - 1;
      const double height_m = pose % 2 == 0 ? 0.1 : 0.23;  // above all robots
      physics.collect_edges(X_WL.position(), geometry.range_max_m, height_m, own, true, edges);
      kernel.scan(edges, X_WL.yaw_rad, whole);
      physics.scan(geometry, X_WL, height_m, own, true, parts);
      ASSERT_EQ(parts, whole) << "pose " << pose;
    }
  }
}

TEST(ScanOfTheWorld, HundredThousandEdges_InRangeOnlyCollected) {
  // 25 000 boxes of 0.1 m, one per metre, on 158 x 158 m.
  ArenaDescription arena;
  arena.size = {159.0, 159.0};
  for (int i = 0; i < 25'000; ++i) {
    ObstacleDescription o;
    o.name = std::to_string(i);
    o.center = {1.0 + i % 158, 1.0 + static_cast<double>(i / 158)};
    o.size = {0.1, 0.1};
    arena.obstacles.push_back(o);
  }
  PhysicsWorld physics(arena);
  scan::EdgeBuffer edges;
  physics.collect_edges({80.5, 80.5}, 3.0, 0.125, -1, true, edges);
  // Boxes whose broadphase box intersects the square of +-3 m: at most 8 x 8.
  EXPECT_GE(edges.size(), 6U * 6U * 4U);
  EXPECT_LE(edges.size(), 8U * 8U * 4U);
  EXPECT_FALSE(edges.inside);
  scan::ScanKernel kernel({360, std::numbers::pi / 180.0, 3.0});
  std::vector<double> ranges(360);
  kernel.scan(edges, 0.0, ranges);
  for (int beam = 0; beam < 360; ++beam) {
    const double cast =
        physics.ray_cast_m({80.5, 80.5}, kernel.geometry().angle_rad(beam), 3.0, -1);
    EXPECT_NEAR(ranges[static_cast<std::size_t>(beam)], cast, 0.001) << "beam " << beam;
  }
}

TEST(ScanOfTheWorld, MapWalls_InsideAndHolesKnown) {
  // A square ring: outer 1..3 counter-clockwise, hole 1.5..2.5 clockwise.
  ArenaDescription arena;
  arena.size = {4.0, 4.0};
  arena.walls.push_back({{{1, 1}, {3, 1}, {3, 3}, {1, 3}}});
  arena.walls.push_back({{{1.5, 1.5}, {1.5, 2.5}, {2.5, 2.5}, {2.5, 1.5}}});
  PhysicsWorld physics(arena);
  scan::EdgeBuffer edges;
  const auto inside = [&](double x, double y) {
    physics.collect_edges({x, y}, 5.0, 0.125, -1, true, edges);
    return edges.inside;
  };
  EXPECT_FALSE(inside(0.5, 2.0));
  EXPECT_TRUE(inside(1.2, 2.0));
  EXPECT_FALSE(inside(2.0, 2.0));
  EXPECT_TRUE(inside(2.7, 2.2));
  EXPECT_FALSE(inside(3.5, 1.0));
}

}  // namespace
}  // namespace sim
