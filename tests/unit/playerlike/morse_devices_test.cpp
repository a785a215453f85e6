// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "fake_session.h"
#include "libCCMorse/CCMorse.h"

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

TEST_F(Morse, ClientKnowsItsRobots) {
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

TEST_F(Morse, RobotTellsWhatItIsAndHas) {
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

TEST_F(Morse, DevicesAreFoundByNameOrType) {
  EXPECT_EQ(MorseLaser(robot).GetName(), "laser");
  EXPECT_EQ(MorsePose(robot, "pose").GetType(), "pose");
  EXPECT_EQ(MorsePose(robot).GetRobot().GetName(), "r1");
  EXPECT_DOUBLE_EQ(MorseLaser(robot).GetFrequency(), 10.0);
  EXPECT_DOUBLE_EQ(MorseLaser(robot).GetProperties().at("beams"), 5.0);
  EXPECT_EQ(error_code_of([&] { MorseLaser laser(robot, "pose"); }), MorseError::kNoSuchDevice);
  EXPECT_EQ(error_code_of([&] { MorsePen pen(robot, "laser"); }), MorseError::kNoSuchDevice);
}

TEST_F(Morse, SensorsSubscribeWhileTheyLive) {
  {
    MorseLaser laser(robot);
    EXPECT_EQ(world->subscriptions.at(kLaser.device), 1);
  }
  EXPECT_EQ(world->subscriptions.at(kLaser.device), 0);
}

TEST_F(Morse, PoseAndOdometryShowTheirReadings) {
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

TEST_F(Morse, OdometryIsSetAndReset) {
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

TEST_F(Morse, LaserShowsItsScanAndTheLeastRange) {
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

TEST_F(Morse, MotionDrives) {
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

TEST_F(Morse, PenDrawsInTheRobotsColourOrAnother) {
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

TEST_F(Morse, PenConcernsTheWholeGridMapToo) {
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

TEST_F(Morse, PropertiesAreTheWorldFiles) {
  const MorseProperties properties(robot);
  EXPECT_EQ(properties.GetModel(), "s1r");
  EXPECT_EQ(properties.GetPort(), 6665U);
  EXPECT_EQ(properties.GetColour(), ImageColour_t(0xff, 0x88, 0x00));
  EXPECT_DOUBLE_EQ(properties.GetInitialPose().px, 0.5);
  EXPECT_DOUBLE_EQ(properties.GetSize().sl, 0.174);
  // The proxies table gives the laser index 7; position2d has the robot's number.
  EXPECT_THAT(properties.GetProxyIndexes(),
              ElementsAre(Pair("graphics2d", 0), Pair("laser", 7), Pair("position2d", 0)));
  EXPECT_EQ(properties.GetProxyIndex("laser"), 7);
  EXPECT_EQ(properties.GetProxyIndex("sonar"), -1);
  EXPECT_THAT(properties.GetDriverNames(), ElementsAre("snd"));
  EXPECT_EQ(properties.GetDriverSettings("snd").at("goal_distance"), "0.1");
  EXPECT_EQ(error_code_of([&] { properties.GetDriverSettings("vfh"); }), MorseError::kNoSuchDevice);
}

TEST_F(Morse, TimeTellsHowFarTheRunIs) {
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

TEST_F(Morse, ReadAtTheEndOfTheRunSaysSo) {
  EXPECT_TRUE(client.Peek());
  try {
    client.ReadIfWaiting();
    FAIL() << "Read() returned";
  } catch (const MorseError& e) {
    EXPECT_EQ(e.GetErrorStr(), "the simulated run is over");
    EXPECT_EQ(e.GetErrorCode(), MorseError::kRunIsOver);
  }
}

TEST(MorseLifetimes, DevicesSurviveTheirClient) {
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

TEST(MorsePorts, OnARobotsOwnPortOnlyThatOneIsSeen) {
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

TEST_F(Morse, ClientPrintsRobotsAndDevices) {
  std::ostringstream out;
  out << client;
  EXPECT_THAT(out.str(), HasSubstr("r1\tlaser\tlaser"));
}

}  // namespace
