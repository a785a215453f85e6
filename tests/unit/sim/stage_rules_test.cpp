// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// What worlds of Stage measure: flat worlds, rangers of several sensors, equal heights, odometry.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <any>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "sim/devices/fiducial.h"
#include "sim/devices/laser.h"
#include "sim/devices/localization.h"
#include "sim/devices/rangers.h"
#include "sim/simulation/simulation.h"
#include "temporary_folder.h"

namespace sim {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;

constexpr double kDegree = std::numbers::pi / 180.0;

/// A world of Stage that runs.
class StageRun {
 public:
  explicit StageRun(const std::string& text)
      : world_(load_world(test_support::TemporaryFolder().write("w.world", text))),
        simulation_(world_) {}

  [[nodiscard]] const WorldDescription& world() const { return world_; }
  void run(double time_s) {
    for (double t_s = 0.0; t_s < time_s - 1e-9; t_s += 0.01) simulation_.step();
  }
  template <typename Kind>
  [[nodiscard]] const auto& reading(const std::string& device, int robot = 0) {
    const Device& found = simulation_.device(robot, *simulation_.find_device(robot, device));
    return dynamic_cast<const Kind&>(found).reading();
  }
  std::vector<double> ranges(const std::string& device, int robot = 0) {
    run(0.11);
    if (device.starts_with("laser")) return reading<Laser>(device, robot).ranges_m;
    return reading<Ranger>(device, robot).ranges_m;
  }
  [[nodiscard]] Pose pose(int robot = 0) const { return simulation_.body(robot).X_WB; }
  void drive(const Twist& twist, int robot = 0) {
    ASSERT_FALSE(
        simulation_.apply({robot, *simulation_.find_device(robot, "motion")}, TwistCommand{twist}));
  }
  template <typename Params>
  [[nodiscard]] const Params& params(const std::string& name, std::size_t robot = 0) const {
    for (const DeviceDescription& one : world_.robots.at(robot).devices) {
      if (one.name == name) return std::any_cast<const Params&>(one.params);
    }
    throw std::runtime_error("no device " + name);
  }

 private:
  WorldDescription world_;
  Simulation simulation_;
};

// Stage 2.1 has no heights: laser_raytrace_match() of src/model_laser.c takes each model with
// laser_return > 0, ranger_raytrace_match() of src/model_ranger.c each one with ranger_return. The
// front of the box is at 3 - 0.5 = 2.5 m from the origin, where both sensors are.
TEST(StageFlat, Sensors_SeeModelsAtAnyHeight) {
  StageRun world(R"(
model ( name "box" size [1 1] pose [3 0 0] )
position ( name "r0" size [0.4 0.4] pose [0 0 0]
  laser ( samples 3 fov 90 range_max 8 )
  ranger ( scount 1 spose[0] [0 0 0] sview [0 8 10] ) ))");
  EXPECT_THAT(world.world().notes, Contains(HasSubstr("w.world:2: a world of Stage 2 is flat")));
  EXPECT_NEAR(world.ranges("laser")[1], 2.5, 1e-5);
  EXPECT_NEAR(world.ranges("sonar")[0], 2.5, 1e-5);
}

// A robot on the other side, without any height in the file, is seen as well: 3 - 0.2 m.
TEST(StageFlat, Robots_SeeEachOther) {
  StageRun world(R"(
define bot position ( size [0.4 0.4] laser ( samples 3 fov 90 ) )
bot ( pose [0 0 0] )
bot ( pose [3 0 180] ))");
  EXPECT_NEAR(world.ranges("laser", 0)[1], 2.8, 1e-5);
  EXPECT_NEAR(world.ranges("laser", 1)[1], 2.8, 1e-5);
}

TEST(StageFlat, LaserAndRangerReturn_ForLasersAndSonars) {
  const auto seen = [](const std::string& returns) {
    StageRun world("model ( size [1 1] pose [3 0 0] " + returns + R"()
position ( size [0.4 0.4]
  laser ( samples 3 fov 90 range_max 8 )
  ranger ( scount 1 spose[0] [0 0 0] sview [0 8 10] ) ))");
    return std::vector<bool>{world.ranges("laser")[1] < 8.0, world.ranges("sonar")[0] < 8.0};
  };
  EXPECT_THAT(seen("laser_return 0"), ElementsAre(false, true));
  EXPECT_THAT(seen("laser_return 0 ranger_return 0"), ElementsAre(false, false));
  EXPECT_THAT(seen("laser_return 2"), ElementsAre(true, true));
}

TEST(StageFlat, WindowAndWorldSize_NotEvidenceOfFlatWorld) {
  StageRun world(R"(
size [16 16]
window ( size [700 700] )
model ( size [1 1 0.1] pose [3 0 0 0] laser_return 1 )
position ( size [0.4 0.4 0.2] laser ( samples 3 fov 90 range_max 8 ) ))");
  EXPECT_THAT(world.world().notes, Not(Contains(HasSubstr("flat"))));
  EXPECT_EQ(world.ranges("laser")[1], 8.0);  // at 0.3 m, over the box of 0.1 m
}

// InterfaceRanger::Publish() of libstageplugin/p_ranger.cc: of several sensors each gives its first
// sample, which lies at -fov / 2. With 60 degrees these are at -30 and at 90 - 30 = 60 degrees. The
// walls at x = 2 and y = 3 are met at 2 / cos 30 and 3 / sin 60 degrees.
TEST(StageRangers, SeveralSensors_GiveFirstSamples) {
  StageRun world(R"(
model ( size [0.2 20 1] pose [2.1 0 0 0] )
model ( size [4 0.2 1] pose [0 3.1 0 0] )
position ( size [0.2 0.2 0.2]
  ranger ( sensor ( fov 60 samples 5 range [0.5 9] )
           sensor ( fov 60 samples 5 range [0.5 9] pose [0 0 0 90] ) )
  ranger ( sensor ( fov 60 samples 5 ) )
  ranger ( ) ))");
  EXPECT_THAT(world.world().robots[0].interfaces.at("ranger"),
              ElementsAre("sonar", "laser", "sonar2"));
  const std::vector<double> ranges = world.ranges("sonar");
  ASSERT_THAT(ranges, SizeIs(2));
  EXPECT_NEAR(ranges[0], 2.0 / std::cos(30.0 * kDegree), 1e-5);
  EXPECT_NEAR(ranges[1], 3.0 / std::sin(60.0 * kDegree), 1e-5);
  EXPECT_THAT(world.ranges("laser"), SizeIs(5));
  EXPECT_THAT(world.ranges("sonar2"), IsEmpty());
  // The configuration is that of the first sensor.
  const auto& sonar = world.params<SonarParams>("sonar");
  EXPECT_EQ(sonar.range_min_m, 0.5);
  EXPECT_NEAR(sonar.field_of_view_rad, 60.0 * kDegree, 1e-9);
  EXPECT_EQ(sonar.intensity, 1.0);
}

// Each sensor has its own range and height. The wall of 0.25 m is 3 - 0.1 m away. The first sensor
// is at 0.2 + 0.01 m and reaches only 2 m, the second one reaches it, the third one at 0.31 looks
// over it.
TEST(StageRangers, EachSensor_HasRangeAndHeight) {
  StageRun world(R"(
model ( size [0.2 20 0.25] pose [3 0 0 0] )
position ( size [0.2 0.2 0.2]
  ranger ( sensor ( range [0 2] ) sensor ( range [0 4] ) sensor ( range [0 8] pose [0 0 0.1 0] ) )
  ))");
  const std::vector<double> ranges = world.ranges("sonar");
  ASSERT_THAT(ranges, SizeIs(3));
  EXPECT_EQ(ranges[0], 2.0);
  EXPECT_NEAR(ranges[1], 2.9, 1e-5);
  EXPECT_EQ(ranges[2], 8.0);
}

// A ray has no width, whatever fov says: it passes 0.1 m beside the post, which a cone of 30
// degrees would meet.
TEST(StageRangers, SingleSample_IsRay) {
  StageRun world(R"(
model ( size [0.2 0.2 1] pose [2 0.2 0 0] )
position ( size [0.2 0.2 0.2] ranger ( sensor ( fov 30 samples 1 range [0 4] ) ) ))");
  EXPECT_THAT(world.ranges("sonar"), ElementsAre(4.0));
  EXPECT_NEAR(world.reading<Ranger>("sonar").field_of_view_rad, 30.0 * kDegree, 1e-9);
}

// World::Raytrace() of libstage/world.cc leaves out a block only if z < min or z > max. The sensor
// is at 0.37 - 0.02 + 0.05 + 0.01 m; the block ends at 0.41 m, which is the same height.
TEST(StageHeights, SensorAtTopOfBlock_SeesIt) {
  const auto seen = [](const std::string& top) {
    StageRun world("model ( size [1 1 " + top + R"(] pose [3 0 0 0] )
position ( size [0.4 0.4 0.37]
  ranger ( pose [0 0 -0.02 0] sensor ( pose [0 0 0.05 0] samples 3 fov 90 range [0 8] ) ) ))");
    return world.ranges("laser")[1] < 8.0;
  };
  EXPECT_TRUE(seen("0.41"));
  EXPECT_FALSE(seen("0.4099"));
}

// The shelf is from 0.3 to 0.5 m high, and both heights belong to it. The robot of 0.2 m drives
// under it, 1 m/s for 2 s.
TEST(StageHeights, BeamsAndRobots_PassUnderBlock) {
  const auto range_m = [](const std::string& z) {
    StageRun world(R"(
model ( size [1 1 0.2] pose [2 0 0.3 0] )
position ( size [0.4 0.4 0.1]
  ranger ( pose [0 0 -0.1 0] sensor ( pose [0 0 )" +
                   z + R"( 0] samples 3 fov 90 range [0 8] ) ) ))");
    const double ahead_m = world.ranges("laser")[1];
    world.drive({1.0, 0.0});
    world.run(2.0);
    EXPECT_GT(world.pose().x_m, 1.9);
    return ahead_m;
  };
  // A sensor is 0.01 m above its pose.
  EXPECT_EQ(range_m("0.28"), 8.0);
  EXPECT_NEAR(range_m("0.29"), 1.5, 1e-5);
  EXPECT_NEAR(range_m("0.49"), 1.5, 1e-5);
  EXPECT_EQ(range_m("0.5"), 8.0);
}

// A robot with a roof of 1 m from 0.4 to 0.5 m over a body of 0.4 m: low beams meet the body.
TEST(StageHeights, Beams_PassUnderRoofOfRobot) {
  const auto range_m = [](const std::string& z) {
    StageRun world(R"(
position ( size [0.4 0.4 0.1]
  ranger ( pose [0 0 -0.1 0] sensor ( pose [0 0 )" +
                   z + R"( 0] samples 3 fov 90 range [0 8] ) ) )
position ( pose [3 0 0 0] size [0.4 0.4 0.4] model ( size [1 1 0.1] ) ))");
    return world.ranges("laser")[1];
  };
  EXPECT_NEAR(range_m("0.2"), 2.8, 1e-5);
  EXPECT_NEAR(range_m("0.45"), 2.5, 1e-5);
}

// Equal robots whose finders are as high as the tops of their bodies see each other.
TEST(StageHeights, EqualRobotsWithFinderOnTop_SeeEachOther) {
  StageRun world(R"(
define bot position ( size [0.4 0.4 0.3] fiducial_return 1
  fiducial ( range_max 8 fov 180 pose [0 0 0 0] ) )
bot ( pose [0 0 0 0] fiducial_return 4 )
bot ( pose [3 0 0 180] fiducial_return 5 ))");
  world.run(0.11);
  ASSERT_THAT(world.reading<FiducialFinder>("fiducial", 0).marks, SizeIs(1));
  EXPECT_EQ(world.reading<FiducialFinder>("fiducial", 0).marks[0].id, 5);
  ASSERT_THAT(world.reading<FiducialFinder>("fiducial", 1).marks, SizeIs(1));
}

// ModelPosition::Update() of libstage/model_position.cc: the heading grows by (1 + a) times the
// turn, the path by (1 + x) times the way. The file's a is in degrees, and is taken in radians:
// 0.2 degrees are 0.003491, 20 degrees are 0.3491. 4 s at 0.5 rad/s are 114.592 degrees.
TEST(StageOdometry, DistanceAndHeadingErrors_Independent) {
  const auto yaw_deg = [](const std::string& error, double* path_m) {
    StageRun world("position ( size [0.4 0.4 0.2] localization \"odom\" odom_error " + error +
                   " velocity_bounds [-1 1 0 0 0 0 -90 90] )");
    world.drive({0.0, 0.5});
    world.run(4.0);
    world.drive({0.0, 0.0});
    world.run(0.2);
    const double turned_rad = world.reading<Odometry>("odometry").pose.yaw_rad;
    world.drive({0.5, 0.0});
    world.run(2.0);
    world.drive({0.0, 0.0});
    world.run(0.2);
    *path_m = world.reading<Odometry>("odometry").pose.position().norm();
    return turned_rad / kDegree;
  };
  double path_m = 0.0;
  EXPECT_NEAR(yaw_deg("[0.1 0 0 0.2]", &path_m), 114.592 * 1.003491, 0.005);
  EXPECT_NEAR(path_m, 1.0 * 1.1, 1e-6);
  EXPECT_NEAR(yaw_deg("[0.1 0 0 20]", &path_m), 114.592 * 1.349066, 0.005);
}

// 0.5 m/s sideways for 2 s is 1 m; y's error is 0.2, x's is 0.1.
TEST(StageOdometry, SidewaysDistance_HasOwnError) {
  StageRun world(
      "position ( size [0.4 0.4 0.2] drive \"omni\" localization \"odom\" "
      "odom_error [0.1 0.2 0 0] )");
  world.drive({0.0, 0.0, 0.5});
  world.run(2.0);
  world.drive({0.0, 0.0, 0.0});
  world.run(0.2);
  EXPECT_NEAR(world.reading<Odometry>("odometry").pose.y_m, 1.2, 1e-6);
  EXPECT_NEAR(world.reading<Odometry>("odometry").pose.x_m, 0.0, 1e-6);
}

}  // namespace
}  // namespace sim
