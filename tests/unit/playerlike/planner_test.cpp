// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// The driver wavefront and PlannerProxy, over a host in this process, by function calls and by
// messages.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>
#include <string>

#include "fake_session.h"
#include "libCCMorse/CCMorse.h"
#include "patient_host.h"
#include "reachable_host.h"

namespace {

using PlayerCc::PlannerProxy;
using PlayerCc::PlayerClient;
using PlayerCc::PlayerError;
using PlayerCc::Position2dProxy;
using test::error_code_of;
using test::ReachableHost;
using test::Transport;
using testing::HasSubstr;

// Two rooms with a door at the top of the wall between them. position2d:1 is odometry, which starts
// at (0, 0, 0).
std::string rooms(const std::string& drivers) {
  return R"({"arena": {"size": [4, 3], "obstacles": [{"center": [2, 1.1], "size": [0.1, 2.2]}]},
    "robots": [{"name": "r1", "pose": {"x": 0.8, "y": 0.6, "yaw_deg": 90}, "drivers": )" +
         drivers + "}]}";
}
const std::string kWavefront =
    R"({"type": "wavefront", "safety_dist": 0.05, "distance_epsilon": 0.1, "cell_size": 0.02})";
const std::string kDrivers = R"([{"type": "snd"}, )" + kWavefront + "]";

struct PlannerTest : testing::TestWithParam<Transport> {
  void start(const std::string& text) {
    host =
        std::make_unique<ReachableHost>(test::patient_host(sim::load_world_text(text)), GetParam());
  }
  std::unique_ptr<ReachableHost> host;
};

INSTANTIATE_TEST_SUITE_P(Transports, PlannerTest,
                         testing::Values(Transport::kInProcess, Transport::kCbor),
                         [](const auto& instance) { return transport_name(instance.param); });

// Reads until the goal is reached, at most this many rounds.
void read_until_done(PlayerClient& client, const PlannerProxy& planner, int rounds) {
  for (int i = 0; i < rounds && planner.GetPathDone() == 0; ++i) client.Read();
}

TEST_P(PlannerTest, GoalInOtherRoom_ReachedThroughDoor) {
  start(rooms(kDrivers));
  PlayerClient client(host->connect(6665));
  PlannerProxy planner(&client, 0);
  EXPECT_EQ(planner.GetDriverName(), "wavefront");
  client.Read();
  EXPECT_EQ(planner.GetPathValid(), 0U);
  planner.SetGoalPose(3.2, 0.6, 0.0);
  EXPECT_EQ(planner.GetGx(), 3.2);
  for (int i = 0; i < 5; ++i) client.Read();
  EXPECT_TRUE(planner.IsFresh());
  EXPECT_EQ(planner.GetPathValid(), 1U);
  EXPECT_EQ(planner.GetPathDone(), 0U);
  EXPECT_EQ(planner.GetCurrentWaypointId(), 0);
  planner.RequestWaypoints();
  ASSERT_GE(planner.GetWaypointCount(), 3U);
  // Over the end of the wall at (2, 2.2) and at least 0.15 m beside it.
  EXPECT_GT(planner.GetPathLength(), 2.0 * std::hypot(1.2, 1.6));
  EXPECT_LT(planner.GetPathLength(), 2.0 * std::hypot(1.2, 1.6) + 1.0);
  const auto last = static_cast<int>(planner.GetWaypointCount()) - 1;
  EXPECT_EQ(planner.GetIx(last), 3.2);
  EXPECT_EQ(planner.GetIa(last), 0.0);
  EXPECT_EQ(planner.GetWx(), planner.GetIx(0));
  read_until_done(client, planner, 600);
  EXPECT_EQ(planner.GetPathDone(), 1U);
  EXPECT_EQ(planner.GetCurrentWaypointId(), -1);
  EXPECT_LE(std::hypot(planner.GetPx() - 3.2, planner.GetPy() - 0.6), 0.1 + 0.02);
  EXPECT_EQ(host->statistics(0).collisions, 0);
  Position2dProxy position(&client, 0);
  for (int i = 0; i < 3; ++i) client.Read();
  EXPECT_EQ(position.GetXSpeed(), 0.0);
}

TEST_P(PlannerTest, Waypoints_ConvertedToFrameOfDriver) {
  start(rooms(R"([{"type": "snd", "position": 1}, )" + kWavefront + "]"));
  PlayerClient client(host->connect(6665));
  PlannerProxy planner(&client, 0);
  Position2dProxy odometry(&client, 1);
  client.Read();
  planner.SetGoalPose(3.2, 0.6, 0.0);
  read_until_done(client, planner, 600);
  EXPECT_EQ(planner.GetPathDone(), 1U);
  EXPECT_LE(std::hypot(planner.GetPx() - 3.2, planner.GetPy() - 0.6), 0.1 + 0.02);
  // The start was (0.8, 0.6, 90 degrees): x of odometry points along y of the world.
  EXPECT_NEAR(odometry.GetYPos(), -2.4, 0.25);
  EXPECT_EQ(host->statistics(0).collisions, 0);
}

TEST_P(PlannerTest, LocalizeAndOtherDriver_Used) {
  start(rooms(R"([{"type": "snd"}, {"type": "nd", "avoid_dist": 0.15, "goal_tol": 0.1,
                   "max_turnrate_deg": 90},
                  {"type": "wavefront", "safety_dist": 0.05, "cell_size": 0.02, "localize": 0,
                   "distance_epsilon": 0.12, "output": 3}])"));
  PlayerClient client(host->connect(6665));
  PlannerProxy planner(&client, 0);
  client.Read();
  planner.SetGoalPose(3.2, 0.6, 0.0);
  read_until_done(client, planner, 900);
  EXPECT_EQ(planner.GetPathDone(), 1U);
  EXPECT_EQ(host->statistics(0).collisions, 0);
}

TEST_P(PlannerTest, GoalInWall_NoPathAndRobotStands) {
  start(rooms(kDrivers));
  PlayerClient client(host->connect(6665));
  PlannerProxy planner(&client, 0);
  Position2dProxy position(&client, 0);
  client.Read();
  planner.SetGoalPose(3.2, 0.6, 0.0);
  for (int i = 0; i < 20; ++i) client.Read();
  EXPECT_NE(position.GetXSpeed(), 0.0);
  planner.SetGoalPose(2.0, 1.0, 0.0);
  for (int i = 0; i < 5; ++i) client.Read();
  EXPECT_EQ(planner.GetPathValid(), 0U);
  EXPECT_EQ(planner.GetWaypointCount(), 0U);
  EXPECT_EQ(position.GetXSpeed(), 0.0);
}

TEST_P(PlannerTest, Disabled_RobotStands) {
  start(rooms(kDrivers));
  PlayerClient client(host->connect(6665));
  PlannerProxy planner(&client, 0);
  Position2dProxy position(&client, 0);
  client.Read();
  planner.SetGoalPose(3.2, 0.6, 0.0);
  for (int i = 0; i < 20; ++i) client.Read();
  EXPECT_NE(position.GetXSpeed(), 0.0);
  planner.SetEnable(false);
  for (int i = 0; i < 5; ++i) client.Read();
  EXPECT_EQ(position.GetXSpeed(), 0.0);
  EXPECT_EQ(planner.GetPathDone(), 0U);
  planner.SetEnable(true);
  read_until_done(client, planner, 600);
  EXPECT_EQ(planner.GetPathDone(), 1U);
}

TEST_P(PlannerTest, StartGiven_OnlyPlans) {
  start(rooms(kDrivers));
  PlayerClient client(host->connect(6665));
  PlannerProxy planner(&client, 0);
  client.Read();
  planner.SetStartPose(3.2, 2.0, 0.0);
  planner.SetGoalPose(3.2, 0.6, 0.0);
  for (int i = 0; i < 10; ++i) client.Read();
  planner.RequestWaypoints();
  EXPECT_EQ(planner.GetPathValid(), 1U);
  EXPECT_EQ(planner.GetWaypointCount(), 1U);
  EXPECT_NEAR(planner.GetPathLength(), 1.4, 0.03);
  EXPECT_NEAR(planner.GetPx(), 0.8, 0.01);
  EXPECT_NEAR(planner.GetPy(), 0.6, 0.01);
  planner.SetEnable(true);  // from the robot again
  for (int i = 0; i < 5; ++i) client.Read();
  planner.RequestWaypoints();
  EXPECT_GT(planner.GetPathLength(), 3.0);
}

TEST_P(PlannerTest, InvalidNumbersAndMissingPlanners_Refused) {
  start(rooms(kDrivers));
  PlayerClient client(host->connect(6665));
  PlannerProxy planner(&client, 0);
  EXPECT_EQ(error_code_of([&] { planner.SetGoalPose(std::nan(""), 0.0, 0.0); }),
            PlayerError::kBadArgument);
  EXPECT_EQ(error_code_of([&] { planner.SetStartPose(0.0, HUGE_VAL, 0.0); }),
            PlayerError::kBadArgument);
  EXPECT_EQ(planner.GetWaypoint(5).px, 0.0);
  try {
    PlannerProxy other(&client, 1);
    FAIL();
  } catch (const PlayerError& e) {
    EXPECT_EQ(e.GetErrorCode(), PlayerError::kNoSuchDevice);
    EXPECT_THAT(e.GetErrorStr(), HasSubstr("planner:0 (r1.wavefront)"));
  }
}

TEST(Planner, WithoutDriver_NotOffered) {
  const auto host = test::patient_host(sim::load_world_text(rooms("[]")));
  PlayerClient client(host->connect(6665));
  try {
    PlannerProxy planner(&client, 0);
    FAIL();
  } catch (const PlayerError& e) {
    EXPECT_THAT(e.GetErrorStr(), HasSubstr("worlds/examples/wavefront.json"));
  }
}

std::string planned_run(Transport transport) {
  ReachableHost host(test::patient_host(sim::load_world_text(rooms(kDrivers))), transport);
  PlayerClient client(host.connect(6665));
  PlannerProxy planner(&client, 0);
  std::ostringstream trace;
  trace.precision(17);
  planner.SetGoalPose(3.2, 0.6, 0.0);
  for (int i = 0; i < 150; ++i) {
    client.Read();
    trace << planner.GetPx() << ' ' << planner.GetPy() << ' ' << planner.GetPa() << ' '
          << planner.GetPathValid() << planner.GetPathDone() << planner.GetCurrentWaypointId()
          << '\n';
  }
  return trace.str();
}

TEST_P(PlannerTest, Repeatable) {
  const std::string first = planned_run(Transport::kInProcess);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(planned_run(GetParam()), first) << "run " << i + 2;
}

}  // namespace
