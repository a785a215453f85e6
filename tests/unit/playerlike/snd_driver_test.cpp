// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// SndDriver and the world's drivers table, over a host in this process, by function calls and by
// messages.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <future>
#include <limits>
#include <mutex>
#include <numbers>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "fake_session.h"
#include "libCCMorse/CCMorse.h"
#include "patient_host.h"
#include "playerlike/host/host.h"
#include "reachable_host.h"
#include "sim/core/error.h"
#include "sim/simulation/simulation.h"

namespace {

using CCMorse::PlayerClient;
using CCMorse::PlayerError;
using CCMorse::Position2dProxy;
using CCMorse::SndDriver;
using CCMorse::SndSettings;
using playerlike::Host;
using test::error_code_of;
using test::ReachableHost;
using test::Transport;
using testing::AllOf;
using testing::HasSubstr;

// A room with a block between the robot, which faces along x, and the far side; drivers from the
// argument.
std::string room(const std::string& drivers, const std::string& simulation = "{}") {
  return R"({"simulation": )" + simulation + R"(,
    "arena": {"size": [4, 3], "obstacles": [{"center": [2, 1.4], "size": [0.3, 0.3]}]},
    "robots": [{"name": "r1", "pose": {"x": 0.8, "y": 1.5}, "drivers": )" +
         drivers + "}]}";
}

struct SndDriverTest : testing::TestWithParam<Transport> {
  void start(const std::string& text) {
    host = std::make_unique<ReachableHost>(
        test::patient_host(sim::load_world_text(text), {},
                           [this](sim::LogLevel, std::string_view line) {
                             const std::lock_guard lock(log_mutex);
                             log += std::string(line) + '\n';
                           }),
        GetParam());
  }
  // There must be no log output: no thread was silent, nothing was refused.
  void TearDown() override { EXPECT_EQ(log, ""); }

  std::mutex log_mutex;
  std::string log;
  std::unique_ptr<ReachableHost> host;
};

INSTANTIATE_TEST_SUITE_P(Transports, SndDriverTest,
                         testing::Values(Transport::kInProcess, Transport::kCbor),
                         [](const auto& instance) { return transport_name(instance.param); });

TEST_P(SndDriverTest, Block_PassedToPoseWithHeading) {
  start(room("[]"));
  PlayerClient client(host->connect(6665));
  Position2dProxy position(&client, 0);
  SndDriver driver(&client);
  EXPECT_EQ(driver.GetStatus(), SndDriver::IDLE);
  driver.SetGoal(3.2, 1.5, std::numbers::pi / 2.0);
  EXPECT_EQ(driver.GetStatus(), SndDriver::MOVING);
  EXPECT_EQ(driver.WaitForGoal(), SndDriver::REACHED);
  EXPECT_LE(std::hypot(position.GetXPos() - 3.2, position.GetYPos() - 1.5), 0.05);
  EXPECT_NEAR(position.GetYaw(), std::numbers::pi / 2.0, 0.1);
  client.Read();
  EXPECT_EQ(position.GetXSpeed(), 0.0);
  EXPECT_EQ(position.GetYawSpeed(), 0.0);
  EXPECT_EQ(host->statistics(0).collisions, 0);
  EXPECT_GT(host->statistics(0).least_clearance_m, 0.0);
}

TEST_P(SndDriverTest, GoalInsideBlock_BlockedAndRobotStands) {
  start(room("[]"));
  PlayerClient client(host->connect(6665));
  Position2dProxy position(&client, 0);
  SndSettings settings;
  settings.patience = 4.0;
  SndDriver driver(&client, 0, 0, settings);
  driver.SetGoal(2.0, 1.4);
  // About 1.2 m at 0.3 m/s, and the time limit without progress.
  EXPECT_EQ(driver.WaitForGoal(30.0), SndDriver::BLOCKED);
  client.Read();
  EXPECT_EQ(position.GetXSpeed(), 0.0);
  EXPECT_EQ(position.GetYawSpeed(), 0.0);
  EXPECT_EQ(host->statistics(0).collisions, 0);
}

TEST_P(SndDriverTest, Cancel_StopsRobotAndIdles) {
  start(room("[]"));
  PlayerClient client(host->connect(6665));
  Position2dProxy position(&client, 0);
  SndDriver driver(&client);
  driver.SetGoal(3.2, 1.5);
  EXPECT_EQ(driver.WaitForGoal(1.0), SndDriver::MOVING);
  EXPECT_GT(position.GetXSpeed(), 0.0);
  driver.Cancel();
  EXPECT_EQ(driver.GetStatus(), SndDriver::IDLE);
  client.Read();
  EXPECT_EQ(position.GetXSpeed(), 0.0);
  for (int i = 0; i < 5; ++i) client.Read();
  EXPECT_EQ(position.GetXSpeed(), 0.0);
  EXPECT_EQ(driver.WaitForGoal(), SndDriver::IDLE);
}

TEST_P(SndDriverTest, NewGoal_ReplacesOld) {
  start(room("[]"));
  PlayerClient client(host->connect(6665));
  Position2dProxy position(&client, 0);
  SndDriver driver(&client);
  driver.SetGoal(3.2, 1.5);
  EXPECT_EQ(driver.WaitForGoal(1.0), SndDriver::MOVING);
  driver.SetGoal(0.5, 0.5);
  EXPECT_EQ(driver.WaitForGoal(), SndDriver::REACHED);
  EXPECT_LE(std::hypot(position.GetXPos() - 0.5, position.GetYPos() - 0.5), 0.05);
}

TEST_P(SndDriverTest, InvalidSettings_RefusedByName) {
  start(room("[]"));
  PlayerClient client(host->connect(6665));
  SndDriver driver(&client);
  EXPECT_EQ(error_code_of([&] { driver.SetRobotRadius(0.0); }), PlayerError::kBadArgument);
  EXPECT_EQ(error_code_of([&] { driver.SetSafetyDistance(-1.0); }), PlayerError::kBadArgument);
  EXPECT_EQ(error_code_of([&] { driver.SetSpeedLimits(11.0, 1.0); }), PlayerError::kBadArgument);
  EXPECT_EQ(error_code_of([&] { driver.SetSpeedLimits(0.2, std::nan("")); }),
            PlayerError::kBadArgument);
  EXPECT_EQ(error_code_of([&] { driver.SetGoalTolerances(0.1, 4.0); }), PlayerError::kBadArgument);
  EXPECT_EQ(error_code_of([&] { driver.SetPatience(std::numeric_limits<double>::infinity()); }),
            PlayerError::kBadArgument);
  EXPECT_EQ(error_code_of([&] { driver.SetGoal(std::nan(""), 0.0); }), PlayerError::kBadArgument);
  EXPECT_EQ(error_code_of([&] { SndDriver other(nullptr); }), PlayerError::kBadArgument);
  EXPECT_EQ(error_code_of([&] { SndDriver other(&client, 5); }), PlayerError::kNoSuchDevice);
  EXPECT_EQ(error_code_of([&] { SndDriver other(&client, 0, 1); }), PlayerError::kNoSuchDevice);
  try {
    driver.SetGoalTolerances(20.0, 0.1);
    FAIL();
  } catch (const PlayerError& e) {
    EXPECT_EQ(e.GetErrorFun(), "SndDriver::SetSettings");
    EXPECT_THAT(e.GetErrorStr(), AllOf(HasSubstr("goal_distance"), HasSubstr("at most 10 m"),
                                       HasSubstr("but is 20")));
  }
  driver.SetGoalTolerances(0.2, 0.3);
  driver.SetSpeedLimits(0.1, 0.5);
  EXPECT_EQ(driver.GetSettings().goal_distance, 0.2);
  EXPECT_EQ(driver.GetSettings().goal_angle, 0.3);
  EXPECT_EQ(driver.GetSettings().max_speed, 0.1);
  EXPECT_EQ(driver.GetSettings().max_turn_rate, 0.5);
  EXPECT_EQ(driver.GetSettings().robot_radius, 0.1);
}

TEST_P(SndDriverTest, SizeAndSpeeds_FromModelOfRobot) {
  // The farthest corner of the Pioneer 2-DX is hypot(0.26, 0.1) = 0.2786 m from the middle of the
  // axle, which is rounded up to 0.28 m. The limits of the drive are 1.6 m/s and 300 degrees/s.
  start(R"({"arena": {"size": [8, 6]}, "robots": [
    {"name": "r1", "model": "pioneer2dx", "pose": {"x": 1, "y": 3},
     "interfaces": {"position2d": ["pose"]}, "drivers": [{"type": "snd", "max_speed": 0.4}]}]})");
  PlayerClient client(host->connect(6665));
  SndDriver driver(&client);
  const SndSettings settings = driver.GetSettings();
  EXPECT_DOUBLE_EQ(settings.robot_radius, 0.28);
  EXPECT_DOUBLE_EQ(settings.safety_distance, 0.42);
  EXPECT_DOUBLE_EQ(settings.max_speed, 0.96);
  EXPECT_NEAR(settings.max_turn_rate, 5.0 / 6.0 * std::numbers::pi, 1e-12);
  EXPECT_EQ(settings.patience, 20.0);
  // The driver keeps given settings and derives the others from the robot.
  SndSettings own;
  own.max_speed = 0.2;
  driver.SetSettings(own);
  EXPECT_EQ(driver.GetSettings().max_speed, 0.2);
  EXPECT_DOUBLE_EQ(driver.GetSettings().robot_radius, 0.28);
  driver.SetPatience(3.0);
  EXPECT_EQ(driver.GetSettings().max_speed, 0.2);
  // The world's driver also derives its settings from the robot.
  const auto session = host->connect(6665);
  const auto& of_world =
      std::get<playerlike::SndSettings>(session->robots()[0].goal_drivers.at(0).settings);
  EXPECT_DOUBLE_EQ(of_world.robot_radius_m, 0.28);
  EXPECT_DOUBLE_EQ(of_world.max_speed_mps, 0.4);
}

TEST_P(SndDriverTest, Pioneer_PassesBlockWithoutContact) {
  start(R"({"arena": {"size": [8, 6], "obstacles": [{"center": [4, 2.9], "size": [0.5, 0.5],
                                               "height": 0.5}]},
    "robots": [{"name": "r1", "model": "pioneer2dx", "pose": {"x": 1, "y": 3},
                "interfaces": {"position2d": ["pose"]}}]})");
  PlayerClient client(host->connect(6665));
  SndDriver driver(&client);
  driver.SetGoal(7.0, 3.0);
  EXPECT_EQ(driver.WaitForGoal(60.0), SndDriver::REACHED);
  EXPECT_EQ(host->statistics(0).collisions, 0);
  EXPECT_GT(host->statistics(0).least_clearance_m, 0.01);
}

TEST_P(SndDriverTest, SpeedLimit_Kept) {
  start(room("[]"));
  PlayerClient client(host->connect(6665));
  Position2dProxy position(&client, 0);
  SndDriver driver(&client);
  driver.SetSpeedLimits(0.1, 1.0);
  driver.SetGoal(1.5, 2.5);
  double fastest = 0.0;
  double sharpest = 0.0;
  while (driver.GetStatus() == SndDriver::MOVING) {
    client.Read();
    fastest = std::max(fastest, position.GetXSpeed());
    sharpest = std::max(sharpest, std::abs(position.GetYawSpeed()));
  }
  EXPECT_EQ(driver.GetStatus(), SndDriver::REACHED);
  // In the open it drives exactly at its speed limit.
  EXPECT_NEAR(fastest, 0.1, 1e-9);
  EXPECT_LE(sharpest, 1.0 + 1e-9);
}

TEST_P(SndDriverTest, RobotWithoutMotors_Refused) {
  start(R"({"robots": [{"devices": {"motion": null}}]})");
  PlayerClient client(host->connect(6665));
  EXPECT_EQ(error_code_of([&] { SndDriver driver(&client); }), PlayerError::kNotAvailable);
}

TEST_P(SndDriverTest, Destruction_StopsRobotWithoutAdvancingTime) {
  start(room("[]"));
  PlayerClient client(host->connect(6665));
  Position2dProxy position(&client, 0);
  client.Read();
  for (int i = 0; i < 20; ++i) {
    const auto before_ns = host->time().sim_time_ns;
    {
      SndDriver driver(&client);
      driver.SetGoal(3.2, 1.5);
    }
    EXPECT_EQ(host->time().sim_time_ns, before_ns);
  }
  {
    SndDriver driver(&client);
    driver.SetGoal(3.2, 1.5);
    EXPECT_EQ(driver.WaitForGoal(1.0), SndDriver::MOVING);
    EXPECT_GT(position.GetXSpeed(), 0.0);
  }
  client.Read();
  EXPECT_EQ(position.GetXSpeed(), 0.0);  // stopped by its end
}

TEST_P(SndDriverTest, BeforeFirstRead_TimeStands) {
  start(room("[]"));
  PlayerClient client(host->connect(6665));
  SndDriver driver(&client);
  driver.SetGoal(3.2, 1.5);
  // Nobody has read yet: the driver's thread waits, and time with it. Otherwise a goal given before
  // the first Read() would start at a random time.
  std::this_thread::yield();
  EXPECT_EQ(host->time().sim_time_ns, 0);
  client.Read();
  // The empty round of a client without proxies lasts a tenth of a second.
  EXPECT_EQ(host->time().sim_time_ns, 100'000'000);
}

TEST_P(SndDriverTest, StartGate_NotOpenedByDriver) {
  start(room("[]", R"({"clients": 2})"));
  PlayerClient client(host->connect(6665));
  SndDriver driver(&client);
  driver.SetGoal(3.2, 1.5);
  std::promise<void> read;
  std::thread reader([&] {
    client.Read();
    read.set_value();
  });
  PlayerClient other(host->connect(6665));
  // If the driver counted, the gate would be open with one program.
  EXPECT_EQ(host->time().sim_time_ns, 0);
  other.Read();
  read.get_future().wait();
  reader.join();
  EXPECT_EQ(host->time().sim_time_ns, 100'000'000);
}

TEST_P(SndDriverTest, EndOfRun_EndsWait) {
  start(room("[]", R"({"duration": 1})"));
  PlayerClient client(host->connect(6665));
  SndDriver driver(&client);
  driver.SetGoal(3.2, 1.5);
  EXPECT_EQ(error_code_of([&] { driver.WaitForGoal(); }), PlayerError::kRunIsOver);
}

TEST_P(SndDriverTest, Driver_OutlivesClient) {
  start(room("[]"));
  auto client = std::make_unique<PlayerClient>(host->connect(6665));
  SndDriver driver(client.get());
  driver.SetGoal(3.2, 1.5);
  client->Read();
  client.reset();
  EXPECT_EQ(error_code_of([&] { driver.SetGoal(1.0, 1.0); }), PlayerError::kDisconnected);
  EXPECT_EQ(error_code_of([&] { driver.GetStatus(); }), PlayerError::kDisconnected);
}

// A program with two threads. One drives the first robot by goals that depend on what the other has
// measured; both read their own clients.
std::string two_threads_run(Transport transport) {
  const auto world = sim::load_world_text(R"({
    "simulation": {"clients": 2, "seed": 5},
    "arena": {"size": [4, 3], "obstacles": [{"center": [2, 1.4], "size": [0.3, 0.3]}]},
    "robots": [{"name": "r1", "pose": {"x": 0.8, "y": 1.5},
                "devices": {"laser": {"noise": 0.01}}},
               {"name": "r2", "pose": {"x": 3.2, "y": 0.6, "yaw_deg": 180}}]})");
  const auto host = std::make_unique<ReachableHost>(test::patient_host(world), transport);
  std::ostringstream trace;
  trace.precision(17);
  std::atomic<bool> done{false};
  std::thread other([&] {
    PlayerClient client(host->connect(6666));
    Position2dProxy position(&client, 0);
    SndDriver driver(&client);
    for (int i = 0; !done; ++i) {
      driver.SetGoal(i % 2 == 0 ? 0.6 : 3.2, 0.6);
      for (int k = 0; k < 37 && !done; ++k) client.Read();
    }
  });
  {
    PlayerClient client(host->connect(6665));
    Position2dProxy position(&client, 0);
    SndDriver driver(&client);
    for (int i = 0; i < 8; ++i) {
      driver.SetGoal(i % 2 == 0 ? 3.2 : 0.8, 1.0 + 0.1 * i);
      for (int k = 0; k < 23; ++k) {
        client.Read();
        trace << position.GetXPos() << ' ' << position.GetYPos() << ' ' << position.GetYaw() << ' '
              << driver.GetStatus() << '\n';
      }
      if (i == 3) driver.Cancel();
    }
    trace << std::hex << host->state_hash() << '\n';
    done = true;
  }
  other.join();
  return trace.str();
}

TEST_P(SndDriverTest, ThreadedPrograms_Repeatable) {
  const std::string first = two_threads_run(Transport::kInProcess);
  EXPECT_THAT(first, HasSubstr(" 1\n"));  // something was on its way
  for (int i = 0; i < 4; ++i) EXPECT_EQ(two_threads_run(GetParam()), first) << "run " << i + 2;
}

// --- The world's drivers table

TEST_P(SndDriverTest, PositionIndexOfWorld_GoToAvoidsObstacles) {
  start(room(R"([{"type": "snd", "max_speed": 0.25}])"));
  PlayerClient client(host->connect(6665));
  Position2dProxy plain(&client, 0);
  // Index 0 is the pose and 1 the odometry, so 2 is free.
  Position2dProxy snd(&client, 2);
  EXPECT_EQ(snd.GetDriverName(), "snd");
  snd.GoTo(3.2, 1.5, 0.0);
  double fastest = 0.0;
  for (int i = 0; i < 300; ++i) {
    client.Read();
    EXPECT_TRUE(snd.IsFresh());
    EXPECT_EQ(snd.GetXPos(), plain.GetXPos());
    fastest = std::max(fastest, snd.GetXSpeed());
  }
  EXPECT_LE(std::hypot(snd.GetXPos() - 3.2, snd.GetYPos() - 1.5), 0.05);
  EXPECT_NEAR(snd.GetYaw(), 0.0, 0.1);
  EXPECT_EQ(snd.GetXSpeed(), 0.0);
  EXPECT_LE(fastest, 0.25 + 1e-9);
  EXPECT_EQ(host->statistics(0).collisions, 0);
}

TEST_P(SndDriverTest, GoTo_AcceptsSpeeds) {
  start(room(R"([{"type": "snd"}])"));
  PlayerClient client(host->connect(6665));
  Position2dProxy snd(&client, 2);
  snd.GoTo({1.6, 2.5, 0.0}, {0.1, 0.0, 0.0});
  double fastest = 0.0;
  for (int i = 0; i < 60; ++i) {
    client.Read();
    fastest = std::max(fastest, snd.GetXSpeed());
  }
  EXPECT_NEAR(fastest, 0.1, 1e-9);
}

TEST_P(SndDriverTest, OtherCommands_DriveMotorsAndCancelGoal) {
  start(room(R"([{"type": "snd", "index": 7}])"));
  PlayerClient client(host->connect(6665));
  Position2dProxy snd(&client, 7);
  snd.GoTo(3.2, 1.5, 0.0);
  for (int i = 0; i < 10; ++i) client.Read();
  EXPECT_GT(snd.GetXSpeed(), 0.0);
  snd.SetSpeed(-0.05, 0.4);
  for (int i = 0; i < 5; ++i) {
    client.Read();
    EXPECT_DOUBLE_EQ(snd.GetXSpeed(), -0.05);
    EXPECT_DOUBLE_EQ(snd.GetYawSpeed(), 0.4);
  }
  snd.GoTo(3.2, 1.5, 0.0);
  for (int i = 0; i < 10; ++i) client.Read();
  snd.SetMotorEnable(false);
  snd.SetMotorEnable(true);
  for (int i = 0; i < 5; ++i) {
    client.Read();
    EXPECT_EQ(snd.GetXSpeed(), 0.0);
    EXPECT_EQ(snd.GetYawSpeed(), 0.0);
  }
}

TEST_P(SndDriverTest, Proxies_ShareDriver) {
  start(room(R"([{"type": "snd"}])"));
  PlayerClient client(host->connect(6665));
  PlayerClient second(host->connect(6665));
  auto a = std::make_unique<Position2dProxy>(&client, 2);
  Position2dProxy b(&second, 2);
  a->GoTo(3.2, 1.5, 0.0);
  a.reset();  // the driver continues with b
  for (int i = 0; i < 10; ++i) {
    client.Read();
    second.Read();
  }
  EXPECT_GT(b.GetXSpeed(), 0.0);
  b.SetSpeed(0.0, 0.0);  // it is the same driver: this drops the goal
  for (int i = 0; i < 5; ++i) second.Read();
  EXPECT_EQ(b.GetXSpeed(), 0.0);
}

TEST_P(SndDriverTest, ListsAndMessages_NameAddressOfDriver) {
  start(room(R"([{"type": "snd"}, {"type": "snd", "index": 5}])"));
  PlayerClient client(host->connect(6665));
  std::ostringstream out;
  out << client;
  EXPECT_THAT(out.str(),
              AllOf(HasSubstr("position2d\t2\tr1\tsnd"), HasSubstr("position2d\t5\tr1\tsnd")));
  try {
    Position2dProxy nothing(&client, 3);
    FAIL();
  } catch (const PlayerError& e) {
    EXPECT_EQ(e.GetErrorCode(), PlayerError::kNoSuchDevice);
    EXPECT_THAT(e.GetErrorStr(),
                AllOf(HasSubstr("position2d:2 (r1.snd)"), HasSubstr("position2d:5 (r1.snd)")));
  }
}

// The error for the world's author.
std::string fault(const std::string& drivers, const std::string& devices = "{}") {
  try {
    playerlike::check_drivers(sim::load_world_text(
        R"({"robots": [{}, {"devices": )" + devices + R"(, "drivers": )" + drivers + "}]}",
        "w.json"));
  } catch (const sim::ConfigError& e) {
    return e.what();
  }
  return "";
}

TEST(SndDriversTable, Settings_CheckedWhenWorldOpens) {
  EXPECT_EQ(fault(R"([{"type": "snd", "robot_radius": 0.2, "safety_distance": 0.3,
                       "max_speed": 0.2, "max_turn_rate_deg": 60, "goal_distance": 0.1,
                       "goal_angle_deg": 10, "patience": 5, "index": 4, "position": 1,
                       "laser": 0}])"),
            "");
  EXPECT_THAT(fault(R"([{"type": "snd"}, {"type": "snd", "robot_radius": -0.1}])"),
              AllOf(HasSubstr("w.json"), HasSubstr("/robots/1/drivers/1/robot_radius"),
                    HasSubstr("greater than 0 and at most 10 m"), HasSubstr("found -0.1"),
                    HasSubstr("world/out-of-range")));
  EXPECT_THAT(fault(R"([{"type": "snd", "goal_angle_deg": 181}])"),
              AllOf(HasSubstr("at most 180 degrees"), HasSubstr("found 181")));
  EXPECT_THAT(fault(R"([{"type": "snd", "max_speed": "fast"}])"),
              AllOf(HasSubstr("max_speed"), HasSubstr("\"fast\""), HasSubstr("world/wrong-type")));
  EXPECT_THAT(fault(R"([{"type": "snd", "index": 1.5}])"), HasSubstr("world/wrong-type"));
  EXPECT_THAT(fault(R"([{"type": "snd", "index": -1}])"), HasSubstr("world/out-of-range"));
  EXPECT_THAT(fault(R"([{"type": "snd", "max_sped": 0.2}])"),
              AllOf(HasSubstr("world/unknown-key"), HasSubstr("did you mean \"max_speed\"?")));
  EXPECT_THAT(fault(R"([{"type": "snt"}])"),
              AllOf(HasSubstr("/robots/1/drivers/0/type"), HasSubstr("\"snd\""),
                    HasSubstr("world/unknown-driver")));
}

TEST(DriversTable, PlayerOptions_ErrorSuggestsSetting) {
  EXPECT_THAT(fault(R"([{"type": "snd", "goal_position_tol": 0.1}])"),
              AllOf(HasSubstr("world/unknown-key"),
                    HasSubstr("Player's \"goal_position_tol\" is \"goal_distance\" here")));
  EXPECT_THAT(fault(R"([{"type": "vfh", "max_turnrate_0ms": 90}])"),
              HasSubstr("Player's \"max_turnrate_0ms\" is \"max_turnrate_0ms_deg\" here"));
  EXPECT_THAT(fault(R"([{"type": "vfh", "escape_time": 1}])"),
              HasSubstr("does not exist here: the driver stops after \"patience\""));
  EXPECT_THAT(fault(R"([{"type": "goto", "debug": 1}])"),
              HasSubstr("\"debug\" does not exist here)"));
  EXPECT_THAT(fault(R"([{"type": "lasercspace", "provides": "laser:1"}])"),
              HasSubstr("the indexes of devices are \"index\""));
  // The reader of worlds finds these two.
  EXPECT_THAT(
      fault(R"([{"type": "nd", "max_speed": [0.3, 45]}])"),
      AllOf(HasSubstr("world/wrong-type"),
            HasSubstr("the numbers of Player's \"max_speed\" are the settings max_speed and "
                      "max_turnrate_deg here")));
  EXPECT_THAT(
      fault(R"([{"type": "amcl", "odom_drift": 1}])"),
      AllOf(HasSubstr("world/unknown-key"), HasSubstr("\"odom_alpha1\" to \"odom_alpha4\"")));
  EXPECT_THAT(fault(R"([{"type": "mapfile"}])"),
              AllOf(HasSubstr("\"amcl\""), HasSubstr("not needed: map:0 is the map")));
}

TEST(SndDriversTable, UsedIndicesAndMissingDevices_Refused) {
  EXPECT_THAT(fault(R"([{"type": "snd", "index": 1}])"), HasSubstr("world/driver-index"));
  EXPECT_THAT(fault(R"([{"type": "snd", "index": 3}, {"type": "snd", "index": 3}])"),
              HasSubstr("world/driver-index"));
  EXPECT_THAT(fault(R"([{"type": "snd", "laser": 1}])"), HasSubstr("world/driver-device"));
  EXPECT_THAT(fault(R"([{"type": "snd", "position": 2}])"), HasSubstr("world/driver-device"));
  EXPECT_THAT(fault(R"([{"type": "snd"}])", R"({"laser": null})"),
              AllOf(HasSubstr("a robot with a laser"), HasSubstr("found none")));
  EXPECT_THAT(fault(R"([{"type": "snd"}])", R"({"motion": null})"), HasSubstr("motors"));
}

TEST(SndDriversTable, DefaultIndex_FirstFree) {
  const sim::WorldDescription world = sim::load_world_text(
      R"({"robots": [{"drivers": [{"type": "snd"}, {"type": "snd", "index": 2}, {"type": "snd"}]}]})");
  const sim::Simulation simulation(world);
  const auto drivers = playerlike::describe_robots(simulation)[0].goal_drivers;
  ASSERT_EQ(drivers.size(), 3U);
  EXPECT_EQ(drivers[0].index, 3);
  EXPECT_EQ(drivers[1].index, 2);
  EXPECT_EQ(drivers[2].index, 4);
}

TEST(SndDriversTable, InvalidDriver_RefusedByHost) {
  EXPECT_THROW(static_cast<void>(test::patient_host(
                   sim::load_world_text(R"({"robots": [{"drivers": [{"type": "teapot"}]}]})"))),
               sim::ConfigError);
}

}  // namespace
