// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// A course program, compiled with -D_MORSE and without it, drives the simulation and a Player
// server.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <optional>
#include <string>
#include <vector>

#include "own_loopback.h"
#include "playpen_process.h"
#include "run_files.h"
#include "run_process.h"
#include "temporary_folder.h"

namespace {

using test_support::own_loopback;
using test_support::playpen;
using test_support::Process;
using test_support::ProcessOptions;
using test_support::ProcessResult;
using test_support::read_report;
using test_support::room_world;
using test_support::run_process;
using test_support::TemporaryFolder;
using testing::HasSubstr;

class TwoPlatforms : public testing::Test {
 protected:
  /// `playpen serve` with Player's protocol, until it listens there.
  void serve(const std::vector<std::string>& options) {
    std::vector<std::string> command = {PLAYPEN_COMMAND, "serve", world_,   "--out",   out_,
                                        "--tcp-port",    "0",     "--time", "lockstep"};
    command.insert(command.end(), options.begin(), options.end());
    server_.emplace(command);
    ASSERT_TRUE(server_->read_until(": r1\n")) << server_->finish().err;
  }
  /// Ends the server. @return how far the robot has driven [m].
  [[nodiscard]] double way() {
    server_->send_signal(SIGINT);
    EXPECT_EQ(server_->finish().status, 0);
    return read_report(out_).at("robots").at(0).at("path_length").get<double>();
  }

  TemporaryFolder folder_;
  std::string world_ = folder_.write("room.json", room_world());
  std::string out_ = folder_ / "out";
  std::optional<Process> server_;
};

TEST_F(TwoPlatforms, Simulation_DrivenBySameProgram) {
  const ProcessResult result =
      playpen({"run", world_, "--out", out_, "--quiet", "--", SIMULATION_PROGRAM});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("arrived"));
  EXPECT_GE(read_report(out_).at("robots").at(0).at("path_length").get<double>(), 1.0);
}

// The name of the robot is all that the program gets. It has no protocol, and the port is that of
// the program.
TEST_F(TwoPlatforms, RobotOnCoursePort_DrivenBySameProgram) {
  serve({"--bind", own_loopback(), "--player-port", "38000"});
  EXPECT_THAT(server_->output(),
              HasSubstr("Player's protocol on " + own_loopback() + ":38000: r1"));
  const ProcessResult result = run_process({ROBOT_PROGRAM, "--host", own_loopback()});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("arrived"));
  EXPECT_GE(way(), 1.0);
}

// "localhost" is a Player server if PLAYPEN_WORLD says so. There is no grid-map window then.
TEST_F(TwoPlatforms, RobotNamedByWorld_DrivenBySameProgram) {
  serve({"--player-port", "0"});
  const std::string& said = server_->output();
  const std::string address = said.substr(said.rfind("127.0.0.1:"));
  ProcessOptions options;
  options.environment = {{"PLAYPEN_WORLD", "player://" + address.substr(0, address.find(": r1"))}};
  const ProcessResult robot =
      run_process({ROBOT_PROGRAM, "--host", "localhost", "--port", "6665"}, options);
  EXPECT_EQ(robot.status, 0) << robot.err;
  EXPECT_THAT(robot.out, HasSubstr("arrived"));
  EXPECT_THAT(run_process({SIMULATION_PROGRAM, "--port", "6665"}, options).err,
              HasSubstr("a Player server has no canvas"));
  EXPECT_GE(way(), 1.0);
}

}  // namespace
