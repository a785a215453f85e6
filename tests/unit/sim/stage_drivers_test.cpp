// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Drivers of Player's configuration files beside worlds of Stage.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <any>
#include <cmath>
#include <string>

#include "sim/core/error.h"
#include "sim/devices/amcl.h"
#include "sim/simulation/simulation.h"
#include "temporary_folder.h"

namespace sim {
namespace {

using testing::Contains;
using testing::Each;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;

constexpr const char* kScanner = "ranger ( sensor ( samples 181 fov 180 ) )";

// A robot "r0" with a laser and a sonar, and one "r1" that has no laser.
WorldDescription read(const std::string& drivers, const std::string& scanner = kScanner) {
  test_support::TemporaryFolder folder;
  folder.write("w.cfg",
               "driver ( name \"stage\" provides [\"simulation:0\"] worldfile \"w.world\" )\n"
               "driver ( name \"stage\" provides [\"position2d:0\" \"ranger:0\"] model \"r0\" )\n" +
                   drivers);
  return load_world(folder.write(
      "w.world", "position ( name \"r0\" size [0.4 0.4 0.2] " + scanner +
                     " )\nposition ( name \"r1\" size [0.4 0.4 0.2] pose [2 0 0 0] )"));
}

TEST(StageDrivers, Vfh_OptionsKeepMeaning) {
  const WorldDescription world = read(
      "driver ( name \"vfh\" provides [\"position2d:1\"] requires [\"position2d:0\" \"ranger:0\"]\n"
      "  max_speed 0.3 max_turnrate_0ms 90 sector_angle 10 distance_epsilon 0.25\n"
      "  window_diameter 41 escape_speed 0.1 )");
  ASSERT_THAT(world.robots[0].drivers, SizeIs(1));
  const DriverDescription& driver = world.robots[0].drivers[0];
  EXPECT_EQ(driver.type, "vfh");
  EXPECT_EQ(driver.settings.at("index"), "1");
  EXPECT_EQ(driver.settings.at("position"), "0");
  EXPECT_EQ(driver.settings.at("laser"), "0");
  EXPECT_EQ(driver.settings.at("max_speed"), "0.3");
  EXPECT_EQ(driver.settings.at("max_turnrate_0ms_deg"), "90.0");
  EXPECT_EQ(driver.settings.at("sector_angle_deg"), "10.0");
  EXPECT_EQ(driver.settings.at("distance_epsilon"), "0.25");
  EXPECT_EQ(driver.settings.at("window_diameter"), "41");
  EXPECT_THAT(world.robots[0].interfaces.at("laser"), SizeIs(1));
  EXPECT_THAT(world.notes,
              Contains(HasSubstr("options of the driver \"vfh\" are left out: escape_speed")));
}

TEST(StageDrivers, Nd_PairsAreTwoSettings) {
  const WorldDescription world = read(
      "driver ( name \"nd\" provides [\"position2d:2\"]\n"
      "  requires [\"output:::position2d:0\" \"input:::position2d:0\" \"ranger:0\"]\n"
      "  max_speed [0.7 100] min_speed [0.1 10] goal_tol [0.3 15] translate_stuck_angle 10 )");
  ASSERT_THAT(world.robots[0].drivers, SizeIs(1));
  const auto& settings = world.robots[0].drivers[0].settings;
  EXPECT_EQ(settings.at("index"), "2");
  EXPECT_EQ(settings.at("max_speed"), "0.7");
  EXPECT_EQ(settings.at("max_turnrate_deg"), "100.0");
  EXPECT_EQ(settings.at("min_turnrate_deg"), "10.0");
  EXPECT_EQ(settings.at("goal_tol"), "0.3");
  EXPECT_EQ(settings.at("goal_tol_angle_deg"), "15.0");
  EXPECT_EQ(settings.at("translate_stuck_angle_deg"), "10.0");
}

// As in Stage's wavefront-remote.cfg: the drivers run on a second server.
TEST(StageDrivers, Wavefront_FollowsAmclAndDrivesByVfh) {
  const WorldDescription world = read(
      "driver ( name \"wavefront\" provides [\"7000:planner:0\"] requires\n"
      "  [\"output::7000:position2d:1\" \"input::7000:position2d:2\" \"7000:map:0\"]\n"
      "  safety_dist 0.15 angle_epsilon 10 )\n"
      "driver ( name \"passthrough\" provides [\"7000:map:0\"] requires [\"6665:map:0\"] )\n"
      "driver ( name \"vfh\" provides [\"7000:position2d:1\"]\n"
      "  requires [\"6665:position2d:0\" \"6665:ranger:0\"] )\n"
      "driver ( name \"amcl\" provides [\"7000:localize:0\" \"7000:position2d:2\"] requires\n"
      "  [\"odometry::6665:position2d:0\" \"6665:ranger:0\" \"laser::7000:map:0\"]\n"
      "  init_pose [0.1 0.2 90] update_thresh [0.1 5] pf_max_samples 500 )");
  ASSERT_THAT(world.robots[0].drivers, SizeIs(2));
  EXPECT_EQ(world.robots[0].drivers[0].type, "vfh");
  const DriverDescription& planner = world.robots[0].drivers[1];
  EXPECT_EQ(planner.type, "wavefront");
  EXPECT_EQ(planner.settings.at("output"), "1");
  EXPECT_EQ(planner.settings.at("localize"), "0");
  EXPECT_EQ(planner.settings.at("safety_dist"), "0.15");
  EXPECT_EQ(planner.settings.at("angle_epsilon_deg"), "10.0");
  const auto amcl =
      std::find_if(world.robots[0].devices.begin(), world.robots[0].devices.end(),
                   [](const DeviceDescription& device) { return device.type == "amcl"; });
  ASSERT_NE(amcl, world.robots[0].devices.end());
  const auto& params = std::any_cast<const AmclParams&>(amcl->params);
  EXPECT_EQ(params.laser, "laser");
  EXPECT_EQ(params.odometry, "pose") << "localization \"gps\" is Stage's default";
  EXPECT_EQ(params.max_samples, 500);
  EXPECT_DOUBLE_EQ(params.update_m, 0.1);
  EXPECT_NEAR(params.update_rad, 5.0 * M_PI / 180.0, 1e-9);
  EXPECT_THAT(world.notes, Contains(HasSubstr("all devices of r0 are on 6665")));
  // The planner uses amcl's pose, but programs do not find it at this address.
  EXPECT_THAT(world.notes,
              Contains(HasSubstr("the address \"7000:position2d:2\" of the driver \"amcl\" is")));
  EXPECT_THAT(world.notes, SizeIs(2));
}

// As in the documentation of Player's vfh and wavefront.
TEST(StageDrivers, WavefrontWithVfhInput_UsesRobotPosition) {
  const WorldDescription world = read(
      "driver ( name \"vfh\" provides [\"position2d:1\"] requires [\"position2d:0\" \"ranger:0\"] "
      ")\n"
      "driver ( name \"wavefront\" provides [\"planner:0\"]\n"
      "  requires [\"output:::position2d:1\" \"input:::position2d:1\" \"map:0\"] )");
  ASSERT_THAT(world.robots[0].drivers, SizeIs(2));
  const auto& settings = world.robots[0].drivers[1].settings;
  EXPECT_EQ(settings.at("output"), "1");
  EXPECT_FALSE(settings.contains("position")) << "by default it is the robot's first one";
}

TEST(StageDrivers, MissingLaser_DriverLeftOut) {
  for (const char* name : {"nd", "vfh", "snd", "amcl"}) {
    const WorldDescription world = read(std::string("driver ( name \"") + name +
                                            "\" provides [\"position2d:1\"] "
                                            "requires [\"position2d:0\"] )",
                                        "ranger ( sensor ( samples 1 ) )");
    EXPECT_THAT(world.robots[0].drivers, IsEmpty());
    EXPECT_THAT(world.notes, Contains(HasSubstr("the driver \"" + std::string(name) +
                                                "\" is left out: the robot has no laser")));
  }
}

TEST(StageDrivers, Amcl_UsesLaserInsteadOfSonars) {
  const WorldDescription world = read(
      "driver ( name \"mapfile\" provides [\"map:1\"] filename \"x.png\" )\n"
      "driver ( name \"mapscale\" provides [\"map:0\"] requires [\"map:1\"] )\n"
      "driver ( name \"amcl\" provides [\"localize:0\"]\n"
      "  requires [\"odometry::position:0\" \"sonar:0\" \"sonar::map:0\"]\n"
      "  scount 1 spose[0] [0 0 0] enable_gui 0 odom_drift[0] [0.2 0 0] )");
  EXPECT_THAT(world.notes, Contains(HasSubstr("laser only; \"sonar\" is left out")));
  EXPECT_THAT(world.notes,
              Contains(HasSubstr("options of the driver \"amcl\" are left out: odom_drift[0]")));
  EXPECT_THAT(world.notes, Each(Not(HasSubstr("mapscale"))));
}

TEST(StageDrivers, ScanDrivers_AreFurtherLasers) {
  const WorldDescription world = read(
      "driver ( name \"rangertolaser\" provides [\"laser:0\"] requires [\"ranger:0\"] )\n"
      "driver ( name \"lasercspace\" provides [\"laser:2\"] requires [\"laser:0\"]\n"
      "  radius 0.3 step 2 )\n"
      "driver ( name \"laserposeinterpolator\" provides [\"laser:1\"]\n"
      "  requires [\"laser:0\" \"position2d:0\"] interpolate 0 max_scans 10 )\n"
      "driver ( name \"localbb\" provides [\"blackboard:0\"] )");
  ASSERT_THAT(world.robots[0].drivers, SizeIs(2));
  const DriverDescription& cspace = world.robots[0].drivers[0];
  EXPECT_EQ(cspace.type, "lasercspace");
  EXPECT_EQ(cspace.settings.at("index"), "2");
  EXPECT_EQ(cspace.settings.at("laser"), "0");
  EXPECT_EQ(cspace.settings.at("radius"), "0.3");
  EXPECT_EQ(cspace.settings.at("step"), "2");
  const DriverDescription& stamped = world.robots[0].drivers[1];
  EXPECT_EQ(stamped.type, "laserposeinterpolator");
  EXPECT_EQ(stamped.settings.at("index"), "1");
  EXPECT_EQ(stamped.settings.at("position"), "0");
  EXPECT_EQ(stamped.settings.at("interpolate"), "false");
  EXPECT_THAT(world.notes, Contains(HasSubstr("are left out: max_scans")));
  EXPECT_THAT(world.notes, Each(Not(HasSubstr("localbb"))));
}

TEST(StageDrivers, ScanReaders_LeftOut) {
  const WorldDescription world = read(
      "driver ( name \"laserposeinterpolator\" provides [\"laser:1\"]\n"
      "  requires [\"ranger:0\" \"position2d:0\"] )\n"
      "driver ( name \"lasercspace\" provides [\"laser:2\"] requires [\"laser:1\"] )");
  EXPECT_THAT(world.robots[0].drivers, SizeIs(1));
  EXPECT_THAT(world.notes, Contains(HasSubstr("\"lasercspace\" is left out: it can use only")));
}

TEST(StageDrivers, OtherDrivers_LeftOutWithMessage) {
  const WorldDescription world = read(
      "driver ( name \"mbicp\" provides [\"position2d:1\"] requires [\"position2d:0\"] )\n"
      "driver ( name \"nd\" provides [\"position2d:1\"] requires [\"position2d:7\"] )");
  EXPECT_THAT(world.notes, Contains(HasSubstr("w.cfg:3: the driver \"mbicp\" is left out")));
  EXPECT_THAT(world.notes, Contains(HasSubstr("w.cfg:4: the driver \"nd\" is left out")));
}

TEST(StageDrivers, UnmetRequirements_LeftOut) {
  // The robot has one position; what Playpen adds is not in Player's file.
  const WorldDescription world = read(
      "driver ( name \"laserposeinterpolator\" provides [\"laser:1\"]\n"
      "  requires [\"ranger:0\" \"position2d:2\"] )\n"
      "driver ( name \"vfh\" provides [\"position2d:1\"] requires [\"ranger:0\" "
      "\"position2d:7\"] )\n"
      "driver ( name \"rangertolaser\" provides [\"laser:0\"] requires [\"ranger:3\" ] )\n"
      "driver ( name \"mbicp\" provides [\"position2d:3\"] requires [\"position2d:0\"] )\n"
      "driver ( name \"snd\" provides [\"position2d:4\"] requires [\"position2d:3\"] )\n");
  EXPECT_FALSE(world.robots[0].drivers.size() > 0);
  EXPECT_THAT(world.notes,
              Contains(HasSubstr("w.cfg:3: the driver \"laserposeinterpolator\" is left "
                                 "out: nothing provides \"position2d:2\"")));
  EXPECT_THAT(world.notes, Contains(HasSubstr("w.cfg:5: the driver \"vfh\" is left out: nothing "
                                              "provides \"position2d:7\"")));
  EXPECT_THAT(world.notes, Contains(HasSubstr("w.cfg:6: the driver \"rangertolaser\" is left out: "
                                              "nothing provides \"ranger:3\"")));
  EXPECT_THAT(world.notes, Contains(HasSubstr("w.cfg:7: the driver \"mbicp\" is left out")));
  EXPECT_THAT(world.notes, Contains(HasSubstr("w.cfg:8: the driver \"snd\" is left out: nothing "
                                              "provides \"position2d:3\"")));
}

TEST(StageDrivers, UnprovidedAddresses_HaveLine) {
  const WorldDescription world = read(
      "driver ( name \"vfh\" provides [\"position2d:1\" \"truth:0\"]\n"
      "  requires [\"position2d:0\" \"ranger:0\"] )\n"
      "driver ( name \"wavefront\" provides [\"planner:0\"] requires\n"
      "  [\"output:::position2d:1\" \"input:::position2d:0\" \"offline:::planner:1\"\n"
      "   \"map:0\"] )\n"
      "driver ( name \"mapfile\" provides [\"map:2\"] filename \"x.png\" resolution 0.1 )\n"
      "driver ( name \"stage\" model \"r1\" provides [\"6667:position2d:0\" "
      "\"6667:graphics2d:0\"\n"
      "  \"6667:graphics2d:1\" \"6667:graphics3d:0\" \"6667:speech:0\"] )\n");
  EXPECT_THAT(world.robots[0].drivers, SizeIs(2));
  EXPECT_THAT(
      world.notes,
      testing::UnorderedElementsAre(
          HasSubstr("w.cfg:3: the address \"truth:0\" of the driver \"vfh\" is left out"),
          HasSubstr("w.cfg:6: nothing provides \"offline:::planner:1\"; the driver \"wavefront\""),
          HasSubstr("w.cfg:8: the address \"map:2\" is left out: it is \"map:0\" here"),
          HasSubstr("w.cfg:10: the address \"6667:graphics2d:1\" is left out: it is "
                    "\"graphics2d:0\" here"),
          HasSubstr("w.cfg:10: the interface \"graphics3d\" is left out")));
}

TEST(StageDrivers, RobotsOnSamePort_KeepGraphicsButNoDrivers) {
  test_support::TemporaryFolder folder;
  folder.write("w.cfg", R"(
driver ( name "stage" provides ["simulation:0"] worldfile "w.world" )
driver ( name "stage" provides ["position2d:0" "graphics2d:0" "ranger:0"] model "a" )
driver ( name "stage" provides ["position2d:1" "graphics2d:1" "ranger:1"] model "b" )
driver ( name "vfh" provides ["position2d:2"] requires ["position2d:0" "ranger:0"] )
)");
  const std::string bot = std::string("position ( size [0.4 0.4 0.2] ") + kScanner;
  const WorldDescription world = load_world(
      folder.write("w.world", bot + " name \"a\" )\n" + bot + " name \"b\" pose [2 0 0 0] )\n"));
  EXPECT_EQ(world.robots_on_port, 6665);
  // A port that several robots share offers devices only.
  EXPECT_THAT(world.robots[0].drivers, IsEmpty());
  EXPECT_THAT(world.notes,
              testing::ElementsAre(HasSubstr("w.cfg:5: the driver \"vfh\" is left out: a "
                                             "port that several robots share")));
}

TEST(StageDrivers, TakenAddress_GetsNextIndex) {
  // Of two servers in Player; here all are on the robot's port.
  const WorldDescription world = read(
      "driver ( name \"vfh\" provides [\"7000:position2d:0\"]\n"
      "  requires [\"6665:position2d:0\" \"6665:ranger:0\"] )\n"
      "driver ( name \"wavefront\" provides [\"7000:planner:2\"] requires\n"
      "  [\"output::7000:position2d:0\" \"input::6665:position2d:0\" \"map:0\"] )\n");
  ASSERT_THAT(world.robots[0].drivers, SizeIs(2));
  EXPECT_EQ(world.robots[0].drivers[0].settings.at("index"), "1");
  EXPECT_EQ(world.robots[0].drivers[1].settings.at("output"), "1");
  EXPECT_EQ(world.robots[0].drivers[1].settings.at("index"), "2");
  EXPECT_THAT(world.notes, Contains(HasSubstr("w.cfg:3: the address \"7000:position2d:0\" of the "
                                              "driver \"vfh\" is taken: it is "
                                              "\"position2d:1\" here")));
}

TEST(StageDrivers, Converters_LeaveDeviceItsInterfacesOnly) {
  const WorldDescription world = read(
      "driver ( name \"rangertolaser\" provides [\"laser:1\" \"sonar:0\"] requires "
      "[\"ranger:0\"] )\n"
      "driver ( name \"rangertolaser\" provides [\"laser:0\"] requires [\"ranger:1\"] )\n"
      "driver ( name \"passthrough\" provides [\"ranger:4\"] requires [\"ranger:0\"] )\n"
      "driver ( name \"stage\" provides [\"ranger:1\"] model \"r0\" )\n",
      std::string(kScanner) + " " + kScanner);
  // In the order of the indexes, not of the file.
  EXPECT_THAT(world.robots[0].interfaces.at("laser"), testing::ElementsAre("laser2", "laser"));
  EXPECT_FALSE(world.robots[0].interfaces.contains("sonar"));
  EXPECT_THAT(world.notes,
              testing::UnorderedElementsAre(
                  HasSubstr("w.cfg:3: the address \"sonar:0\" of the driver \"rangertolaser\""),
                  HasSubstr("w.cfg:5: the address \"ranger:4\" is left out: it is \"ranger:0\"")));
}

TEST(StageDrivers, PlannerWithRobotOutput_DrivesStraight) {
  // Stage's position models take goals themselves (libstageplugin/p_position.cc).
  const WorldDescription world = read(
      "driver ( name \"wavefront\" provides [\"planner:0\"] requires\n"
      "  [\"output:::position2d:0\" \"input:::position2d:0\" \"map:0\"] )\n");
  ASSERT_THAT(world.robots[0].drivers, SizeIs(2));
  EXPECT_EQ(world.robots[0].drivers[0].type, "goto");
  EXPECT_EQ(world.robots[0].drivers[0].settings.at("index"), "1");
  EXPECT_EQ(world.robots[0].drivers[1].type, "wavefront");
  EXPECT_EQ(world.robots[0].drivers[1].settings.at("output"), "1");
  EXPECT_THAT(world.notes, testing::ElementsAre(HasSubstr("w.cfg:3: the robot's position drives")));
}

TEST(StageDrivers, PositionOfOtherDriver_ReplacedByRobot) {
  const WorldDescription world = read(
      "driver ( name \"nd\" provides [\"position2d:1\"] requires\n"
      "  [\"output:::position2d:0\" \"input:::position2d:2\" \"ranger:0\"] )\n"
      "driver ( name \"amcl\" provides [\"localize:0\" \"position2d:2\"] requires\n"
      "  [\"odometry:::position2d:0\" \"ranger:0\" \"laser:::map:0\"] )\n");
  ASSERT_THAT(world.robots[0].drivers, SizeIs(1));
  EXPECT_EQ(world.robots[0].drivers[0].settings.at("position"), "0");
  EXPECT_THAT(world.notes,
              Contains(HasSubstr("w.cfg:4: the driver \"nd\" uses the robot's position, "
                                 "not \"input:::position2d:2\" of the driver "
                                 "\"amcl\"")));
}

TEST(StageDrivers, Angles_UnitOfFile) {
  const WorldDescription world = read(
      "unit_angle \"radians\" unit_length \"cm\"\n"
      "driver ( name \"vfh\" provides [\"position2d:1\"] requires [\"position2d:0\" \"ranger:0\"]\n"
      "  max_turnrate_0ms 1.5707963267948966 max_speed 30 sector_angle 10 )");
  ASSERT_THAT(world.robots[0].drivers, SizeIs(1));
  const auto& settings = world.robots[0].drivers[0].settings;
  EXPECT_EQ(settings.at("max_turnrate_0ms_deg"), "90.0");
  EXPECT_EQ(settings.at("max_speed"), "0.3");
  EXPECT_EQ(settings.at("sector_angle_deg"), "10.0") << "Player reads it as a number";
}

// Each property, section and driver of a configuration file has an effect or a line.
TEST(StageDrivers, SettingsWithoutEffect_HaveLine) {
  const std::string requires_all = "requires [\"position2d:0\" \"ranger:0\" \"map:0\"] ";
  const auto lines_of = [&](const std::string& drivers) { return read(drivers).notes; };
  const auto noted = [](int line) {
    return Contains(HasSubstr("w.cfg:" + std::to_string(line) + ": "));
  };
  const std::string odd = "\nno_such_thing 1\n";
  EXPECT_THAT(lines_of(odd), noted(4));
  EXPECT_THAT(lines_of("plugin \"libdriver.so\"\n"), noted(3));
  EXPECT_THAT(lines_of("section ( name \"x\" )\n"), noted(3));
  EXPECT_THAT(
      lines_of("driver ( name \"stage\" model \"r1\" provides [\"6667:position2d:0\"]" + odd + ")"),
      noted(4));
  EXPECT_THAT(lines_of("driver ( name \"stage\" model \"r1\" provides [\"6667:position2d:0\"]\n"
                       "part ( x 1 ) )"),
              noted(4));
  struct Driver {
    const char* name;
    const char* provides;
  };
  constexpr Driver kDrivers[] = {
      {"snd", "position2d:1"},
      {"vfh", "position2d:1"},
      {"nd", "position2d:1"},
      {"goto", "position2d:1"},
      {"amcl", "localize:0"},
      {"lasercspace", "laser:1"},
      {"rangertolaser", "laser:0"},
      {"passthrough", "ranger:2"},
      {"mapfile", "map:0"},
      {"mapscale", "map:0"},
      {"localbb", "blackboard:0"},
      {"lasertoranger", "ranger:2"},
      {"laserposeinterpolator", "laser:1"},
  };
  for (const Driver& driver : kDrivers) {
    const std::string begin = std::string("driver ( name \"") + driver.name + "\" provides [\"" +
                              driver.provides + "\"] " + requires_all;
    EXPECT_THAT(lines_of(begin + ")"), Each(Not(HasSubstr(": the driver"))))
        << driver.name << " is known";
    EXPECT_THAT(lines_of(begin + odd + ")"), noted(4)) << driver.name;
    EXPECT_THAT(lines_of(begin + "\npart ( x 1 ) )"), noted(4)) << driver.name;
  }
}

TEST(StageDrivers, MissingInterface_LeftOutIfOthersExist) {
  test_support::TemporaryFolder folder;
  folder.write("w.world", "position ( name \"r0\" size [0.4 0.4 0.2] )");
  const WorldDescription world = load_world(folder.write(
      "some.cfg",
      "driver ( name \"stage\" provides [\"simulation:0\"] worldfile \"w.world\" )\n"
      "driver ( name \"stage\" provides [\"position2d:0\" \"laser:0\"] model \"r0\" )"));
  EXPECT_THAT(world.notes, Contains(HasSubstr("some.cfg:2: no model on r0 that offers \"laser\"")));
}

TEST(StageDrivers, SingleUnknownModel_IsFirstRobot) {
  test_support::TemporaryFolder folder;
  folder.write("w.world", "position ( name \"r0\" size [0.4 0.4 0.2] )");
  const WorldDescription world = load_world(
      folder.write("other.cfg",
                   "driver ( name \"stage\" provides [\"simulation:0\"] worldfile \"w.world\" )\n"
                   "driver ( name \"stage\" provides [\"6670:position2d:0\"] model \"machine\" )"));
  EXPECT_EQ(world.robots[0].port, 6670);
  EXPECT_THAT(world.notes, Contains(HasSubstr("\"r0\", takes its place")));
}

}  // namespace
}  // namespace sim
