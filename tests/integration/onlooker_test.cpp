// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Clients of Player's protocol look on at a run: `playpen run --player-port`.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <libplayerc++/playerc++.h>

#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "player_wire_client.h"
#include "playpen_process.h"
#include "run_files.h"
#include "run_process.h"
#include "temporary_folder.h"

namespace {

using nlohmann::json;
using test_support::expect_equal_files;
using test_support::Files;
using test_support::files_of_run;
using test_support::PlayerMessage;
using test_support::PlayerWireClient;
using test_support::playpen;
using test_support::Process;
using test_support::ProcessResult;
using test_support::RawClient;
using test_support::read_report;
using test_support::room_world;
using test_support::TemporaryFolder;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

using Words = std::vector<std::string>;

class Onlookers : public testing::Test {
 protected:
  [[nodiscard]] Words arguments(const Words& options) const {
    Words call = {PLAYPEN_COMMAND, "run", world_, "--out", out_, "--quiet"};
    call.insert(call.end(), options.begin(), options.end());
    call.insert(call.end(), {"--", PROGRAM});
    return call;
  }
  /// The port that a run has printed for a robot.
  [[nodiscard]] static int port_of(Process& run, const std::string& robot = "r1") {
    const std::string end = ": " + robot + '\n';
    if (!run.read_error_until(end)) {
      ADD_FAILURE() << run.finish().err;
      return 0;
    }
    const std::string said = run.errors().substr(0, run.errors().find(end));
    EXPECT_THAT(said, HasSubstr("Player's protocol on 127.0.0.1:"));
    return std::stoi(said.substr(said.rfind(':') + 1));
  }
  /// The program drives one part of its way.
  static void drive(Process& run) {
    const std::string said = run.output();
    run.write_input("go\n");
    if (!run.read_until(said + "drove\n")) ADD_FAILURE() << run.finish().err;
  }
  /// The files of a run of two parts without onlookers.
  [[nodiscard]] Files files_alone(const Words& options) {
    Process run(arguments(options));
    drive(run);
    drive(run);
    run.close_input();
    const ProcessResult end = run.finish();
    EXPECT_EQ(end.status, 0) << end.err;
    return files_of_run(out_);
  }

  TemporaryFolder folder_;
  std::string world_ = folder_.write("room.json", room_world(0.02));
  std::string out_ = folder_ / "out";
};

// In virtual time, where the program's threads take turns, and with real sleeps.
TEST_F(Onlookers, ReadRunWithoutChangingIt) {
  for (const Words& options : {Words{}, Words{"--real-sleep"}}) {
    const Files alone = files_alone(options);

    Words with_port = options;
    with_port.insert(with_port.end(), {"--player-port", "0"});
    Process run(arguments(with_port));
    const int port = port_of(run);
    RawClient("127.0.0.1", port).reset();

    // One client has requested its round before the first step; one requests it afterwards; one
    // lets the server send; and one opens a device and then does nothing.
    PlayerWireClient puller(port);
    puller.set_mode(PLAYER_DATAMODE_PULL);
    EXPECT_EQ(puller.open(PLAYER_LASER_CODE).header.type, PLAYER_MSGTYPE_RESP_ACK);
    puller.begin_round();
    EXPECT_EQ(puller.receive().header.type, PLAYER_MSGTYPE_RESP_ACK);
    PlayerCc::PlayerClient viewer("player://127.0.0.1:" + std::to_string(port), 6665);
    PlayerCc::LaserProxy laser(&viewer, 0);
    PlayerWireClient pushed(port);
    EXPECT_EQ(pushed.open(PLAYER_LASER_CODE).header.type, PLAYER_MSGTYPE_RESP_ACK);
    PlayerWireClient idle(port);
    idle.set_mode(PLAYER_DATAMODE_PULL);
    EXPECT_EQ(idle.open(PLAYER_POSITION2D_CODE).header.type, PLAYER_MSGTYPE_RESP_ACK);

    drive(run);
    const std::vector<PlayerMessage> round = puller.end_round();
    ASSERT_FALSE(round.empty());
    EXPECT_TRUE(
        round.front().is(PLAYER_MSGTYPE_DATA, PLAYER_LASER_CODE, PLAYER_LASER_DATA_SCAN) ||
        round.front().is(PLAYER_MSGTYPE_DATA, PLAYER_LASER_CODE, PLAYER_LASER_DATA_SCANPOSE));
    EXPECT_GT(round.front().header.timestamp, 0.0);
    do {
      viewer.Read();
    } while (!laser.IsFresh());
    EXPECT_EQ(laser.GetCount(), 682U);
    EXPECT_GT(laser.GetRange(341), 0.1);

    drive(run);
    run.close_input();
    const ProcessResult end = run.finish();
    EXPECT_EQ(end.status, 0) << end.err;

    // The end of the run closes all connections; what was sent before arrives.
    EXPECT_NE(pushed.socket.rest(), "");
    static_cast<void>(idle.socket.rest());
    EXPECT_THROW(
        {
          for (;;) viewer.Read();
        },
        PlayerCc::PlayerError);

    EXPECT_EQ(read_report(out_).at("run").at("repeatable"), true);
    expect_equal_files(files_of_run(out_), alone);
  }
}

// The driver's thread looks on, too. Otherwise it would let time pass while the program waits for
// its input.
TEST_F(Onlookers, OpenDrivers_DoNotChangeRun) {
  world_ = PLAYPEN_SOURCE_DIR "/worlds/examples/snd_driver.json";
  const Files alone = files_alone({});
  Process run(arguments({"--player-port", "0"}));
  PlayerCc::PlayerClient viewer("player://127.0.0.1:" + std::to_string(port_of(run)), 6665);
  PlayerCc::Position2dProxy driver(&viewer, 2);
  drive(run);
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  do {
    viewer.Read();
  } while (!driver.IsFresh());
  drive(run);
  run.close_input();
  const ProcessResult end = run.finish();
  EXPECT_EQ(end.status, 0) << end.err;
  expect_equal_files(files_of_run(out_), alone);
}

TEST_F(Onlookers, Commands_ChangeRunAndAreReported) {
  const Files alone = files_alone({});
  const json pose = read_report(out_).at("robots").at(0).at("final_pose");
  Process run(arguments({"--player-port", "0"}));
  {
    PlayerCc::PlayerClient viewer("player://127.0.0.1:" + std::to_string(port_of(run)), 6665);
    PlayerCc::SimulationProxy simulation(&viewer, 0);
    drive(run);
    std::string name = "r1";
    simulation.SetPose2d(name.data(), 1.5, 0.5, 1.0);
  }
  drive(run);
  run.close_input();
  const ProcessResult end = run.finish();
  EXPECT_EQ(end.status, 0) << end.err;
  const json report = read_report(out_);
  EXPECT_NE(report.at("robots").at(0).at("final_pose"), pose);
  EXPECT_EQ(report.at("run").at("repeatable"), false);
  EXPECT_THAT(report.at("run").at("repeatable_why").dump(), HasSubstr("on a Player port"));
}

TEST_F(Onlookers, Ports_KeepDistancesOfWorld) {
  json world = json::parse(room_world());
  json second = world["robots"][0];
  second["name"] = "r2";
  second["pose"]["y"] = 1.5;
  world["robots"].push_back(second);
  world_ = folder_.write("two.json", world.dump());
  Process run(arguments({"--player-port", "0"}));
  const int first = port_of(run);
  EXPECT_NE(port_of(run, "r2"), first);
  PlayerWireClient client(first);
  EXPECT_EQ(client.open(PLAYER_LASER_CODE).header.type, PLAYER_MSGTYPE_RESP_ACK);
  run.close_input();
  EXPECT_EQ(run.finish().status, 0);
}

TEST_F(Onlookers, PortInUse_ErrorBeforeResultsAreRemoved) {
  static_cast<void>(files_alone({}));
  const std::string out = std::exchange(out_, folder_ / "other");
  Process other(arguments({"--player-port", "0"}));
  out_ = out;
  const std::string port = std::to_string(port_of(other));
  const ProcessResult refused = test_support::run_process(arguments({"--player-port", port}));
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.err, AllOf(HasSubstr("server/port-taken"), HasSubstr("player_port"),
                                 HasSubstr(port + ", taken")));
  EXPECT_TRUE(std::filesystem::exists(out_ + "/report.json"));
  other.close_input();
  EXPECT_EQ(other.finish().status, 0);
}

TEST_F(Onlookers, InvalidPorts_RefusedByNameAndValue) {
  for (const std::string port : {"70000", "-1", "x", ""}) {
    const ProcessResult refused = test_support::run_process(arguments({"--player-port", port}));
    EXPECT_EQ(refused.status, 2) << port;
    EXPECT_THAT(refused.err,
                AllOf(HasSubstr("--player-port"), HasSubstr("a whole number from 0 to 65535")));
  }
  // A world whose robots would lie beyond the last port.
  json world = json::parse(room_world());
  world["robots"][0]["port"] = 6700;
  world_ = folder_.write("far.json", world.dump());
  const ProcessResult refused = test_support::run_process(arguments({"--player-port", "65530"}));
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.err, HasSubstr("server/port-range"));
}

// The simulation in a program that was started without the command reads the variable itself.
TEST_F(Onlookers, EnvironmentVariable_AdmitsThem) {
  test_support::ProcessOptions options;
  options.environment = {{"PLAYPEN_WORLD", world_}, {"PLAYPEN_PLAYER_PORT", "0"}};
  Process run({PROGRAM}, options);
  PlayerWireClient client(port_of(run));
  EXPECT_EQ(client.open(PLAYER_LASER_CODE).header.type, PLAYER_MSGTYPE_RESP_ACK);
  run.close_input();
  EXPECT_EQ(run.finish().status, 0);

  options.environment = {{"PLAYPEN_WORLD", world_}, {"PLAYPEN_PLAYER_PORT", "many"}};
  const ProcessResult refused = test_support::run_process({PROGRAM}, options);
  EXPECT_THAT(refused.err, AllOf(HasSubstr("PLAYPEN_PLAYER_PORT"), HasSubstr("\"many\"")));
}

}  // namespace
