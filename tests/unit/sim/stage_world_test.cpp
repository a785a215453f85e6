// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// World files of Stage become worlds of Playpen: geometry, devices, names, errors.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <any>
#include <cstdlib>
#include <numbers>
#include <string>
#include <vector>

#include "sim/core/error.h"
#include "sim/devices/battery.h"
#include "sim/devices/blobfinder.h"
#include "sim/devices/builtin.h"
#include "sim/devices/bumper.h"
#include "sim/devices/camera.h"
#include "sim/devices/fiducial.h"
#include "sim/devices/gripper.h"
#include "sim/devices/laser.h"
#include "sim/devices/localization.h"
#include "sim/devices/motion.h"
#include "sim/devices/rangers.h"
#include "sim/io/stage_import.h"
#include "sim/simulation/simulation.h"
#include "sim/world/robot_model.h"
#include "temporary_folder.h"

namespace sim {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;
using testing::StartsWith;

class StageWorld : public testing::Test {
 protected:
  WorldDescription read(const std::string& text) {
    return load_world(folder_.write("w.world", text));
  }

  /// The only error of a world.
  ConfigIssue issue_of(const std::string& text) {
    try {
      static_cast<void>(read(text));
    } catch (const ConfigError& error) {
      EXPECT_THAT(error.issues(), SizeIs(1)) << error.what();
      return error.issues().front();
    }
    ADD_FAILURE() << "accepted: " << text;
    return {};
  }

  /// A picture of text: # is black, . is white; as PGM.
  void write_picture(const std::string& name, const std::vector<std::string>& rows) {
    std::string text =
        "P5 " + std::to_string(rows.front().size()) + " " + std::to_string(rows.size()) + " 255\n";
    for (const std::string& row : rows) {
      for (const char c : row) text += c == '#' ? '\0' : '\xff';
    }
    folder_.write(name, text);
  }

  template <typename Params>
  static const Params& device(const WorldDescription& world, const std::string& name,
                              std::size_t robot = 0) {
    for (const DeviceDescription& one : world.robots.at(robot).devices) {
      if (one.name == name) return std::any_cast<const Params&>(one.params);
    }
    throw std::runtime_error("no device " + name);
  }

  static const RobotModel& model(const WorldDescription& world, std::size_t robot = 0) {
    return *find_robot_model(world, world.robots.at(robot).model);
  }

  test_support::TemporaryFolder folder_;
};

// Rectangles of a body, for comparisons without regard to the order of corners.
struct Extent {
  Vec2 least;
  Vec2 most;
};
Extent extent_of(const Polygon& outline) {
  Extent extent{outline.front(), outline.front()};
  for (const Vec2& corner : outline) {
    extent.least = extent.least.cwiseMin(corner);
    extent.most = extent.most.cwiseMax(corner);
  }
  return extent;
}

TEST_F(StageWorld, Definitions_InheritAndLastCounts) {
  const WorldDescription world = read(R"(
define base position ( size [0.4 0.2 0.3] color "red" velocity_bounds [-1 1 0 0 0 0 -90 90] )
define fast base ( velocity_bounds [-2 2 0 0 0 0 -45 45] )
base ( name "a" pose [0 0 0 0] )
fast ( name "b" pose [2 1 0 90] color "LightBlue" )
)");
  ASSERT_THAT(world.robots, SizeIs(2));
  EXPECT_EQ(world.robots[0].colour, (Colour{255, 0, 0, 255}));
  EXPECT_EQ(world.robots[1].colour, (Colour{0xad, 0xd8, 0xe6, 255}));
  EXPECT_EQ(device<MotionParams>(world, "motion", 0).max_speed_mps, 1.0);
  EXPECT_EQ(device<MotionParams>(world, "motion", 1).max_speed_mps, 2.0);
  EXPECT_NEAR(device<MotionParams>(world, "motion", 1).max_turn_rate_radps, 0.25 * std::numbers::pi,
              1e-9);
  EXPECT_EQ(world.robots[1].pose.x_m, 2.0);
  EXPECT_NEAR(world.robots[1].pose.yaw_rad, 0.5 * std::numbers::pi, 1e-9);
  EXPECT_EQ(world.robots[0].port, 6665);
  EXPECT_EQ(world.robots[1].port, 6666);
}

TEST_F(StageWorld, LengthsAndAngles_UnitsOfFile) {
  const WorldDescription world = read(R"(
unit_length "cm"
unit_angle "radians"
position ( name "a" size [40 20 30] pose [100 50 0 1.5] )
)");
  EXPECT_NEAR(world.robots[0].pose.x_m, 1.0, 1e-12);
  EXPECT_NEAR(world.robots[0].pose.yaw_rad, 1.5, 1e-9);
  EXPECT_NEAR(extent_of(model(world).footprint).most.x(), 0.2, 1e-12);
}

// The body is the size, moved by the origin: x from -0.04 - 0.22 to -0.04 + 0.22.
TEST_F(StageWorld, Origin_MovesBodyNotRobot) {
  const WorldDescription world =
      read("position ( size [0.44 0.38 0.22] origin [-0.04 0 0 0] pose [1 2 0 0] mass 23 )");
  const Extent extent = extent_of(model(world).footprint);
  EXPECT_NEAR(extent.least.x(), -0.26, 1e-9);
  EXPECT_NEAR(extent.most.x(), 0.18, 1e-9);
  EXPECT_NEAR(extent.most.y(), 0.19, 1e-9);
  EXPECT_EQ(world.robots[0].pose.x_m, 1.0);
  EXPECT_EQ(model(world).height_m, 0.22);
  EXPECT_EQ(model(world).mass_kg, 23.0);
}

// The two blocks together are 2 x 1, stretched to 1 x 1: the left one is 0.5 wide and half as high.
TEST_F(StageWorld, Blocks_StretchedTogetherToSize) {
  const WorldDescription world = read(R"(
model (
  name "stair" pose [3 0 0 90] size [1 1 0.8]
  block ( points 4 point[0] [0 0] point[1] [1 0] point[2] [1 1] point[3] [0 1] z [0 1] )
  block ( points 4 point[0] [1 0] point[1] [2 0] point[2] [2 1] point[3] [1 1] z [0 2] )
)
)");
  ASSERT_THAT(world.arena.obstacles, SizeIs(2));
  const ObstacleDescription& left = world.arena.obstacles[0];
  EXPECT_EQ(left.name, "stair");
  EXPECT_NEAR(left.height_m, 0.4, 1e-9);
  EXPECT_NEAR(world.arena.obstacles[1].height_m, 0.8, 1e-9);
  const Extent extent = extent_of(left.outline);
  EXPECT_NEAR(extent.least.x(), -0.5, 1e-9);
  EXPECT_NEAR(extent.most.x(), 0.0, 1e-9);
  EXPECT_NEAR(extent.most.y(), 0.5, 1e-9);
  EXPECT_EQ(left.center, Vec2(3, 0));
  EXPECT_NEAR(left.yaw_rad, 0.5 * std::numbers::pi, 1e-9);
}

// The dark pixels are 2 x 1 of 4 x 3: they are stretched to 4 x 2 m around the model's pose.
TEST_F(StageWorld, BitmapPixels_StretchedToSize) {
  write_picture("plan.pgm", {"....",  //
                             ".##.",  //
                             "...."});
  const WorldDescription world =
      read("model ( name \"plan\" bitmap \"plan.pgm\" size [4 2 0.5] pose [10 20 0 0] )");
  ASSERT_THAT(world.arena.walls, SizeIs(1));
  const Extent extent = extent_of(world.arena.walls[0].vertices);
  EXPECT_EQ(extent.least, Vec2(8, 19));
  EXPECT_EQ(extent.most, Vec2(12, 21));
  EXPECT_EQ(world.arena.walls[0].height_m, 0.5);
  EXPECT_THAT(world.arena.obstacles, IsEmpty());
}

// The L of 2 x 2 pixels becomes one of 0.4 x 0.4 m.
TEST_F(StageWorld, SmallBitmapOfOnePart_ObstacleWithColourAndFiducial) {
  write_picture("l.pgm", {"#.", "##"});
  const WorldDescription world = read(
      "model ( name \"l\" bitmap \"l.pgm\" size [0.4 0.4 0.2] pose [1 2 0 90] color \"orange\" "
      "fiducial_return 3 )");
  EXPECT_THAT(world.arena.walls, IsEmpty());
  ASSERT_THAT(world.arena.obstacles, SizeIs(1));
  const ObstacleDescription& obstacle = world.arena.obstacles[0];
  EXPECT_THAT(obstacle.outline, SizeIs(6));
  EXPECT_EQ(extent_of(obstacle.outline).most, Vec2(0.2, 0.2));
  EXPECT_EQ(obstacle.center, Vec2(1, 2));
  EXPECT_EQ(obstacle.colour, (Colour{255, 165, 0, 255}));
  EXPECT_EQ(obstacle.fiducial, 3);
}

TEST_F(StageWorld, Bitmap_MayBeRotatedAndHasBoundary) {
  write_picture("plan.pgm", {"#."  //
                             ,
                             ".#"});
  const WorldDescription world =
      read("model ( name \"plan\" bitmap \"plan.pgm\" size [4 2 0.5] pose [0 0 0 90] boundary 1 )");
  ASSERT_THAT(world.arena.walls, SizeIs(2));
  // The pixel at the top left, x from -2 to 0 and y from 0 to 1, turned by a quarter.
  bool found = false;
  for (const WallLoop& loop : world.arena.walls) {
    const Extent extent = extent_of(loop.vertices);
    found = found || ((extent.least - Vec2(-1, -2)).norm() < 1e-9 &&
                      (extent.most - Vec2(0, 0)).norm() < 1e-9);
  }
  EXPECT_TRUE(found);
  ASSERT_THAT(world.arena.obstacles, SizeIs(4));  // 1 cm thick, inside of the size
  EXPECT_NEAR(world.arena.size.x(), 2.0, 1e-9);
  EXPECT_NEAR(world.arena.size.y(), 4.0, 1e-9);
  EXPECT_FALSE(world.arena.border);
}

TEST_F(StageWorld, BitmapFormats_JudgedByFirstSample) {
  // Red 200, green and blue 0: light, although its luma is 60.
  folder_.write("red.ppm", std::string("P6 2 1 255\n") + std::string("\xc8\0\0\0\xff\xff", 6));
  const WorldDescription ppm = read("model ( bitmap \"red.ppm\" size [4 4 1] )");
  ASSERT_THAT(ppm.arena.walls, SizeIs(1));
  EXPECT_EQ(extent_of(ppm.arena.walls[0].vertices).most, Vec2(2, 2));
  folder_.write("plain.pbm", "P1 3 1 101");
  EXPECT_THAT(read("model ( bitmap \"plain.pbm\" size [6 2 1] )").arena.walls, SizeIs(2));
  folder_.write("raw.pbm", std::string("P4 3 1\n") + '\xa0');
  EXPECT_THAT(read("model ( bitmap \"raw.pbm\" size [6 2 1] )").arena.walls, SizeIs(2));
}

// On top of the body (0.22), the sensor at 0.1 plus half its height of 0.02.
TEST_F(StageWorld, RangerWithManySamples_LaserOnTop) {
  const WorldDescription world = read(R"(
position (
  size [0.44 0.38 0.22]
  ranger (
    pose [0.1 0 0 0] size [0.156 0.155 0.19] origin [0.02 0 0 0]
    sensor ( range [0 8] pose [0 0 0.1 10] fov 180 samples 181 noise [0.0004 0.1 0] )
  )
)
)");
  const auto& laser = device<LaserParams>(world, "laser");
  EXPECT_EQ(laser.beam_count, 181);
  EXPECT_NEAR(laser.resolution_rad, std::numbers::pi / 180.0, 1e-12);
  EXPECT_EQ(laser.range_max_m, 8.0);
  EXPECT_NEAR(laser.height_m, 0.33, 1e-9);
  EXPECT_NEAR(laser.X_BL.x_m, 0.12, 1e-9);
  EXPECT_NEAR(laser.X_BL.yaw_rad, 10.0 * std::numbers::pi / 180.0, 1e-9);
  EXPECT_NEAR(laser.noise_m, 0.02, 1e-9);  // Stage's number is a variance
  EXPECT_EQ(laser.frequency_hz, 10.0);
  EXPECT_THAT(world.robots[0].interfaces.at("ranger"), ElementsAre("laser"));
}

TEST_F(StageWorld, Stage2And3Syntax_SameDevices) {
  const WorldDescription world = read(R"(
position (
  size [0.4 0.4 0.2]
  ranger ( scount 2 spose[0] [0.1 0.1 45] spose[1] [0.1 -0.1 -45] sview [0 3 30] ssize [0.01 0.05] )
  laser ( range_max 6 fov 90 samples 91 size [0.1 0.1 0.2] )
)
)");
  const auto& sonar = device<SonarParams>(world, "sonar");
  ASSERT_THAT(sonar.X_BS, SizeIs(2));
  EXPECT_NEAR(sonar.X_BS[1].yaw_rad, -0.25 * std::numbers::pi, 1e-9);
  EXPECT_EQ(sonar.range_max_m, 3.0);
  const auto& laser = device<LaserParams>(world, "laser");
  EXPECT_EQ(laser.beam_count, 91);
  EXPECT_NEAR(laser.resolution_rad, std::numbers::pi / 180.0, 1e-12);
  EXPECT_EQ(laser.range_max_m, 6.0);
  EXPECT_THAT(world.robots[0].interfaces.at("ranger"), ElementsAre("sonar", "laser"));
}

TEST_F(StageWorld, PosesOfThreeNumbers_HeadingInStage2Only) {
  EXPECT_NEAR(read("position ( size [0.4 0.4] pose [1 2 90] )").robots[0].pose.yaw_rad,
              0.5 * std::numbers::pi, 1e-9);
  const WorldDescription later =
      read("position ( size [0.4 0.4] pose [1 2 90] )\nposition ( pose [5 5 0 0] )");
  EXPECT_EQ(later.robots[0].pose.yaw_rad, 0.0);
}

TEST_F(StageWorld, Localization_SelectsWhatPosition2dReads) {
  const WorldDescription world = read(R"(
position ( name "gps" size [0.4 0.4 0.2] pose [1 0 0 0] )
position ( name "odom" size [0.4 0.4 0.2] pose [3 0 0 90] localization "odom"
           localization_origin [1 0 0 0] odom_error [0.02 0 0 1] )
)");
  EXPECT_THAT(world.robots[0].interfaces.at("position2d"), ElementsAre("pose", "odometry"));
  EXPECT_THAT(world.robots[1].interfaces.at("position2d"), ElementsAre("odometry", "pose"));
  const auto& odometry = device<OdometryParams>(world, "odometry", 1);
  EXPECT_NEAR(odometry.scale, 1.02, 1e-9);
  // Stage reads the last number as an angle: 1 degree is a share of 0.01745.
  EXPECT_NEAR(odometry.wheelbase_ratio, 1.0 + std::numbers::pi / 180.0, 1e-9);
  EXPECT_NEAR(odometry.start.x_m, 2.0, 1e-9);
  EXPECT_NEAR(odometry.start.yaw_rad, 0.5 * std::numbers::pi, 1e-9);
  Simulation simulation(world);
  for (int i = 0; i < 20; ++i) simulation.step();
  const auto id = simulation.find_device(1, "odometry");
  ASSERT_TRUE(id);
}

TEST_F(StageWorld, Drives_FromModel) {
  const WorldDescription world = read(R"(
position ( size [0.4 0.4 0.2] pose [0 0 0 0] drive "omni" )
position ( size [0.4 0.4 0.2] pose [2 0 0 0] drive "car" wheelbase 0.5 )
position ( size [0.4 0.4 0.2] pose [4 0 0 0] )
)");
  EXPECT_EQ(model(world, 0).drive.kind, DriveKind::kOmnidirectional);
  EXPECT_EQ(model(world, 1).drive.kind, DriveKind::kCar);
  EXPECT_EQ(model(world, 1).drive.wheelbase_m, 0.5);
  EXPECT_EQ(model(world, 2).drive.kind, DriveKind::kDifferential);
}

TEST_F(StageWorld, OtherDevices_SettingsConverted) {
  const WorldDescription world = read(R"(
position (
  size [0.4 0.4 0.2] joules 36000 watts 5 fiducial_return 7
  fiducial ( range_max 6 range_max_id 4 fov 90 )
  blobfinder ( image [160 120] range 3 fov 30 pan 15 colors_count 1 colors ["orange" "red"] )
  bumper ( bcount 1 blength 0.3 bpose[0] [0.2 0 0 0] )
  gripper ( pose [0.2 0 -0.2 0] size [0.2 0.3 0.2] )
  camera ( resolution [100 80] fov [70 40] range [0.2 8] )
)
)");
  EXPECT_EQ(world.robots[0].fiducial, 7);
  const auto& fiducial = device<FiducialParams>(world, "fiducial");
  EXPECT_EQ(fiducial.range_max_m, 6.0);
  EXPECT_EQ(fiducial.range_max_id_m, 4.0);
  const auto& blobs = device<BlobfinderParams>(world, "blobfinder");
  EXPECT_EQ(blobs.width, 160);
  EXPECT_NEAR(blobs.X_BS.yaw_rad, 15.0 * std::numbers::pi / 180.0, 1e-9);
  EXPECT_THAT(blobs.colours, ElementsAre(Colour{255, 165, 0, 255}));
  const auto& bumper = device<BumperParams>(world, "bumper");
  ASSERT_THAT(bumper.segments, SizeIs(1));
  const auto& gripper = device<GripperParams>(world, "gripper");
  EXPECT_NEAR(gripper.length_m, 0.132, 1e-9);  // 0.66 of 0.2
  EXPECT_NEAR(gripper.opening_m, 0.24, 1e-9);  // 0.3 without two paddles of a tenth
  // Its foot, where Stage's break beams start: on top of the body, 0.2 m, and 0.2 m below that. At
  // half of the paddles' height, 0.04 m, it would miss flat pucks that Stage's gripper takes.
  EXPECT_NEAR(gripper.height_m, 0.0, 1e-9);
  EXPECT_EQ(device<CameraParams>(world, "camera").width, 100);
  EXPECT_NEAR(device<BatteryParams>(world, "battery").capacity_wh, 10.0, 1e-9);
}

TEST_F(StageWorld, Objects_ReturnsConverted) {
  const WorldDescription world = read(R"(
position ( size [0.4 0.4 0.2] pose [0 0 0 0] ranger ( sensor ( samples 100 fov 180 ) ) )
model ( name "puck" size [0.1 0.1 0.1] pose [2 0 0 0] gripper_return 1 fiducial_return 10 color "red" )
model ( name "glass" size [0.1 0.1 0.5] pose [3 0 0 0] ranger_return -1 )
model ( name "zone" size [1 1 0.01] pose [4 0 0 0] ranger_return -1 obstacle_return 0 )
model ( name "lamp" size [0.1 0.1 0.1] pose [5 0 2 0] )
)");
  ASSERT_THAT(world.arena.obstacles, SizeIs(3));
  EXPECT_TRUE(world.arena.obstacles[0].portable);
  EXPECT_EQ(world.arena.obstacles[0].fiducial, 10);
  EXPECT_EQ(world.arena.obstacles[0].colour, (Colour{255, 0, 0, 255}));
  EXPECT_EQ(world.arena.obstacles[1].name, "glass");
  EXPECT_EQ(world.arena.obstacles[1].height_m, 0.001);
  EXPECT_THAT(world.notes, Contains(HasSubstr("above all robots")));
  EXPECT_EQ(world.arena.obstacles[2].name, "zone");
  EXPECT_FALSE(world.arena.obstacles[2].solid);
  EXPECT_EQ(world.arena.obstacles[2].height_m, 0.001) << "pictures show it, rangers do not";
}

TEST_F(StageWorld, LeftOutParts_NotedOnceWithPlace) {
  const WorldDescription world = read(
      "window ( size [100 100] )\n"
      "position ( size [0.4 0.4 0.2] ctrl \"fasr\" gui_nose 1 swims 1 )\n"
      "position ( size [0.4 0.4 0.2] pose [2 0 0 0] ctrl \"fasr\" swims 1 color \"rde\" )\n");
  const std::string file = folder_ / "w.world";
  EXPECT_THAT(world.notes,
              Contains(file + ":2: the controller \"fasr\" is a library for Stage; write it as a "
                              "client program (playpen new) (and 1 more)"));
  EXPECT_THAT(world.notes,
              Contains(file + ":2: the property \"swims\" of a position is left out (and 1 more)"));
  EXPECT_THAT(world.notes, Contains(file + ":1: the look of Stage's window is left out: window "
                                           "and gui_nose"));
  EXPECT_THAT(world.notes, Contains(HasSubstr("did you mean \"red\"?")));
  EXPECT_THAT(world.notes, SizeIs(4));
}

TEST_F(StageWorld, ShippedModels_FoundUnlessUserHasFile) {
  const std::string text = R"(
include "pioneer.inc"
include "sick.inc"
pioneer2dx ( name "r0" pose [0 0 0 0] sicklaser ( pose [0 0 0 0] ) )
)";
  const WorldDescription world = read(text);
  const auto& laser = device<LaserParams>(world, "laser");
  EXPECT_EQ(laser.beam_count, 180);
  EXPECT_THAT(device<SonarParams>(world, "sonar").X_BS, SizeIs(16));
  EXPECT_THAT(world.robots[0].interfaces.at("ranger"), ElementsAre("sonar", "laser"));
  EXPECT_NEAR(laser.height_m, 0.33, 1e-9);
  folder_.write("sick.inc", "define sicklaser ranger ( sensor ( samples 9 fov 90 ) )");
  EXPECT_EQ(device<LaserParams>(read(text), "laser").beam_count, 9);
}

TEST_F(StageWorld, ShippedFiles_CanBeIncluded) {
  for (const char* name :
       {"beacons.inc", "chatterbox.inc", "hokuyo.inc", "irobot.inc", "map.inc", "objects.inc",
        "p3at.inc", "p3dx.inc", "pantilt.inc", "pioneer.inc", "pioneerBase.inc", "pucktarget.inc",
        "roomba.inc", "sick.inc", "walle.inc"}) {
    EXPECT_NO_THROW(static_cast<void>(read(std::string("include \"") + name + "\"\n"))) << name;
  }
  const WorldDescription world = read(R"(
include "chatterbox.inc"
include "pioneer.inc"
laserchatterbox ( pose [0 0 0 0] )
pioneer3dx ( pose [2 0 0 0] )
pioneer3at ( pose [4 0 0 0] )
amigobot ( pose [6 0 0 0] )
create ( pose [8 0 0 0] )
)");
  EXPECT_THAT(world.robots, SizeIs(5));
}

TEST_F(StageWorld, ConfigurationFile_SetsPortsAndIndexes) {
  folder_.write("w.cfg", R"(
driver ( name "stage" provides ["simulation:0"] plugin "stageplugin" worldfile "w.world" )
driver ( name "stage" provides ["6670:position2d:0" "6670:ranger:0" "6670:ranger:1 "] model "b" )
driver ( name "rangertolaser" provides ["6670:laser:0"] requires ["6670:ranger:1"] )
driver ( name "stage" provides ["6669:position2d:0"] model "a" )
driver ( name "nd" provides ["6669:position2d:1"] requires ["6669:position2d:0"] )
)");
  const std::string text = R"(
define bot position (
  size [0.4 0.4 0.2]
  ranger ( sensor ( samples 100 fov 180 ) )
  ranger ( sensor ( pose [0 0 0 90] ) sensor ( pose [0 0 0 -90] ) )
)
bot ( name "a" pose [0 0 0 0] )
bot ( name "b" pose [2 0 0 0] )
)";
  const WorldDescription world = read(text);
  EXPECT_EQ(world.robots[0].port, 6669);
  EXPECT_EQ(world.robots[1].port, 6670);
  EXPECT_THAT(world.robots[1].interfaces.at("ranger"), ElementsAre("laser", "sonar"));
  ASSERT_THAT(world.robots[0].drivers, SizeIs(1));
  EXPECT_EQ(world.robots[0].drivers[0].type, "nd");
  // The file itself names the world, too.
  const WorldDescription same = load_world(folder_ / "w.cfg");
  EXPECT_EQ(same.robots[1].port, 6670);
}

TEST_F(StageWorld, RobotsOnSamePort_ConsecutiveIndexes) {
  folder_.write("w.cfg", R"(
driver ( name "stage" provides ["simulation:0"] worldfile "w.world" )
driver ( name "stage" provides ["position2d:0"] model "a" )
driver ( name "stage" provides ["position2d:1"] model "b" )
)");
  const WorldDescription world = read(
      "position ( name \"a\" size [0.4 0.4 0.2] )\n"
      "position ( name \"b\" size [0.4 0.4 0.2] pose [2 0 0 0] )\n"
      "position ( name \"c\" size [0.4 0.4 0.2] pose [4 0 0 0] )\n");
  EXPECT_EQ(world.robots_on_port, 6665);
  EXPECT_EQ(world.robots[0].port, 6665);
  EXPECT_EQ(world.robots[1].proxies.at("position2d"), 1);
  EXPECT_EQ(world.robots[2].port, 6666);
}

TEST_F(StageWorld, Snd_BecomesDriver) {
  folder_.write("w.cfg", R"(
driver ( name "stage" provides ["simulation:0"] worldfile "w.world" )
driver ( name "stage" provides ["position2d:0" "laser:0"] model "a" )
driver ( name "snd" provides ["position2d:1"] requires ["input:::position2d:0" "laser:0"]
         robot_radius 0.3 max_speed 0.4 )
)");
  const WorldDescription world =
      read("position ( name \"a\" size [0.4 0.4 0.2] ranger ( sensor ( samples 181 fov 180 ) ) )");
  ASSERT_THAT(world.robots[0].drivers, SizeIs(1));
  EXPECT_EQ(world.robots[0].drivers[0].type, "snd");
  EXPECT_EQ(world.robots[0].drivers[0].settings.at("index"), "1");
  EXPECT_EQ(world.robots[0].drivers[0].settings.at("robot_radius"), "0.3");
  EXPECT_THAT(world.robots[0].interfaces.at("position2d"), ElementsAre("pose"));
}

TEST_F(StageWorld, Wander_DrivesWithoutClientRepeatably) {
  const std::string text = R"(
model ( name "room" size [4 4 0.5] boundary 1 noblocks 1 )
position ( name "r0" size [0.3 0.3 0.2] ctrl "wander"
           ranger ( sensor ( samples 180 fov 180 range [0 5] ) ) )
)";
  const auto run = [&] {
    Simulation simulation(read(text));
    for (int i = 0; i < 2000; ++i) simulation.step();
    return simulation.state_hash();
  };
  const auto hash = run();
  EXPECT_EQ(run(), hash);
  Simulation simulation(read(text));
  double path_m = 0.0;
  Pose last = simulation.body(0).X_WB;
  for (int i = 0; i < 2000; ++i) {
    simulation.step();
    const Pose now = simulation.body(0).X_WB;
    path_m += (now.position() - last.position()).norm();
    last = now;
  }
  EXPECT_GT(path_m, 1.0);  // of 8 m with free way
  const auto motion = simulation.find_device(0, "motion");
  ASSERT_TRUE(motion);
  ASSERT_FALSE(simulation.apply({0, *motion}, TwistCommand{}));
  simulation.step();
  last = simulation.body(0).X_WB;
  for (int i = 0; i < 500; ++i) simulation.step();
  EXPECT_EQ(simulation.body(0).X_WB, last);  // the program has taken it over
}

TEST_F(StageWorld, RobotInWall_StartsBesideIt) {
  const WorldDescription world = read(
      "model ( size [1 1 1] pose [0 0 0 0] )\n"
      "position ( name \"r0\" size [0.4 0.4 0.4] pose [0.6 0 0 0] )\n");
  EXPECT_THAT(world.notes, Contains(HasSubstr("robot r0 overlaps something at its start")));
  EXPECT_GT(world.robots[0].pose.x_m, 0.69);
}

TEST_F(StageWorld, Import_SameWorld) {
  write_picture("plan.pgm", {"#..#", "...."});
  const std::string file = folder_.write("w.world", R"(
include "pioneer.inc"
model ( name "plan" bitmap "plan.pgm" size [8 8 1] boundary 1 )
pioneer2dx ( name "r0" pose [0 -2 0 30] )
)");
  const io::ImportedWorld imported = io::import_stage_world(file, "", device_types());
  test_support::TemporaryFolder out;
  for (const auto& [name, content] : imported.files) out.write(name, content);
  const WorldDescription copy = load_world(out.write("w.json", imported.world));
  const WorldDescription world = load_world(file);
  Simulation a(world);
  Simulation b(copy);
  EXPECT_EQ(a.state_hash(), b.state_hash());
  EXPECT_EQ(copy.arena.walls.size(), world.arena.walls.size());
}

struct BadStageWorld {
  const char* text;
  int line;
  const char* id;
  const char* found;
};

TEST_F(StageWorld, Errors_NamePlace) {
  folder_.write("loop.inc", "include \"loop.inc\"\n");
  const BadStageWorld bad[] = {
      {"model ( size [1 1 1]\n", 2, "stage/syntax", "the end of the file"},
      {"model ( size [1, 1 1] )", 1, "stage/syntax", "\",\""},
      {"name red\n", 1, "stage/syntax", "the word \"red\""},
      {"name \"red\n", 1, "stage/syntax", "the end of the line"},
      {"speedup 1.2x\n", 1, "stage/syntax", "\"1.2x\""},
      {"\n\n)", 3, "stage/syntax", "\")\""},
      {"\ninclude \"nowhere.inc\"", 2, "stage/include", "no \"nowhere.inc\""},
      {"include \"loop.inc\"", 1, "stage/include", "\"loop.inc\""},
      {"define a a ( )\na ( )", 1, "stage/too-deep", "\"a\""},
      {"\npositron ( )", 2, "stage/unknown-model", "\"positron\""},
      {"block ( points 3 )", 1, "stage/misplaced", "it elsewhere"},
      {"model ( size \"big\" )", 1, "stage/wrong-type", "\"big\""},
      {"model (\n bitmap \"no.png\" )", 2, "stage/bitmap", "no file of that name"},
      {"model ( block ( points 2 ) )", 1, "stage/bad-block", "2"},
      {"position ( ranger (\n sensor ( samples 9999 ) ) )", 2, "stage/bad-ranger", "9999"},
      {"position ( size [500 500 1] )", 1, "stage/bad-body", "250 m"},
      {"\nposition ( pose [2e4 0 0 0] )", 2, "world/out-of-range", "20000"},
  };
  for (const BadStageWorld& one : bad) {
    const ConfigIssue issue = issue_of(one.text);
    EXPECT_EQ(issue.id, one.id) << one.text;
    EXPECT_EQ(issue.line, one.line) << one.text << "\n" << issue.message();
    EXPECT_THAT(issue.found, HasSubstr(one.found)) << one.text;
    EXPECT_THAT(issue.file, Not(IsEmpty()));
  }
  EXPECT_THAT(issue_of("positon ( )").hint, HasSubstr("did you mean \"position\"?"));
}

TEST_F(StageWorld, ConfigurationErrors_NamePlace) {
  folder_.write("w.world", "position ( name \"r0\" size [0.4 0.4 0.2] )");
  const BadStageWorld bad[] = {
      {"driver ( name \"stage\" )", 0, "stage/no-world", "none"},
      {"driver ( worldfile \"x.world\" )", 1, "stage/no-world", "no file of that name"},
      {"driver ( name \"stage\" worldfile \"w.world\" )\n"
       "driver ( name \"stage\" model \"r1\" provides [\"position2d:0\"] )",
       2, "stage/no-model", "\"r1\""},
      {"driver ( name \"stage\" worldfile \"w.world\" )\n"
       "driver ( name \"stage\" model \"r0\" provides [\"laser:0\"] )",
       2, "stage/no-model", "none"},
      {"driver ( name \"stage\" worldfile \"w.world\" )\n"
       "driver ( name \"stage\" model \"r0\" provides [\"laser\"] )",
       2, "stage/bad-address", "\"laser\""},
  };
  for (const BadStageWorld& one : bad) {
    try {
      static_cast<void>(load_world(folder_.write("bad.cfg", one.text)));
      ADD_FAILURE() << "accepted: " << one.text;
    } catch (const ConfigError& error) {
      ASSERT_THAT(error.issues(), SizeIs(1)) << error.what();
      EXPECT_EQ(error.issues()[0].id, one.id) << one.text;
      EXPECT_EQ(error.issues()[0].line, one.line) << one.text;
      EXPECT_THAT(error.issues()[0].found, HasSubstr(one.found)) << one.text;
    }
  }
}

}  // namespace
}  // namespace sim
