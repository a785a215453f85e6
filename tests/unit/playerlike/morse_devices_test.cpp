// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <initializer_list>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "fake_session.h"
#include "libCCMorse/CCMorse.h"
#include "playerlike/host/host.h"
#include "playerlike/messages/messages.h"
#include "sim/devices/waypoint.h"
#include "sim/simulation/simulation.h"

namespace {

using namespace CCMorse;
using test::error_code_of;
using test::fake_session;
using test::FakeWorld;
using test::kLaser;
using test::kMotion;
using test::kOdometry;
using test::kPose;
using test::make_fake_world;
using test::pose_reading;
using test::scan;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Pair;

class Morse : public testing::Test {
 protected:
  static std::shared_ptr<FakeWorld> world_on(int port) {
    auto world = make_fake_world();
    world->port = port;
    return world;
  }

  std::shared_ptr<FakeWorld> world = world_on(playerlike::kMorsePort);
  MorseClient client{fake_session(world)};
  MorseRobot robot = client.GetRobot("r1");
};

TEST_F(Morse, Client_ListsRobots) {
  EXPECT_TRUE(client.Connected());
  EXPECT_THAT(client.GetRobotNames(), ElementsAre("r1"));
  EXPECT_TRUE(client.HasRobot("r1"));
  EXPECT_FALSE(client.HasRobot("r2"));
  EXPECT_EQ(client.GetRobot().GetName(), "r1");
  try {
    client.GetRobot("r2");
    FAIL() << "r2 exists";
  } catch (const MorseError& e) {
    EXPECT_EQ(e.GetErrorCode(), MorseError::kNoSuchDevice);
    EXPECT_EQ(e.GetErrorFun(), "MorseClient::GetRobot");
    EXPECT_THAT(e.GetErrorStr(), HasSubstr("r1"));
  }
}

TEST_F(Morse, Robot_ReportsTypeAndDevices) {
  EXPECT_EQ(robot.GetModel(), "s1r");
  EXPECT_EQ(robot.GetPort(), 6665U);
  EXPECT_DOUBLE_EQ(robot.GetInitialPose().pa, 1.5);
  EXPECT_DOUBLE_EQ(robot.GetLength(), 0.174);
  EXPECT_DOUBLE_EQ(robot.GetWidth(), 0.162);
  EXPECT_DOUBLE_EQ(robot.GetHeight(), 0.18);
  EXPECT_DOUBLE_EQ(robot.GetMaxSpeed(), 0.5);
  EXPECT_DOUBLE_EQ(robot.GetMaxTurnRate(), 3.0);
  EXPECT_THAT(robot.GetDeviceNames(), ElementsAre("laser", "motion", "odometry", "pen", "pose"));
  EXPECT_TRUE(robot.HasDevice("pose"));
  EXPECT_EQ(robot.GetDevice("laser").type, "laser");
  EXPECT_DOUBLE_EQ(robot.GetDevice("laser").properties.at("range_max"), 5.0);
  EXPECT_EQ(robot.GetDevices().size(), 5U);
  EXPECT_EQ(error_code_of([&] { robot.GetDevice("sonar"); }), MorseError::kNoSuchDevice);
}

TEST_F(Morse, Devices_FoundByNameOrType) {
  EXPECT_EQ(MorseLaser(robot).GetName(), "laser");
  EXPECT_EQ(MorsePose(robot, "pose").GetType(), "pose");
  EXPECT_EQ(MorsePose(robot).GetRobot().GetName(), "r1");
  EXPECT_DOUBLE_EQ(MorseLaser(robot).GetFrequency(), 10.0);
  EXPECT_DOUBLE_EQ(MorseLaser(robot).GetProperties().at("beams"), 5.0);
  EXPECT_EQ(error_code_of([&] { MorseLaser laser(robot, "pose"); }), MorseError::kNoSuchDevice);
  EXPECT_EQ(error_code_of([&] { MorsePen pen(robot, "laser"); }), MorseError::kNoSuchDevice);
}

TEST_F(Morse, Sensors_SubscribedWhileAlive) {
  {
    MorseLaser laser(robot);
    EXPECT_EQ(world->subscriptions.at(kLaser.device), 1);
  }
  EXPECT_EQ(world->subscriptions.at(kLaser.device), 0);
}

TEST_F(Morse, PoseAndOdometry_ShowReadings) {
  MorsePose pose(robot);
  MorseOdometry odometry(robot);
  EXPECT_FALSE(pose.IsValid());
  world->add_round({{kPose, pose_reading(0.1, {1.0, 2.0, 0.5}, {0.3, -0.2, 0.01}, true)}});
  world->add_round({{kOdometry, pose_reading(0.2, {3.0, 4.0, 0.6})}});
  client.Read();
  EXPECT_TRUE(pose.IsValid());
  EXPECT_TRUE(pose.IsFresh());
  EXPECT_FALSE(odometry.IsFresh());
  EXPECT_DOUBLE_EQ(pose.GetTime(), 0.1);
  EXPECT_DOUBLE_EQ(pose.GetX(), 1.0);
  EXPECT_DOUBLE_EQ(pose.GetY(), 2.0);
  EXPECT_DOUBLE_EQ(pose.GetYaw(), 0.5);
  EXPECT_DOUBLE_EQ(pose.GetPose().py, 2.0);
  EXPECT_DOUBLE_EQ(pose.GetSpeed(), 0.3);
  EXPECT_DOUBLE_EQ(pose.GetLateralSpeed(), 0.01);
  EXPECT_DOUBLE_EQ(pose.GetTurnRate(), -0.2);
  EXPECT_TRUE(pose.GetStall());
  pose.NotFresh();
  client.Read();
  EXPECT_FALSE(pose.IsFresh());
  EXPECT_DOUBLE_EQ(odometry.GetX(), 3.0);
}

TEST_F(Morse, Odometry_SetAndReset) {
  MorseOdometry odometry(robot);
  odometry.SetPose(1.0, 2.0, 0.5);
  EXPECT_EQ(world->sent.back().first, kOdometry);
  EXPECT_EQ(std::get<sim::SetPoseCommand>(world->sent.back().second).pose,
            (sim::Pose{1.0, 2.0, 0.5}));
  odometry.Reset();
  EXPECT_EQ(std::get<sim::SetPoseCommand>(world->sent.back().second).pose, sim::Pose{});
  EXPECT_EQ(error_code_of([&] { odometry.SetPose(std::nan(""), 0.0, 0.0); }),
            MorseError::kBadArgument);
}

TEST_F(Morse, Laser_ShowsScanAndLeastRange) {
  MorseLaser laser(robot);
  EXPECT_EQ(laser.GetCount(), 0U);
  EXPECT_DOUBLE_EQ(laser.GetLeastRange(), 5.0);
  EXPECT_DOUBLE_EQ(laser.GetMinAngle(), -1.0);
  EXPECT_DOUBLE_EQ(laser.GetMaxAngle(), 1.0);
  EXPECT_DOUBLE_EQ(laser.GetMountPose().px, 0.035);
  world->add_round({{kLaser, scan(0.1, {2.0, 1.0, 5.0, 0.5, 0.5})}});
  client.Read();
  ASSERT_EQ(laser.GetCount(), 5U);
  EXPECT_DOUBLE_EQ(laser[1], 1.0);
  EXPECT_DOUBLE_EQ(laser.GetRange(4), 0.5);
  EXPECT_DOUBLE_EQ(laser.GetBearing(4), 1.0);
  EXPECT_NEAR(laser.GetPoint(2).px, 5.0, 1e-12);  // straight ahead
  EXPECT_THAT(laser.GetRanges(), ElementsAre(2.0, 1.0, 5.0, 0.5, 0.5));
  EXPECT_DOUBLE_EQ(laser.GetResolution(), 0.5);
  EXPECT_DOUBLE_EQ(laser.GetMaxRange(), 5.0);
  EXPECT_DOUBLE_EQ(laser.GetLeastRange(), 0.5);
  EXPECT_DOUBLE_EQ(laser.GetLeastAngle(), 0.5);  // beam 3, the rightmost of the two
  try {
    static_cast<void>(laser[5]);
    FAIL() << "beam 5 of 5 exists";
  } catch (const MorseError& e) {
    EXPECT_EQ(e.GetErrorFun(), "MorseLaser::GetRange");
  }
}

TEST_F(Morse, Motion_Drives) {
  MorseMotionVW motion(robot);
  motion.SetSpeed(0.2, -0.5);
  EXPECT_EQ(world->sent.back().first, kMotion);
  EXPECT_EQ(std::get<sim::TwistCommand>(world->sent.back().second).twist,
            (sim::Twist{0.2, -0.5, 0.0}));
  motion.Stop();
  EXPECT_EQ(std::get<sim::TwistCommand>(world->sent.back().second).twist, sim::Twist{});
  motion.SetMotorEnable(false);
  EXPECT_FALSE(std::get<sim::MotorEnableCommand>(world->sent.back().second).enabled);
  EXPECT_EQ(error_code_of([&] { motion.SetSpeed(0.0, std::nan("")); }), MorseError::kBadArgument);
  EXPECT_DOUBLE_EQ(motion.GetMaxSpeed(), 0.4);  // the motors' own limit is below the model's
  EXPECT_DOUBLE_EQ(motion.GetMaxTurnRate(), 2.0);
}

TEST_F(Morse, Pen_DrawsInRobotColourOrOther) {
  MorsePen pen(robot);
  EXPECT_EQ(pen.GetColour(), ImageColour_t(0xff, 0x88, 0x00));
  pen.SetPixel(1, 1);
  EXPECT_EQ(pen.GetPixel(1, 1), ImageColour_t(0xff, 0x88, 0x00));
  pen.SetPixel(2, 1, 1, 2, 3);
  EXPECT_EQ(pen.GetPixel(2, 1), ImageColour_t(1, 2, 3));
  pen.SetColour(ImageColour_t(0, 0, 255));
  pen.SetLine(1, 2, 3, 2);
  EXPECT_EQ(pen.GetPixel(3, 2), ImageColour_t(0, 0, 255));
  pen.SetLine(1, 3, 3, 3, "#ffffff");
  EXPECT_EQ(pen.GetPixel(2, 3), ImageColour_t(255, 255, 255));
  EXPECT_EQ(pen.GetY(0.0), 185);
  EXPECT_DOUBLE_EQ(pen.GetCellSize(), 0.02);
  pen.Clear();
  EXPECT_EQ(pen.GetPixel(1, 1).a, 0);
}

TEST_F(Morse, Pen_WorksOnWholeGridMap) {
  MorsePen pen(robot);
  pen.SetColour("#0000ff");
  pen.SetPixelMetres(0.05, 0.05);
  pen.SetLineMetres(0.05, 0.09, 0.09, 0.09);
  pen.SetPixelMetres(0.05, 0.13, 1, 2, 3);
  EXPECT_EQ(pen.GetPixel(2, 183), ImageColour_t(0, 0, 255));
  EXPECT_EQ(pen.GetPixel(4, 181), ImageColour_t(0, 0, 255));
  EXPECT_EQ(pen.GetPixel(2, 179), ImageColour_t(1, 2, 3));
  pen.UpdateImage({{7, 7, 1, 2, 3}});
  std::vector<std::uint8_t> image = pen.GetImage(3);
  ASSERT_EQ(image.size(), 172U * 186 * 3);
  EXPECT_EQ(image[3 * (7 * 172 + 7) + 2], 3);
  image.assign(image.size(), 9);
  pen.SetImage(image);
  EXPECT_EQ(pen.GetPixel(0, 0), ImageColour_t(9, 9, 9));
  pen.SetViewMode(CCMorse::MINI_MAP);
  EXPECT_EQ(pen.GetViewMode(), CCMorse::MINI_MAP);
  pen.SaveImage("pen.png");
  EXPECT_EQ(world->saved.size(), 1U);
  pen.Resize(50, 60);
  EXPECT_EQ(pen.GetWidth(), 50);
  EXPECT_EQ(pen.GetY(0.0), 59);
  EXPECT_EQ(pen.GetComposedImage(3).size(), 50U * 60 * 3);
}

TEST_F(Morse, Properties_FromWorldFile) {
  const MorseProperties properties(robot);
  EXPECT_EQ(properties.GetModel(), "s1r");
  EXPECT_EQ(properties.GetPort(), 6665U);
  EXPECT_EQ(properties.GetColour(), ImageColour_t(0xff, 0x88, 0x00));
  EXPECT_DOUBLE_EQ(properties.GetInitialPose().px, 0.5);
  EXPECT_DOUBLE_EQ(properties.GetSize().sl, 0.174);
  // The proxies table gives the laser index 7; position2d has the robot's number.
  EXPECT_THAT(properties.GetProxyIndexes(),
              ElementsAre(Pair("graphics2d", 0), Pair("laser", 7), Pair("localize", 0),
                          Pair("position2d", 0), Pair("ranger", 0)));
  EXPECT_EQ(properties.GetProxyIndex("laser"), 7);
  EXPECT_EQ(properties.GetProxyIndex("sonar"), -1);
  EXPECT_THAT(properties.GetDriverNames(), ElementsAre("snd"));
  EXPECT_EQ(properties.GetDriverSettings("snd").at("goal_distance"), "0.1");
  EXPECT_EQ(error_code_of([&] { properties.GetDriverSettings("vfh"); }), MorseError::kNoSuchDevice);
}

TEST_F(Morse, Time_ReportsProgressOfRun) {
  world->time.sim_time_ns = sim::from_seconds(12.5);
  world->time.steps = 1250;
  world->time.step_s = 0.01;
  world->time.real_time_factor = 400.0;
  world->time.duration_s = 60.0;
  MorseTime time(client);
  EXPECT_DOUBLE_EQ(time.Now(), 12.5);
  EXPECT_DOUBLE_EQ(time.Step(), 0.01);
  EXPECT_DOUBLE_EQ(time.RealTimeFactor(), 400.0);
  EXPECT_EQ(time.Mode(), "lockstep");
  EXPECT_EQ(time.Statistics().steps, 1250U);
  EXPECT_DOUBLE_EQ(time.Statistics().duration, 60.0);
  EXPECT_FALSE(time.Statistics().finished);
  time.Sleep(0.25);
  EXPECT_EQ(world->slept_ns, sim::from_seconds(0.25));
  world->time.finished = true;
  EXPECT_EQ(error_code_of([&] { time.Sleep(0.25); }), MorseError::kRunIsOver);
}

TEST_F(Morse, EndOfRun_ReadThrows) {
  EXPECT_TRUE(client.Peek());
  try {
    client.ReadIfWaiting();
    FAIL() << "Read() returned";
  } catch (const MorseError& e) {
    EXPECT_EQ(e.GetErrorStr(), "the simulated run is over");
    EXPECT_EQ(e.GetErrorCode(), MorseError::kRunIsOver);
  }
}

TEST(MorseLifetimes, Devices_SurviveTheirClient) {
  auto world = make_fake_world();
  auto client = std::make_unique<MorseClient>(fake_session(world));
  const MorseRobot robot = client->GetRobot();
  MorseLaser laser(robot);
  MorseMotionVW motion(robot);
  world->add_round({{kLaser, scan(0.1, {1.0, 2.0})}});
  client->Read();
  EXPECT_TRUE(laser.IsValid());
  client.reset();
  EXPECT_FALSE(laser.IsValid());
  EXPECT_EQ(error_code_of([&] { static_cast<void>(laser.GetCount()); }), MorseError::kDisconnected);
  EXPECT_EQ(error_code_of([&] { motion.SetSpeed(0.0, 0.0); }), MorseError::kDisconnected);
  EXPECT_EQ(robot.GetName(), "r1");
}

TEST(MorsePorts, RobotPort_ShowsThatRobotOnly) {
  auto world = make_fake_world();
  playerlike::RobotInfo other = world->robots.front();
  other.name = "r2";
  other.port = 6666;
  world->robots.push_back(other);
  world->port = 6666;
  MorseClient client(fake_session(world));
  EXPECT_THAT(client.GetRobotNames(), ElementsAre("r2"));
  EXPECT_EQ(error_code_of([&] { client.GetRobot("r1"); }), MorseError::kNoSuchDevice);
}

TEST_F(Morse, Client_PrintsRobotsAndDevices) {
  std::ostringstream out;
  out << client;
  EXPECT_THAT(out.str(), HasSubstr("r1\tlaser\tlaser"));
}

// The optional sensors of a world, over a session with a simulation. r1 faces along x, 0.413 m from
// a block whose face is at x = 1.5, and stands in a dock; r2 is 0.5 m to its left.
class MorseAddedSensors : public testing::Test {
 protected:
  std::shared_ptr<playerlike::Host> host = playerlike::Host::create(sim::load_world_text(R"({
    "arena": {
      "size": [3, 3],
      "docks": [{"pose": {"x": 1, "y": 1}}],
      "obstacles": [{"name": "block", "center": [1.75, 1], "size": [0.5, 0.5]}]
    },
    "robots": [
      {"name": "r1", "pose": {"x": 1, "y": 1}, "devices": {
        "battery": {"capacity": 0.1, "initial_charge": 50},
        "collision": {},
        "infrared": {},
        "back": {"type": "infrared", "range_max": 2, "mounts": [{"x": -0.05, "yaw_deg": 180}]},
        "proximity": {"range": 0.6},
        "sonar": {"mounts": [{"x": 0.05, "y": 0.01, "yaw_deg": -90}, {"x": 0.05}]}
      }},
      {"name": "r2", "pose": {"x": 1, "y": 1.5}}
    ]
  })"));
  MorseClient client{host->connect(playerlike::kMorsePort)};
  MorseRobot robot = client.GetRobot("r1");
};

TEST_F(MorseAddedSensors, Collision_NamesTouchedObjects) {
  MorseCollision bumpers(robot);
  MorseMotionVW motion(robot);
  EXPECT_FALSE(bumpers.IsValid());
  EXPECT_FALSE(bumpers.GetCollision());
  client.Read();
  EXPECT_TRUE(bumpers.IsValid());
  EXPECT_TRUE(bumpers.IsFresh());
  EXPECT_DOUBLE_EQ(bumpers.GetTime(), 0.1);
  EXPECT_FALSE(bumpers.GetCollision());
  EXPECT_THAT(bumpers.GetObjects(), testing::IsEmpty());
  motion.SetSpeed(0.5, 0.0);
  for (int i = 0; i < 10; ++i) client.Read();  // 0.5 m without an obstacle
  EXPECT_TRUE(bumpers.GetCollision());
  EXPECT_THAT(bumpers.GetObjects(), ElementsAre("block"));
  EXPECT_TRUE(bumpers.Touches("block"));
  EXPECT_FALSE(bumpers.Touches("r2"));
}

TEST_F(MorseAddedSensors, Battery_ReportsChargeAndStatus) {
  MorseBattery battery(robot);
  EXPECT_EQ(battery.GetStatus(), "");
  EXPECT_DOUBLE_EQ(battery.GetCapacity(), 0.1);
  EXPECT_DOUBLE_EQ(battery.GetProperties().at("initial_charge"), 50.0);
  for (int i = 0; i < 10; ++i) client.Read();
  // 180 of 360 J, and 1 s at 40 W: 220 J.
  EXPECT_NEAR(battery.GetCharge(), 100.0 * 220.0 / 360.0, 1e-9);
  EXPECT_NEAR(battery.GetEnergy(), 220.0 / 3600.0, 1e-12);
  EXPECT_NEAR(battery.GetVoltage(), 9.0 + 3.6 * 220.0 / 360.0, 1e-9);
  EXPECT_EQ(battery.GetStatus(), "Charging");
  EXPECT_TRUE(battery.IsDocked());
  for (int i = 0; i < 40; ++i) client.Read();
  EXPECT_EQ(battery.GetStatus(), "Charged");
  MorseMotionVW(robot).SetSpeed(0.5, 0.0);
  for (int i = 0; i < 5; ++i) client.Read();  // 0.25 m: out of the dock
  EXPECT_EQ(battery.GetStatus(), "Discharging");
  EXPECT_FALSE(battery.IsDocked());
}

TEST_F(MorseAddedSensors, Proximity_ReportsNearRobots) {
  MorseProximity radio(robot);
  EXPECT_THAT(radio.GetNearObjects(), testing::IsEmpty());
  client.Read();
  EXPECT_THAT(radio.GetNearObjects(), ElementsAre(Pair("r2", 0.5)));
  EXPECT_TRUE(radio.IsNear("r2"));
  EXPECT_FALSE(radio.IsNear("r3"));
  EXPECT_DOUBLE_EQ(radio.GetDistance("r2"), 0.5);
  EXPECT_DOUBLE_EQ(radio.GetMaxRange(), 0.6);
  try {
    static_cast<void>(radio.GetDistance("r3"));
    FAIL() << "r3 is near";
  } catch (const MorseError& e) {
    EXPECT_EQ(e.GetErrorCode(), MorseError::kBadArgument);
    EXPECT_EQ(e.GetErrorFun(), "MorseProximity::GetDistance");
    EXPECT_THAT(e.GetErrorStr(), HasSubstr("near are: r2"));
  }
}

TEST_F(MorseAddedSensors, Infrared_ShowsTransducersAndRanges) {
  MorseInfrared ring(robot, "infrared");
  EXPECT_EQ(ring.GetCount(), 8U);
  EXPECT_THAT(ring.GetRanges(), testing::Each(0.8));
  EXPECT_DOUBLE_EQ(ring.GetMaxRange(), 0.8);
  EXPECT_DOUBLE_EQ(ring.GetFieldOfView(), 0.0);
  EXPECT_DOUBLE_EQ(ring.GetMountPose(2).py, 0.075);
  EXPECT_DOUBLE_EQ(ring.GetMountPose(2).pa, 90.0 * PI / 180.0);
  client.Read();
  EXPECT_NEAR(ring[0], 0.5 - 0.081, 1e-6);                   // to the block
  EXPECT_NEAR(ring.GetRange(2), 0.5 - 0.075 - 0.081, 1e-6);  // to the side of r2
  EXPECT_NEAR(ring.GetPoint(2).px, 0.0, 1e-6);
  EXPECT_NEAR(ring.GetPoint(2).py, 0.5 - 0.081, 1e-6);
  EXPECT_DOUBLE_EQ(ring[4], 0.8);
  EXPECT_NEAR(ring.GetLeastRange(), 0.344, 1e-6);
  EXPECT_EQ(ring.GetLeastIndex(), 2U);
  try {
    static_cast<void>(ring[8]);
    FAIL() << "transducer 8 of 8 exists";
  } catch (const MorseError& e) {
    EXPECT_EQ(e.GetErrorCode(), MorseError::kBadArgument);
    EXPECT_EQ(e.GetErrorFun(), "MorseInfrared::GetRange");
  }
}

TEST_F(MorseAddedSensors, OneOfSeveral_FoundByName) {
  MorseInfrared back(robot, "back");
  client.Read();
  ASSERT_EQ(back.GetCount(), 1U);
  EXPECT_NEAR(back[0], 0.95, 1e-6);
  EXPECT_EQ(MorseInfrared(robot).GetName(), "back");  // the first in order of name
  EXPECT_EQ(error_code_of([&] { MorseSonar sonar(robot, "back"); }), MorseError::kNoSuchDevice);
}

TEST_F(MorseAddedSensors, Sonar_ShowsTransducersAndRanges) {
  MorseSonar sonar(robot);
  EXPECT_DOUBLE_EQ(sonar.GetMountPose(0).px, 0.05);
  EXPECT_DOUBLE_EQ(sonar.GetMountPose(0).pa, -90.0 * PI / 180.0);
  EXPECT_NEAR(sonar.GetFieldOfView(), 30.0 * PI / 180.0, 1e-12);
  client.Read();
  ASSERT_EQ(sonar.GetCount(), 2U);
  // The border below is 1.01 m away, the block 0.45 m ahead.
  EXPECT_NEAR(sonar[0], 1.01, 1e-5);
  EXPECT_NEAR(sonar[1], 0.45, 1e-5);
  EXPECT_EQ(sonar.GetLeastIndex(), 1U);
}

TEST_F(MorseAddedSensors, ListedWithPlayerInterfaces) {
  EXPECT_THAT(robot.GetDeviceNames(),
              ElementsAre("back", "battery", "collision", "infrared", "laser", "motion", "odometry",
                          "pen", "pose", "proximity", "sonar"));
  EXPECT_DOUBLE_EQ(robot.GetDevice("sonar").properties.at("count"), 2.0);
  const auto session = host->connect(playerlike::kMorsePort);
  std::vector<std::string> addresses;
  for (const auto& address : playerlike::list_interfaces(session->robots(), 4000)) {
    if (address.robot == robot.GetName()) {
      addresses.push_back(address.interface + ' ' + address.device);
    }
  }
  EXPECT_THAT(addresses,
              ElementsAre("graphics2d pen", "ir back", "laser laser", "localize pose",
                          "position2d pose", "power battery", "ranger laser", "sonar sonar"));
}

// --- Over a simulation

// A robot that faces along x at (1, 2) in an empty room.
std::shared_ptr<playerlike::Host> host_of_room() {
  return playerlike::Host::create(sim::load_world_text(R"({
      "arena": {"size": [4, 4]},
      "robots": [{"name": "r1", "pose": {"x": 1, "y": 2, "yaw_deg": 0},
                  "devices": {"waypoint": {"tolerance": 0.1, "speed": 0.4}, "teleport": {},
                              "odometry": {"level": "raw"}}}]})"));
}

class MorseInARoom : public testing::Test {
 protected:
  std::shared_ptr<playerlike::Host> host = host_of_room();
  MorseClient client{host->connect(playerlike::kMorsePort)};
  MorseRobot robot = client.GetRobot("r1");
};

TEST_F(MorseInARoom, Waypoint_DrivesToGoal) {
  MorseWaypoint waypoint(robot);
  EXPECT_EQ(waypoint.GetStatus(), "Arrived");
  EXPECT_DOUBLE_EQ(waypoint.GetGoal().px, 1.0);
  EXPECT_DOUBLE_EQ(waypoint.GetTolerance(), 0.1);
  EXPECT_DOUBLE_EQ(waypoint.GetSpeed(), 0.4);
  waypoint.Goto(2.5, 2.0);
  EXPECT_EQ(waypoint.GetStatus(), "Transit");
  EXPECT_DOUBLE_EQ(waypoint.GetDistance(), 1.5);
  int rounds = 0;
  while (!waypoint.IsArrived() && rounds < 100) {
    client.Read();
    ++rounds;
  }
  // 3.60 s, see Waypoint.GoalAhead_ReachedInExpectedTime; a round is 0.1 s.
  EXPECT_NEAR(rounds, 36, 1);
  EXPECT_LE(waypoint.GetDistance(), 0.1);
  EXPECT_EQ(waypoint.GetGoalNumber(), 1U);
  EXPECT_DOUBLE_EQ(waypoint.GetGoal().px, 2.5);
}

TEST_F(MorseInARoom, Robot_DrivesToPositionGoal) {
  EXPECT_DOUBLE_EQ(robot.GetWeight(), 2.0);
  MorsePose pose(robot);
  client.Read();
  EXPECT_FALSE(robot.HasPositionGoal());
  EXPECT_EQ(error_code_of([&] { robot.GetPositionGoal(); }), MorseError::kNotAvailable);
  EXPECT_EQ(error_code_of([&] { robot.SetPositionGoal(std::nan(""), 0.0, 0.0); }),
            MorseError::kBadArgument);
  const double x = pose.GetX() + 0.4;
  const double y = pose.GetY();
  robot.SetPositionGoal(x, y, 1.0);
  EXPECT_TRUE(robot.HasPositionGoal());
  EXPECT_DOUBLE_EQ(client.GetRobot().GetPositionGoal().px, x);  // copies share the goal
  for (int i = 0; i < 60; ++i) client.Read();
  EXPECT_NEAR(pose.GetX(), x, 0.03);
  EXPECT_NEAR(pose.GetY(), y, 0.03);
  EXPECT_NEAR(pose.GetYaw(), 1.0, 0.1);
  // The default heading is the direction from the start, (1, 2), because no Position2dProxy has
  // been read.
  robot.SetPositionGoal(2.0, 3.0);
  EXPECT_NEAR(robot.GetPositionGoal().pa, 0.785398, 1e-4);
  for (int i = 0; i < 10; ++i) client.Read();
  robot.ClearPositionGoal();
  EXPECT_FALSE(robot.HasPositionGoal());
  client.Read();
  client.Read();
  const double y_there = pose.GetY();
  client.Read();
  EXPECT_EQ(pose.GetY(), y_there);
}

TEST(MorseGoals, RobotWithoutMotors_RefusesPositionGoal) {
  auto world = make_fake_world();
  std::erase_if(world->robots[0].devices,
                [](const playerlike::DeviceInfo& device) { return device.type == "motion"; });
  MorseClient client(fake_session(world));
  MorseRobot robot = client.GetRobot();
  EXPECT_EQ(error_code_of([&] { robot.SetPositionGoal(1.0, 1.0, 0.0); }),
            MorseError::kNotAvailable);
  EXPECT_EQ(robot.GetWeight(), 0.0);  // the server does not send the weight
}

TEST_F(MorseInARoom, Waypoint_StopsAndResumes) {
  MorseWaypoint waypoint(robot);
  MorsePose pose(robot);
  waypoint.Goto(3.0, 2.0, 0.1, 0.2);
  client.Read();
  client.Read();
  waypoint.Stop();
  EXPECT_EQ(waypoint.GetStatus(), "Stop");
  client.Read();
  EXPECT_EQ(waypoint.GetStatus(), "Stop");
  EXPECT_NEAR(pose.GetX(), 1.04, 1e-9);
  waypoint.Resume();
  EXPECT_EQ(waypoint.GetStatus(), "Transit");
  client.Read();
  EXPECT_EQ(waypoint.GetStatus(), "Transit");
  EXPECT_NEAR(pose.GetX(), 1.06, 1e-9);
  MorseMotionVW(robot).SetSpeed(0.0, 0.1);  // the later command is in effect
  client.Read();
  EXPECT_EQ(waypoint.GetStatus(), "Stop");
}

TEST_F(MorseInARoom, Waypoint_ReportsNewestGoalOnly) {
  MorseWaypoint waypoint(robot);
  MorsePose pose(robot);
  client.Read();
  // Unlike Goto(), it gives no command if the robot is already at the goal.
  EXPECT_FALSE(waypoint.SetDest(1.05, 2.0));
  client.Read();
  EXPECT_EQ(waypoint.GetGoalNumber(), 0U);
  EXPECT_TRUE(waypoint.SetDest(1.5, 2.0));
  client.Read();
  EXPECT_EQ(waypoint.GetGoalNumber(), 1U);
  waypoint.Goto(1.0, 2.0, 0.5, 0.4);
  EXPECT_EQ(waypoint.GetStatus(), "Transit");
  client.Read();
  EXPECT_EQ(waypoint.GetStatus(), "Arrived");
  EXPECT_EQ(waypoint.GetGoalNumber(), 2U);
  EXPECT_EQ(error_code_of([&] { waypoint.Goto(std::nan(""), 0.0); }), MorseError::kBadArgument);
  EXPECT_EQ(error_code_of([&] { waypoint.Goto(1.0, 1.0, 0.0, 1.0); }), MorseError::kBadArgument);
  EXPECT_EQ(error_code_of([&] { waypoint.Goto(1.0, 1.0, 0.1, -1.0); }), MorseError::kBadArgument);
  EXPECT_EQ(error_code_of([&] { waypoint.SetDest(1.0, 3.0, std::nan(""), 1.0); }),
            MorseError::kBadArgument);
  EXPECT_EQ(waypoint.GetStatus(), "Arrived");
}

TEST_F(MorseInARoom, RefusedResume_NotInTransit) {
  MorseWaypoint waypoint(robot);
  waypoint.Resume();  // no goal was given: a warning
  client.Read();
  EXPECT_EQ(waypoint.GetStatus(), "Arrived");
}

TEST_F(MorseInARoom, Teleport_MovesRobotButNotOdometry) {
  MorseTeleport teleport(robot);
  MorsePose pose(robot);
  MorseOdometry odometry(robot);
  teleport.Place(3.0, 1.0, 0.5 * PI);
  client.Read();
  EXPECT_NEAR(pose.GetX(), 3.0, 1e-12);
  EXPECT_NEAR(pose.GetYaw(), 0.5 * PI, 1e-12);
  EXPECT_EQ(odometry.GetX(), 0.0);
  // Relative commands accumulate, also between two steps.
  teleport.Translate(-0.5);
  teleport.Translate(-0.5, 0.25);
  teleport.Rotate(0.25 * PI);
  teleport.Rotate(0.25 * PI);
  client.Read();
  EXPECT_NEAR(pose.GetX(), 2.0, 1e-12);
  EXPECT_NEAR(pose.GetY(), 1.25, 1e-12);
  EXPECT_NEAR(pose.GetYaw(), PI, 1e-12);
  teleport.Place(9.0, 1.0, 0.0);  // outside the floor: a warning
  client.Read();
  EXPECT_NEAR(pose.GetX(), 2.0, 1e-12);
  EXPECT_EQ(error_code_of([&] { teleport.Place(0.0, 0.0, std::nan("")); }),
            MorseError::kBadArgument);
  EXPECT_EQ(error_code_of([&] { teleport.Translate(std::nan("")); }), MorseError::kBadArgument);
  EXPECT_EQ(error_code_of([&] { teleport.Rotate(INFINITY); }), MorseError::kBadArgument);
}

TEST_F(MorseInARoom, Odometry_ShowsPoseAtEveryLevel) {
  MorseOdometry odometry(robot);
  EXPECT_EQ(odometry.GetProperties().at("level"), 2.0);
  MorseMotionVW(robot).SetSpeed(0.2, 0.0);
  for (int i = 0; i < 10; ++i) client.Read();
  EXPECT_NEAR(odometry.GetX(), 0.2, 1e-9);
}

TEST(MorseGoals, MissingDevices_Refused) {
  auto world = make_fake_world();
  MorseClient client(fake_session(world));
  const MorseRobot robot = client.GetRobot();
  EXPECT_EQ(error_code_of([&] { MorseWaypoint waypoint(robot); }), MorseError::kNoSuchDevice);
  EXPECT_EQ(error_code_of([&] { MorseTeleport teleport(robot); }), MorseError::kNoSuchDevice);
}

TEST(Commands, NonFiniteNumbers_RefusedBeforeSending) {
  const auto host = host_of_room();
  const auto session = host->connect(6665);
  const double nan = std::nan("");
  const double good = 1.0;
  using playerlike::SessionError;
  for (const sim::Command& bad : std::initializer_list<sim::Command>{
           sim::TwistCommand{{.v_mps = good, .omega_radps = nan}},
           sim::SetPoseCommand{{nan, good, good}}, sim::GotoCommand{{good, nan}},
           sim::GotoCommand{{good, good}, nan}, sim::GotoCommand{{good, good}, good, INFINITY},
           sim::PlaceCommand{{good, good, nan}}, sim::TranslateCommand{{nan, good}},
           sim::RotateCommand{-INFINITY}}) {
    try {
      session->send({0, 0}, bad);
      ADD_FAILURE() << "command of kind " << bad.index() << " was sent";
    } catch (const SessionError& e) {
      EXPECT_EQ(e.code(), SessionError::Code::kBadArgument);
    }
  }
  for (const sim::Command& sound : std::initializer_list<sim::Command>{
           sim::MotorEnableCommand{true}, sim::GotoCommand{{good, good}}, sim::StopCommand{},
           sim::ResumeCommand{}, sim::RotateCommand{good}}) {
    EXPECT_NO_THROW(playerlike::require_finite(sound)) << sound.index();
  }
}

// Devices without an interface of Player are listed and do not change the indexes of others.
TEST(Interfaces, OtherDevices_UnaffectedByWaypointAndTeleport) {
  const auto host = host_of_room();
  const auto session = host->connect(6665);
  const auto& robots = session->robots();
  ASSERT_EQ(robots.size(), 1U);
  std::vector<std::string> types;
  for (const auto& device : robots[0].devices) types.push_back(device.type);
  EXPECT_THAT(types,
              ElementsAre("laser", "motion", "odometry", "pen", "pose", "teleport", "waypoint"));
  EXPECT_DOUBLE_EQ(robots[0].devices[6].properties.at("speed"), 0.4);
  EXPECT_EQ(playerlike::find_interface(robots, 6665, "position2d", 1).reading.device, 2);
  for (const auto& address : playerlike::list_interfaces(robots, 6665)) {
    EXPECT_NE(address.device, "waypoint");
    EXPECT_NE(address.device, "teleport");
  }
}

}  // namespace
