// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Parts of robots that are higher than their bodies: what sensors at each height see of them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "physics/physics_world.h"
#include "polygon_overlap.h"
#include "random_numbers.h"
#include "reference_scan.h"
#include "sim/core/error.h"
#include "sim/devices/laser.h"
#include "sim/simulation/simulation.h"
#include "sim/simulation/world_hash.h"
#include "sim/world/robot_model.h"
#include "temporary_folder.h"

namespace sim {
namespace {

using test::placed;
using Kind = PhysicsWorld::Contact::Kind;
const PhysicsWorld::Contact kNothing{-1, Kind::kObstacle, -1};

// A body of 0.4 m and 0.2 m height; on it a laser up to 0.4 m, and a bar up to 1 m that is wider
// than the body: 0.1 m x 0.8 m.
RobotModel tall_model() {
  RobotModel model = s1r_model();
  model.name = "tall";
  model.footprint = {{-0.2, -0.2}, {0.2, -0.2}, {0.2, 0.2}, {-0.2, 0.2}};
  model.height_m = 0.2;
  model.superstructures = {
      {{{0.0, -0.1}, {0.15, -0.1}, {0.15, 0.1}, {0.0, 0.1}}, 0.4},
      {{{-0.15, -0.4}, {-0.05, -0.4}, {-0.05, 0.4}, {-0.15, 0.4}}, 1.0},
  };
  return model;
}

ArenaDescription floor_of(double side_m) {
  ArenaDescription arena;
  arena.size = {side_m, side_m};
  return arena;
}

// The slow, exact reference: each beam against each edge of what is higher than the sensor.
std::vector<double> exact_scan(const PhysicsWorld& physics, const std::vector<RobotModel>& models,
                               const ArenaDescription& arena, const scan::ScanGeometry& geometry,
                               const Pose& X_WL, double height_m, int own,
                               std::vector<double>& corner_off_rad) {
  std::vector<scan::Edge> edges;
  const auto add = [&](const Polygon& outline) {
    for (std::size_t i = 0; i < outline.size(); ++i) {
      const Vec2 a = outline[i] - X_WL.position();
      const Vec2 b = outline[(i + 1) % outline.size()] - X_WL.position();
      edges.push_back({static_cast<float>(a.x()), static_cast<float>(a.y()),
                       static_cast<float>(b.x()), static_cast<float>(b.y())});
    }
  };
  const double side_m = arena.size.x();
  if (arena.border_height_m > height_m) {
    add({{0.0, 0.0}, {0.0, side_m}, {side_m, side_m}, {side_m, 0.0}});  // seen from inside
  }
  for (std::size_t i = 0; i < models.size(); ++i) {
    if (static_cast<int>(i) == own) continue;
    const Pose& X_WB = physics.body(static_cast<int>(i)).X_WB;
    if (models[i].height_m > height_m) add(placed(models[i].footprint, X_WB));
    for (const Superstructure& part : models[i].superstructures) {
      if (part.height_m > height_m) add(placed(part.outline, X_WB));
    }
  }
  std::vector<double> ranges;
  for (const auto& beam : playpen::test::reference_scan(edges, geometry, X_WL.yaw_rad)) {
    ranges.push_back(beam.range_m);
    corner_off_rad.push_back(beam.corner_off_rad);
  }
  return ranges;
}

TEST(Superstructures, Heights_Visible) {
  const ArenaDescription arena = floor_of(8.0);
  PhysicsWorld physics(arena);
  physics.add_robot(tall_model(), {4.0, 4.0, 0.0});
  scan::EdgeBuffer edges;
  std::vector<double> range(1);
  scan::ScanKernel kernel({1, 0.1, 3.0});
  const auto range_at = [&](double height_m, double y_m) {
    physics.collect_edges({2.0, y_m}, 3.0, height_m, -1, true, edges);
    kernel.scan(edges, 0.0, range);
    std::vector<double> fast(1);
    physics.scan(kernel.geometry(), {2.0, y_m, 0.0}, height_m, -1, true, fast);
    EXPECT_EQ(fast, range);
    return range[0];
  };
  EXPECT_NEAR(range_at(0.1, 4.05), 1.8, 1e-6) << "the body";
  EXPECT_NEAR(range_at(0.3, 4.05), 1.85, 1e-6) << "the bar, behind the body's front";
  EXPECT_NEAR(range_at(0.3, 4.3), 1.85, 1e-6) << "the bar beside the body";
  EXPECT_NEAR(range_at(0.5, 4.05), 1.85, 1e-6);
  EXPECT_DOUBLE_EQ(range_at(1.1, 4.05), 3.0) << "above all";
  physics.set_pose(0, {4.0, 4.0, std::numbers::pi});  // its laser in front now
  EXPECT_NEAR(range_at(0.3, 4.05), 1.85, 1e-6) << "the laser";
  EXPECT_NEAR(range_at(0.3, 4.15), 2.05, 1e-6) << "the bar, beside the laser";
  EXPECT_NEAR(range_at(0.5, 4.05), 2.05, 1e-6) << "the bar, above the laser";
}

TEST(Superstructures, HundredRobots_MatchSlowReference) {
  const ArenaDescription arena = floor_of(12.0);
  PhysicsWorld physics(arena);
  test::Random random(3);
  std::vector<RobotModel> models;
  for (int i = 0; i < 100; ++i) {
    models.push_back(i % 3 == 0 ? s1r_model() : tall_model());
    physics.add_robot(models.back(), {random.uniform(0.5, 11.5), random.uniform(0.5, 11.5),
                                      random.uniform(-3.0, 3.0)});
  }
  const scan::ScanGeometry geometry{181, std::numbers::pi / 180.0, 8.0};
  std::vector<double> ranges(181);
  int beams = 0;
  for (int pose = 0; pose < 300; ++pose) {
    const Pose X_WL{random.uniform(0.3, 11.7), random.uniform(0.3, 11.7),
                    random.uniform(-4.0, 4.0)};
    const int own = pose % 101 - 1;
    const double height_m =
        std::vector{0.1, 0.19, 0.3, 0.6, 1.2}[static_cast<std::size_t>(pose % 5)];
    if (physics.is_inside_solid(X_WL.position(), height_m, own)) continue;
    physics.scan(geometry, X_WL, height_m, own, true, ranges);
    std::vector<double> corner_off_rad;
    const std::vector<double> exact =
        exact_scan(physics, models, arena, geometry, X_WL, height_m, own, corner_off_rad);
    for (std::size_t beam = 0; beam < ranges.size(); ++beam) {
      if (corner_off_rad[beam] < 1e-4) continue;  // a corner may be met or missed
      ++beams;
      ASSERT_NEAR(ranges[beam], exact[beam], 1e-4) << "pose " << pose << ", beam " << beam;
    }
  }
  EXPECT_GT(beams, 40'000);
}

TEST(Superstructures, HideWhatIsBehindAndAreSolidForPoints) {
  PhysicsWorld physics(floor_of(8.0));
  physics.add_robot(s1r_model(), {1.0, 1.0, 0.0});
  physics.add_robot(tall_model(), {4.0, 4.0, 0.0});
  EXPECT_TRUE(physics.is_inside_solid({3.9, 4.3}, 0.5, 0)) << "in the bar";
  EXPECT_FALSE(physics.is_inside_solid({3.9, 4.3}, 1.5, 0)) << "above the bar";
  EXPECT_FALSE(physics.is_inside_solid({3.9, 4.3}, 0.5, 1)) << "its own";
  EXPECT_FALSE(physics.is_inside_solid({4.1, 4.15}, 0.5, 0)) << "above the body, beside the bar";
  EXPECT_FALSE(physics.is_line_free({3.0, 4.3}, {5.0, 4.3}, 0.5, 0, kNothing));
  EXPECT_TRUE(physics.is_line_free({3.0, 4.3}, {5.0, 4.3}, 1.5, 0, kNothing));
  EXPECT_TRUE(physics.is_line_free({3.0, 4.45}, {5.0, 4.45}, 0.5, 0, kNothing)) << "passes it";
  EXPECT_TRUE(physics.is_line_free({3.0, 4.3}, {5.0, 4.3}, 0.5, 1, kNothing)) << "its own";
  EXPECT_TRUE(physics.is_line_free({3.0, 4.3}, {5.0, 4.3}, 0.5, 0, {1, Kind::kRobot, 1}));
  EXPECT_TRUE(physics.is_line_free({3.9, 4.3}, {5.0, 4.3}, 0.5, 0, kNothing)) << "starts in it";
  EXPECT_NEAR(physics.ray_cast_m({3.0, 4.3}, 0.0, 5.0, 0), 0.85, 1e-6);
  std::vector<PhysicsWorld::Face> faces;
  physics.collect_faces({3.0, 3.0}, {5.0, 5.0}, 0, faces);
  int high = 0;
  for (const PhysicsWorld::Face& face : faces) {
    if (face.kind != Kind::kRobot) continue;
    EXPECT_EQ(face.index, 1);
    if (face.height_m == 1.0) ++high;
  }
  EXPECT_EQ(high, 4) << "the four sides of the bar";
}

TEST(Superstructures, NoCollisions) {
  PhysicsWorld physics(floor_of(8.0));
  physics.add_robot(tall_model(), {4.0, 4.0, 0.0});
  physics.add_robot(tall_model(), {4.0, 4.6, 0.0});  // the bars overlap, the bodies do not
  for (int i = 0; i < 100; ++i) physics.step(0.01);
  EXPECT_EQ(physics.body(0).X_WB, (Pose{4.0, 4.0, 0.0}));
  EXPECT_EQ(physics.body(1).X_WB, (Pose{4.0, 4.6, 0.0}));
  EXPECT_TRUE(physics.contacts_of(0).empty());
}

const char* const kTwoRobots =
    R"({"arena": {"size": [6, 6], "border_height": 2}, "robots": [
      {"name": "seer", "model": "s1r", "pose": {"x": 1, "y": 3, "yaw_deg": 0},
       "devices": {"laser": {"height": 0.3}}},
      {"name": "seen", "model": "tall.json", "pose": {"x": 3, "y": 3, "yaw_deg": 0}}]})";

WorldDescription two_robots(const std::string& superstructures) {
  test_support::TemporaryFolder folder;
  folder.write("tall.json",
               R"({"name": "tall", "height": 0.2, "footprint": [[-0.2, -0.2], [0.2, -0.2], )"
               R"([0.2, 0.2], [-0.2, 0.2]])" +
                   superstructures + "}");
  return load_world(folder.write("room.json", kTwoRobots));
}

double range_ahead_m(const WorldDescription& world) {
  Simulation simulation(world);
  for (int i = 0; i < 20; ++i) simulation.step();
  const auto& laser =
      dynamic_cast<const Laser&>(simulation.device(0, simulation.find_device(0, "laser").value()));
  return laser.reading().ranges_m[laser.reading().ranges_m.size() / 2];
}

TEST(Superstructures, ModelFile_SeenByWorldLasers) {
  const WorldDescription low = two_robots("");
  // Clockwise, which is as good.
  const WorldDescription high = two_robots(
      R"(, "superstructures": [{"height": 0.5, "outline": [[0, 0.1], [0.1, 0.1], [0.1, -0.1], [0, -0.1]]}])");
  // The laser is 35 mm before the middle of the robot, at x = 1.035.
  EXPECT_NEAR(range_ahead_m(low), 6.0 - 1.035, 1e-3) << "looks over the body, to the border";
  EXPECT_NEAR(range_ahead_m(high), 3.0 - 1.035, 1e-3);
  EXPECT_NE(world_hash(low), world_hash(high));
  EXPECT_THAT(Simulation(high).robot_snapshot(1).superstructures, testing::SizeIs(1));
}

TEST(Superstructures, Invalid_Errors) {
  const auto error_of = [](const std::string& part) {
    try {
      static_cast<void>(two_robots(R"(, "superstructures": [)" + part + "]"));
    } catch (const ConfigError& error) {
      if (error.issues().size() != 1) return std::to_string(error.issues().size()) + " issues";
      return error.issues()[0].id + " " + error.issues()[0].pointer;
    }
    return std::string("none");
  };
  const std::string outline = R"("outline": [[0, 0], [0.1, 0], [0, 0.1]])";
  EXPECT_EQ(error_of("{" + outline + R"(, "height": 0.3})"), "none");
  EXPECT_EQ(error_of("{" + outline + R"(, "height": 0.2})"),
            "world/bad-superstructure /superstructures/0/height");
  EXPECT_EQ(error_of("{" + outline + R"(, "height": 11})"),
            "world/out-of-range /superstructures/0/height");
  EXPECT_EQ(error_of("{" + outline + R"(, "height": 0.3, "bottom": 0.3})"),
            "world/bad-superstructure /superstructures/0/bottom");
  EXPECT_EQ(error_of("{" + outline + "}"), "world/missing-key /superstructures/0");
  EXPECT_EQ(error_of(R"({"height": 0.3})"), "world/missing-key /superstructures/0");
  EXPECT_EQ(error_of(R"({"height": 0.3, "outline": [[0, 0], [1, 0]]})"),
            "world/bad-superstructure /superstructures/0/outline");
  EXPECT_EQ(error_of(R"({"height": 0.3, "outline": [[0, 0], [2, 0], [1, 0.5], [2, 2], [0, 2]]})"),
            "world/bad-superstructure /superstructures/0/outline");
  EXPECT_EQ(error_of(R"({"height": 0.3, "outline": [[0, 0], [0.0011, 0], [0.0011, 0.0011]]})"),
            "world/bad-superstructure /superstructures/0/outline");
  EXPECT_EQ(error_of("{" + outline + R"(, "height": 0.3, "top": 1})"),
            "world/unknown-key /superstructures/0/top");
  EXPECT_EQ(error_of("3"), "world/wrong-type /superstructures/0");
  std::string many = "{" + outline + R"(, "height": 0.3})";
  for (int i = 0; i < 32; ++i) many += ", {" + outline + R"(, "height": 0.3})";
  EXPECT_NE(error_of(many), "none");
}

TEST(Superstructures, ModelsInMemory_Checked) {
  WorldDescription world = two_robots("");
  auto model = std::make_shared<RobotModel>(*find_robot_model(world, "tall.json"));
  model->superstructures = {{{{0.0, 0.0}, {0.1, 0.0}, {0.0, 0.1}}, 0.1}};
  world.models["tall.json"] = model;
  try {
    const Simulation simulation(world);
    FAIL() << "accepted";
  } catch (const ConfigError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("superstructures/0/height"));
  }
}

}  // namespace
}  // namespace sim
