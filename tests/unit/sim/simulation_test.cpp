// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/simulation/simulation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>

#include "physics/physics_world.h"
#include "random_numbers.h"
#include "sim/core/error.h"
#include "sim/core/hash.h"
#include "sim/devices/laser.h"
#include "sim/devices/localization.h"

namespace sim {
namespace {

using testing::HasSubstr;

// A robot at the centre of an empty 4 x 4 m room; `devices` are its settings.
WorldDescription room(const std::string& devices = "{}", const std::string& more = "") {
  return load_world_text(
      R"({"arena": {"size": [4, 4]}, "robots": [{"name": "r1", "pose": {"x": 2, "y": 2, "yaw_deg": 0},
          "devices": )" +
      devices + "}]" + more + "}");
}

template <typename ReadingType>
const ReadingType& reading(const Simulation& simulation, const std::string& device, int robot = 0) {
  const int index = simulation.find_device(robot, device).value();
  return dynamic_cast<const ReadingType&>(
      dynamic_cast<const Sensor&>(simulation.device(robot, index)).reading());
}

void command(Simulation& simulation, const std::string& device, const Command& what,
             int robot = 0) {
  const auto refusal =
      simulation.apply({robot, simulation.find_device(robot, device).value()}, what);
  ASSERT_FALSE(refusal.has_value()) << *refusal;
}

void drive(Simulation& simulation, double v, double omega, int robot = 0) {
  command(simulation, "motion", TwistCommand{{.v_mps = v, .omega_radps = omega}}, robot);
}

void run(Simulation& simulation, int steps) {
  for (int i = 0; i < steps; ++i) simulation.step();
}

TEST(Simulation, FirstReadings_OnePeriodAfterStartInPhase) {
  Simulation simulation(room());
  run(simulation, 9);
  EXPECT_TRUE(simulation.updated().empty());
  run(simulation, 1);
  EXPECT_EQ(simulation.updated().size(), 3U);  // laser, odometry, pose
  EXPECT_EQ(reading<LaserReading>(simulation, "laser").time_ns, 100'000'000);
  EXPECT_EQ(reading<PoseReading>(simulation, "pose").sequence, 1U);
  run(simulation, 10);
  EXPECT_EQ(simulation.updated().size(), 3U);
  EXPECT_EQ(reading<PoseReading>(simulation, "pose").sequence, 2U);
}

TEST(Simulation, FrequencyOffStep_KeptOnAverage) {
  Simulation simulation(room(R"({"laser": {"frequency": 30}})"));
  run(simulation, 1000);
  EXPECT_EQ(reading<LaserReading>(simulation, "laser").sequence, 300U);
}

TEST(Simulation, SensorFasterThanStep_MeasuresOncePerStep) {
  Simulation simulation(room(R"({"pose": {"frequency": 1000}})"));
  run(simulation, 50);
  EXPECT_EQ(reading<PoseReading>(simulation, "pose").sequence, 50U);
}

TEST(Simulation, Pose_TrueAndOdometryStartsAtZero) {
  Simulation simulation(room());
  drive(simulation, 0.5, 0.0);
  run(simulation, 100);
  EXPECT_NEAR(reading<PoseReading>(simulation, "pose").pose.x_m, 2.5, 1e-9);
  EXPECT_NEAR(reading<PoseReading>(simulation, "pose").pose.y_m, 2.0, 1e-9);
  EXPECT_NEAR(reading<PoseReading>(simulation, "odometry").pose.x_m, 0.5, 1e-9);
  EXPECT_NEAR(reading<PoseReading>(simulation, "odometry").twist.v_mps, 0.5, 1e-9);
}

TEST(Simulation, Odometry_FollowsArc) {
  Simulation simulation(room());
  drive(simulation, 0.3, 0.6);
  run(simulation, 500);  // 3 rad on a circle of 0.5 m
  const Pose pose = reading<PoseReading>(simulation, "odometry").pose;
  EXPECT_NEAR(pose.x_m, 0.5 * std::sin(3.0), 1e-9);
  EXPECT_NEAR(pose.y_m, 0.5 * (1.0 - std::cos(3.0)), 1e-9);
  EXPECT_NEAR(pose.yaw_rad, 3.0, 1e-9);
}

TEST(Simulation, Odometry_ContinuesFromSetPose) {
  Simulation simulation(room());
  command(simulation, "odometry", SetPoseCommand{{1.0, -2.0, std::numbers::pi / 2.0}});
  drive(simulation, 0.5, 0.0);
  run(simulation, 100);
  const Pose pose = reading<PoseReading>(simulation, "odometry").pose;
  EXPECT_NEAR(pose.x_m, 1.0, 1e-9);
  EXPECT_NEAR(pose.y_m, -1.5, 1e-9);
}

TEST(Simulation, Pose_RebasedToGivenPose) {
  Simulation simulation(room());
  run(simulation, 10);
  command(simulation, "pose", SetPoseCommand{{0.0, 0.0, 0.0}});
  drive(simulation, 0.5, 0.0);
  run(simulation, 100);
  EXPECT_NEAR(reading<PoseReading>(simulation, "pose").pose.x_m, 0.5, 1e-9);
  EXPECT_NEAR(simulation.body(0).X_WB.x_m, 2.5, 1e-9);
}

TEST(Simulation, Twists_ClampedToLimits) {
  Simulation simulation(room());
  drive(simulation, 9.0, -9.0);
  run(simulation, 1);
  EXPECT_EQ(simulation.body(0).commanded.v_mps, 0.5);
  EXPECT_EQ(simulation.body(0).commanded.omega_radps, -3.0);
}

TEST(Simulation, MotorsOff_StopUntilOnAndCommanded) {
  Simulation simulation(room());
  drive(simulation, 0.3, 0.0);
  run(simulation, 10);
  command(simulation, "motion", MotorEnableCommand{false});
  drive(simulation, 0.3, 0.0);
  run(simulation, 10);
  EXPECT_NEAR(simulation.body(0).X_WB.x_m, 2.03, 1e-9);
  command(simulation, "motion", MotorEnableCommand{true});
  run(simulation, 10);
  EXPECT_NEAR(simulation.body(0).X_WB.x_m, 2.03, 1e-9);
  drive(simulation, 0.3, 0.0);
  run(simulation, 10);
  EXPECT_NEAR(simulation.body(0).X_WB.x_m, 2.06, 1e-9);
}

TEST(Simulation, AccelerationLimit_RampsSpeed) {
  Simulation simulation(room(R"({"motion": {"max_acceleration": 0.5}})"));
  drive(simulation, 0.4, 0.0);
  run(simulation, 40);  // 0.5 m/s^2 for 0.4 s: 0.2 m/s
  EXPECT_NEAR(simulation.body(0).twist.v_mps, 0.2, 1e-6);
  run(simulation, 60);
  EXPECT_NEAR(simulation.body(0).twist.v_mps, 0.4, 1e-6);
}

TEST(Simulation, Actuator_RefusesForeignCommands) {
  Simulation simulation(room());
  const auto refusal =
      simulation.apply({0, simulation.find_device(0, "pen").value()}, TwistCommand{{.v_mps = 0.1}});
  ASSERT_TRUE(refusal.has_value());
  EXPECT_THAT(*refusal, HasSubstr("pen"));
}

TEST(Simulation, S1rLaser_MeasuresWallFromItsMount) {
  Simulation simulation(room());
  run(simulation, 10);
  const LaserReading& scan = reading<LaserReading>(simulation, "laser");
  ASSERT_EQ(scan.ranges_m.size(), 682U);
  // Beams 340 and 341 are half a step left and right of straight ahead: 1.965 m to the wall at x =
  // 4.
  const double half = 0.5 * scan.resolution_rad;
  EXPECT_NEAR(scan.ranges_m[340], 1.965 / std::cos(half), 1e-5);
  EXPECT_NEAR(scan.ranges_m[341], 1.965 / std::cos(half), 1e-5);
  EXPECT_NEAR(scan.angle_min_rad, -0.5 * 681 * 0.39589 * std::numbers::pi / 180.0, 1e-12);
  // The nearest point of the room is straight ahead.
  EXPECT_NEAR(scan.least_range_m(), 1.965, 1e-4);
  EXPECT_NEAR(std::abs(scan.least_angle_rad()), half, 1e-12);  // either of the two
}

TEST(Simulation, LaserInsideObstacle_ReadsZero) {
  // Mounted 0.5 m ahead of the axle, in the middle of a block.
  Simulation simulation(load_world_text(
      R"({"arena": {"size": [4, 4], "obstacles": [{"name": "b", "center": [2.5, 2], "size": [0.2, 0.2]}]},
          "robots": [{"pose": {"x": 2, "y": 2}, "devices": {"laser": {"pose": {"x": 0.5}}}}]})"));
  run(simulation, 10);
  EXPECT_THAT(reading<LaserReading>(simulation, "laser").ranges_m, testing::Each(0.0));
}

TEST(Simulation, Laser_OverLowAndThroughRetractedObstacles) {
  Simulation simulation(load_world_text(
      R"({"arena": {"size": [4, 4], "obstacles": [
            {"name": "low", "center": [2.5, 2], "size": [0.2, 0.4], "height": 0.1},
            {"name": "down", "type": "dynamic", "state": "retracted", "center": [3, 2], "size": [0.2, 0.4]}]},
          "robots": [{"pose": {"x": 2, "y": 2}}]})"));
  run(simulation, 10);
  EXPECT_NEAR(reading<LaserReading>(simulation, "laser").ranges_m[340], 1.965, 1e-3);
  EXPECT_FALSE(simulation.set_obstacle_state("down", ObstacleState::kExtended).has_value());
  run(simulation, 10);
  EXPECT_NEAR(reading<LaserReading>(simulation, "laser").ranges_m[340], 0.865, 1e-3);
}

TEST(Simulation, Blocks_RefuseToRiseUnderRobotOrIfStaticOrUnknown) {
  Simulation simulation(load_world_text(
      R"({"arena": {"size": [4, 4], "obstacles": [
            {"name": "s", "center": [1, 1], "size": [0.2, 0.2]},
            {"name": "d", "type": "dynamic", "state": "retracted", "center": [2, 2], "size": [0.2, 0.2]}]},
          "robots": [{"pose": {"x": 2, "y": 2}}]})"));
  EXPECT_THAT(simulation.set_obstacle_state("d", ObstacleState::kExtended).value(),
              HasSubstr("robot"));
  EXPECT_THAT(simulation.set_obstacle_state("s", ObstacleState::kRetracted).value(),
              HasSubstr("static"));
  EXPECT_THAT(simulation.set_obstacle_state("x", ObstacleState::kRetracted).value(),
              HasSubstr("no obstacle"));
}

TEST(Simulation, LaserNoise_HasRequestedDeviation) {
  Simulation simulation(room(R"({"laser": {"noise": 0.02}})"));
  Simulation exact(room());
  // 682 beams x 100 scans: standard error of the deviation is 0.02 / sqrt(2 n).
  double sum = 0.0;
  double squares = 0.0;
  int n = 0;
  for (int i = 0; i < 100; ++i) {
    run(simulation, 10);
    run(exact, 10);
    const auto& noisy = reading<LaserReading>(simulation, "laser").ranges_m;
    const auto& clean = reading<LaserReading>(exact, "laser").ranges_m;
    for (std::size_t k = 0; k < noisy.size(); ++k, ++n) {
      const double error = noisy[k] - clean[k];
      sum += error;
      squares += error * error;
    }
  }
  EXPECT_NEAR(sum / n, 0.0, 4.0 * 0.02 / std::sqrt(n));
  EXPECT_NEAR(std::sqrt(squares / n), 0.02, 4.0 * 0.02 / std::sqrt(2.0 * n));
}

TEST(Simulation, PoseNoise_HasRequestedDeviation) {
  Simulation simulation(room(R"({"pose": {"noise": 0.05, "noise_yaw_deg": 2, "frequency": 100}})"));
  double x2 = 0.0;
  double yaw2 = 0.0;
  constexpr int kCount = 20000;
  for (int i = 0; i < kCount; ++i) {
    simulation.step();
    const Pose pose = reading<PoseReading>(simulation, "pose").pose;
    x2 += (pose.x_m - 2.0) * (pose.x_m - 2.0);
    yaw2 += pose.yaw_rad * pose.yaw_rad;
  }
  const double tolerance = 4.0 / std::sqrt(2.0 * kCount);  // four standard errors, relative
  EXPECT_NEAR(std::sqrt(x2 / kCount), 0.05, 0.05 * tolerance);
  const double two_degrees = 2.0 * std::numbers::pi / 180.0;
  EXPECT_NEAR(std::sqrt(yaw2 / kCount), two_degrees, two_degrees * tolerance);
}

TEST(Simulation, OdometryNoise_GrowsWithRootOfDistance) {
  // Straight ahead for 1 m with noise 0.03: the path of each wheel has an error of 0.03 m (1
  // sigma), so their mean has one of 0.03 / sqrt(2). 400 robots one after another, seeds 1 to 400.
  double squares = 0.0;
  constexpr int kRuns = 400;
  WorldDescription world = room(R"({"odometry": {"noise": 0.03}})");
  for (int seed = 1; seed <= kRuns; ++seed) {
    world.simulation.seed = static_cast<std::uint64_t>(seed);
    Simulation simulation(world);
    drive(simulation, 0.5, 0.0);
    run(simulation, 200);
    const Pose pose = reading<PoseReading>(simulation, "odometry").pose;
    // The length of the curve; to first order, it is the distance from the start.
    const double along = std::hypot(pose.x_m, pose.y_m) - 1.0;
    squares += along * along;
  }
  const double sigma = 0.03 / std::sqrt(2.0);
  // The chord of a path that bends by up to 0.4 rad is about 1 % shorter, which is within the
  // bound.
  EXPECT_NEAR(std::sqrt(squares / kRuns), sigma, sigma * 4.0 / std::sqrt(2.0 * kRuns) + 0.005);
}

TEST(Simulation, NewSensor_KeepsNoiseOfOthers) {
  Simulation plain(room(R"({"laser": {"noise": 0.02}})"));
  Simulation more(room(R"({"laser": {"noise": 0.02}, "second": {"type": "laser", "noise": 0.1}})"));
  run(plain, 50);
  run(more, 50);
  EXPECT_EQ(reading<LaserReading>(plain, "laser").ranges_m,
            reading<LaserReading>(more, "laser").ranges_m);
}

TEST(Simulation, Collisions_CountedWithTimeAndPartner) {
  Simulation simulation(room());
  drive(simulation, 0.5, 0.0);
  run(simulation, 500);
  EXPECT_EQ(simulation.statistics(0).collisions, 1);
  EXPECT_EQ(simulation.statistics(0).least_clearance_m, 0.0);
  ASSERT_EQ(simulation.collisions().size(), 1U);
  EXPECT_EQ(simulation.collisions()[0].partner, "border");
  // 1.913 m at 0.5 m/s.
  EXPECT_NEAR(to_seconds(simulation.collisions()[0].time_ns), 3.826, 0.05);
  EXPECT_GT(simulation.statistics(0).stalled_time_s, 0.8);
  EXPECT_NEAR(simulation.statistics(0).path_length_m, 1.913, 0.003);
}

TEST(Simulation, LeastClearance_ExactDespiteRareMeasurement) {
  Simulation simulation(room());
  drive(simulation, 0.5, 0.0);
  run(simulation, 300);
  drive(simulation, -0.5, 0.0);
  run(simulation, 100);
  // The minimum is reached after 1.5 m: the front is at 2 + 1.5 + 0.087.
  EXPECT_NEAR(simulation.statistics(0).least_clearance_m, 4.0 - 3.587, 1e-4);
}

// While nothing moves, the clearance of a robot at rest is not measured again.
TEST(Simulation, LeastClearanceAtRest_MeasuredAgainWhenOthersMove) {
  Simulation simulation(load_world_text(R"({"arena": {"size": [4, 4]}, "robots": [
      {"name": "r1", "pose": {"x": 1, "y": 2}},
      {"name": "r2", "pose": {"x": 3, "y": 2, "yaw_deg": 180}}]})"));
  const auto least_m = [&] { return simulation.statistics(0).least_clearance_m; };
  run(simulation, 50);
  EXPECT_NEAR(least_m(), 1.0 - 0.087, 1e-4);  // to the left border
  ASSERT_EQ(simulation.place_object("r2", {1.6, 2.0, std::numbers::pi}), std::nullopt);
  run(simulation, 50);
  EXPECT_NEAR(least_m(), 0.6 - 2.0 * 0.087, 1e-4);
  drive(simulation, 0.1, 0.0, 1);
  run(simulation, 100);
  EXPECT_NEAR(least_m(), 0.5 - 2.0 * 0.087, 1e-3);
  drive(simulation, -0.1, 0.0, 1);
  run(simulation, 100);
  EXPECT_NEAR(least_m(), 0.5 - 2.0 * 0.087, 1e-3);
}

TEST(Simulation, PenWithTrail_DrawsPath) {
  Simulation simulation(room(R"({"pen": {"trail": true, "colour": "#ff0000"}})"));
  drive(simulation, 0.5, 0.0);
  run(simulation, 50);
  const Canvas& canvas = simulation.canvas();
  EXPECT_EQ(canvas.pixel(canvas.column(2.1), canvas.row(2.0)), (Colour{255, 0, 0, 255}));
  EXPECT_EQ(canvas.pixel(canvas.column(2.5), canvas.row(2.0)), (Colour{0, 0, 0, 0}));
}

TEST(Simulation, Snapshot_ComposesAndListsLayers) {
  Simulation simulation(room());
  const LayerId layer = simulation.layers().add(LayerKind::kBinary, {.name = "path"}, 0);
  const DrawOperation dot{.layer = layer, .x0 = 3, .y0 = 2, .value = CellValue::of(true)};
  simulation.layers().draw({&dot, 1});
  simulation.canvas().set_pixel(0, 0, {255, 0, 0, 255});
  simulation.layers().resize(150, 120);
  const SceneSnapshot scene = simulation.snapshot();
  EXPECT_EQ(scene.canvas_description.width, 150);
  EXPECT_EQ(scene.canvas_description.height, 120);
  ASSERT_EQ(scene.layers.size(), 2U);
  EXPECT_EQ(scene.layers[0].style.name, "canvas");
  EXPECT_EQ(scene.layers[1].style.name, "path");
  // The canvas had 200 rows: resizing removes the 80 top rows, which contain (0, 0) and (3, 2).
  EXPECT_EQ(scene.canvas, std::vector<std::uint8_t>(150 * 120 * 4, 0));
  simulation.layers().resize(200, 200);
  simulation.layers().draw({&dot, 1});
  const std::vector<std::uint8_t> canvas = simulation.snapshot().canvas;
  EXPECT_EQ(canvas[(2 * 200 + 3) * 4 + 3], 255);
}

TEST(Simulation, LayersAndViewMode_KeepHash) {
  Simulation simulation(room());
  const std::uint64_t bare = simulation.state_hash();
  const LayerId layer = simulation.layers().add(LayerKind::kGrey, {.name = "map"}, 0);
  const DrawOperation dot{.layer = layer, .value = CellValue::of(1.0F)};
  simulation.layers().draw({&dot, 1});
  EXPECT_EQ(simulation.set_view_mode(ViewMode::kMiniMap), std::nullopt);
  EXPECT_EQ(simulation.state_hash(), bare);
  simulation.canvas().set_pixel(1, 1, {255, 0, 0, 255});
  EXPECT_NE(simulation.state_hash(), bare);
}

TEST(Simulation, ViewMode_StartsFromWorldAndChanges) {
  Simulation simulation(room("{}", R"(, "canvas": {"view_mode": "mini-map"})"));
  EXPECT_EQ(simulation.view_mode(), ViewMode::kMiniMap);
  EXPECT_EQ(simulation.set_view_mode(ViewMode::kFullScreen), std::nullopt);
  EXPECT_EQ(simulation.view_mode(), ViewMode::kFullScreen);
  EXPECT_EQ(simulation.snapshot().view_mode, ViewMode::kFullScreen);
}

TEST(Simulation, LockedViewMode_Stays) {
  Simulation simulation(
      room("{}", R"(, "canvas": {"view_mode": "full-screen", "lock_view_mode": true})"));
  EXPECT_EQ(simulation.set_view_mode(ViewMode::kFullScreen), std::nullopt);
  EXPECT_EQ(simulation.set_view_mode(ViewMode::kGround),
            "the view mode cannot be changed to \"ground\": the world locks it at "
            "\"full-screen\"");
  EXPECT_EQ(simulation.snapshot().view_mode, ViewMode::kFullScreen);
}

TEST(Simulation, Duration_EndsSimulation) {
  Simulation simulation(room("{}", R"(, "simulation": {"duration": 0.05})"));
  run(simulation, 4);
  EXPECT_FALSE(simulation.finished());
  run(simulation, 1);
  EXPECT_TRUE(simulation.finished());
}

TEST(Simulation, OverlappingRobots_Refused) {
  WorldDescription world = room();
  world.robots.push_back(world.robots[0]);
  world.robots[1].name = "r2";
  world.robots[1].port = 6666;
  EXPECT_THROW(Simulation{world}, ConfigError);
}

TEST(Simulation, Snapshot_ShowsObstaclesRobotsAndScan) {
  Simulation simulation(room());
  run(simulation, 10);
  const SceneSnapshot scene = simulation.snapshot();
  ASSERT_EQ(scene.robots.size(), 1U);
  EXPECT_EQ(scene.robots[0].name, "r1");
  EXPECT_EQ(scene.robots[0].scan_points.size(), 682U);
  EXPECT_NEAR(scene.robots[0].scan_origin.x(), 2.035, 1e-9);
  EXPECT_NEAR(scene.time_s, 0.1, 1e-12);
}

// --- Repeatability
// ----------------------------------------------------------------------------------

std::uint64_t hash_after_random_drive(WorldDescription world, int steps) {
  Simulation simulation(std::move(world));
  test::Random random(42);
  for (int i = 0; i < steps; ++i) {
    if (i % 37 == 0) {
      for (int r = 0; r < simulation.robot_count(); ++r) {
        // in this order, because the order of arguments is unspecified
        const double v = random.uniform(-0.5, 0.5);
        drive(simulation, v, random.uniform(-3.0, 3.0), r);
      }
    }
    simulation.step();
  }
  return simulation.state_hash();
}

WorldDescription thirteen_robots() {
  return load_world(PLAYPEN_SOURCE_DIR "/worlds/examples/thirteen_robots.json");
}

TEST(SimulationHash, TwoRunsOfThirteenRobots_Equal) {
  const std::uint64_t first = hash_after_random_drive(thirteen_robots(), 10'000);
  EXPECT_EQ(hash_after_random_drive(thirteen_robots(), 10'000), first);
}

TEST(SimulationDevices, DevicesWithoutWork_AskedOnce) {
  Simulation simulation(room());
  const auto device = [&](const char* name) -> const Device& {
    return simulation.device(0, simulation.find_device(0, name).value());
  };
  EXPECT_TRUE(device("laser").acts()) << "it might";
  simulation.step();
  EXPECT_FALSE(device("laser").acts());
  EXPECT_FALSE(device("laser").integrates());
  EXPECT_TRUE(device("motion").acts());
  EXPECT_TRUE(device("odometry").integrates());
  simulation.reset();
  simulation.step();
  EXPECT_TRUE(device("motion").acts());
  EXPECT_FALSE(device("laser").acts());
}

TEST(Box2dPart, NothingNear_None) {
  Simulation simulation(room());
  drive(simulation, 0.3, 0.5);
  run(simulation, 1000);
  EXPECT_EQ(simulation.box2d_since_ns(), std::nullopt);
}

TEST(Box2dPart, Wall_SinceTheRobotMightTouchIt) {
  Simulation simulation(room());
  drive(simulation, 0.5, 0.0);
  const auto at = [&] { return reading<PoseReading>(simulation, "pose").pose.x_m; };
  while (!simulation.box2d_since_ns() && simulation.steps() < 1000) simulation.step();
  ASSERT_TRUE(simulation.box2d_since_ns());
  EXPECT_EQ(*simulation.box2d_since_ns(), simulation.now_ns());
  EXPECT_NEAR(at(), 4.0 - 0.1, 0.05) << "the front of the robot is near the border";
  const SimTime since_ns = *simulation.box2d_since_ns();
  drive(simulation, -0.5, 0.0);
  run(simulation, 200);
  Simulation other(room());
  other.restore(simulation.save());
  EXPECT_EQ(other.box2d_since_ns(), since_ns);
  EXPECT_EQ(simulation.reset(), std::nullopt);
  run(simulation, 10);
  EXPECT_EQ(simulation.box2d_since_ns(), since_ns) << "it covers the whole run";
}

TEST(SimulationHash, Seed_MattersWithNoiseOnly) {
  WorldDescription world = room();
  const std::uint64_t quiet = hash_after_random_drive(world, 200);
  world.simulation.seed = 2;
  EXPECT_EQ(hash_after_random_drive(world, 200), quiet);
  world = room(R"({"laser": {"noise": 0.01}})");
  const std::uint64_t noisy = hash_after_random_drive(world, 200);
  world.simulation.seed = 2;
  EXPECT_NE(hash_after_random_drive(world, 200), noisy);
}

}  // namespace
}  // namespace sim
