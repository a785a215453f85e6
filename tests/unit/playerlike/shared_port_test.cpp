// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Several robots on one Player port: the key robots_on_port of worlds.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <libplayerc++/playerc++.h>

#include <string>
#include <vector>

#include "player_errors.h"
#include "playerlike/host/host.h"
#include "playerlike/messages/messages.h"
#include "reachable_host.h"
#include "sim/core/error.h"
#include "sim/simulation/simulation.h"

namespace {

using namespace PlayerCc;
using test::Transport;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

// r0 and r1 set the indices of their rangers; r2 does not. r3 has its own port.
std::string world(const std::string& rangers_of_r1) {
  const std::string devices = R"("devices": {"pose": {}, "motion": {}, "odometry": {},
                                 "laser": {"beams": 11}, "sonar": {}})";
  return R"({"arena": {"size": [9, 9]}, "robots_on_port": 7000, "robots": [
    {"name": "r0", "pose": {"x": 1, "y": 1}, "proxies": {"ranger": 1}, )" +
         devices + R"(},
    {"name": "own", "port": 7001, "pose": {"x": 7, "y": 7}, )" +
         devices + R"(},
    {"name": "r1", "pose": {"x": 3, "y": 1}, "proxies": {"ranger": )" +
         rangers_of_r1 + "}, " + devices + R"(},
    {"name": "r2", "pose": {"x": 5, "y": 1}, "proxies": {"laser": 7, "ranger": 9}, )" +
         devices + "}]}";
}

struct SharedPort : testing::TestWithParam<Transport> {
  SharedPort() : host(playerlike::Host::create(sim::load_world_text(world("3"))), GetParam()) {}

  test::ReachableHost host;
};

INSTANTIATE_TEST_SUITE_P(Transports, SharedPort,
                         testing::Values(Transport::kInProcess, Transport::kCbor),
                         [](const auto& instance) { return transport_name(instance.param); });

TEST_P(SharedPort, FirstDevices_NumberedByRobot) {
  PlayerClient client(host.connect(7000));
  std::vector<double> x;
  Position2dProxy r0(&client, 0);
  Position2dProxy r1(&client, 1);
  Position2dProxy r2(&client, 2);
  client.Read();
  EXPECT_THAT((std::vector<double>{r0.GetXPos(), r1.GetXPos(), r2.GetXPos()}),
              ElementsAre(1.0, 3.0, 5.0));
  r1.SetSpeed(0.2, 0.0);
  for (int i = 0; i < 20; ++i) client.Read();
  EXPECT_GT(r1.GetXPos(), 3.2);
  EXPECT_EQ(r0.GetXPos(), 1.0);
  // A robot's own port shows all its devices. The shared port shows only devices that `proxies`
  // numbers.
  const test::ReachableHost& there = host;
  PlayerClient own(there.connect(7001));
  EXPECT_EQ(Position2dProxy(&own, 1).GetDriverName(), "odometry");
  const PlayerError error = test::error_of([&] { Position2dProxy none(&client, 3); });
  EXPECT_THAT(error.GetErrorStr(), HasSubstr("position2d:2 (r2.pose)"));
  EXPECT_THAT(error.GetErrorStr(), Not(HasSubstr("odometry")));
}

TEST_P(SharedPort, FurtherDevices_FollowIndexInProxies) {
  PlayerClient client(host.connect(7000));
  EXPECT_EQ(RangerProxy(&client, 1).GetDriverName(), "laser");
  EXPECT_EQ(RangerProxy(&client, 2).GetDriverName(), "sonar");
  RangerProxy sonar(&client, 4);  // of r1
  EXPECT_EQ(sonar.GetDriverName(), "sonar");
  const PlayerError error = test::error_of([&] { RangerProxy none(&client, 0); });
  EXPECT_THAT(error.GetErrorStr(),
              HasSubstr("ranger:1 (r0.laser), ranger:2 (r0.sonar), ranger:3 (r1.laser), ranger:4 "
                        "(r1.sonar), ranger:9 (r2.laser), ranger:10 (r2.sonar)"));
  EXPECT_THAT(error.GetErrorStr(), HasSubstr("laser:0 (r0.laser), laser:1 (r1.laser), laser:7"));
}

TEST(SharedPortWorld, DuplicateIndex_Refused) {
  try {
    static_cast<void>(playerlike::Host::create(sim::load_world_text(world("2"))));
    FAIL() << "taken";
  } catch (const sim::ConfigError& error) {
    ASSERT_EQ(error.issues().size(), 1U);
    EXPECT_EQ(error.issues()[0].id, "world/duplicate-index");
    EXPECT_EQ(error.issues()[0].pointer, "/robots/2/proxies/ranger");
    EXPECT_EQ(error.issues()[0].expected, "an index of its own for each device on port 7000");
    EXPECT_EQ(error.issues()[0].found, "ranger:2 for r1.laser, which r0.sonar has");
  }
}

TEST(SharedPortWorld, RobotsWithoutPort_ShareIt) {
  const sim::WorldDescription shared = sim::load_world_text(world("3"));
  std::vector<int> ports;
  for (const sim::RobotDescription& robot : shared.robots) ports.push_back(robot.port);
  EXPECT_THAT(ports, ElementsAre(7000, 7001, 7000, 7000));
}

}  // namespace
