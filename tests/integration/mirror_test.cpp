// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// A program drives a robot that mirrors a real one. `playpen serve` plays the real robot.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "playpen_process.h"
#include "run_process.h"
#include "temporary_folder.h"

namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test_support::playpen;
using test_support::Process;
using test_support::ProcessResult;
using test_support::read_bytes;
using test_support::room_world;
using test_support::TemporaryFolder;
using testing::AllOf;
using testing::HasSubstr;
using testing::SizeIs;

class Mirror : public testing::Test {
 protected:
  /// Starts the real robot: in the room of the world, 0.2 m further along x, in front of a box that
  /// the mirrored world lacks.
  void start_real_robot() {
    json world = json::parse(room_world());
    world["robots"][0]["pose"]["x"] = 0.7;
    world["arena"]["obstacles"] =
        json::array({{{"name", "box"}, {"center", {1.6, 1.0}}, {"size", {0.2, 0.2}}}});
    const std::string file = folder_.write("real.json", world.dump());
    server_.emplace(std::vector<std::string>{PLAYPEN_COMMAND, "serve", file, "--out",
                                             folder_ / "real", "--tcp-port", "0", "--player-port",
                                             "0"});
    ASSERT_TRUE(server_->read_until(": r1\n")) << server_->finish().err;
    server_name_ = "tcp://" + address_after("listening on ");
    player_name_ = "player://" + address_after("Player's protocol on ");
  }
  /// The server's address in a line of its output.
  [[nodiscard]] std::string address_after(const std::string& text) const {
    const std::string& output = server_->output();
    const std::size_t begin = output.find(text) + text.size();
    const std::size_t colon = output.find(':', begin);
    return output.substr(begin, output.find_first_not_of("0123456789", colon + 1) - begin);
  }
  [[nodiscard]] std::string world_with(const json& real) {
    json world = json::parse(room_world());
    world["robots"][0]["real"] = real;
    return folder_.write("mirrored.json", world.dump());
  }
  [[nodiscard]] std::string out() const { return folder_ / "out"; }
  [[nodiscard]] json report() const { return json::parse(read_bytes(out() + "/report.json")); }

  TemporaryFolder folder_;
  std::optional<Process> server_;
  std::string server_name_;  ///< in Playpen's protocol
  std::string player_name_;  ///< in Player's
};

class MirrorByProtocol : public Mirror, public testing::WithParamInterface<bool> {};

TEST_P(MirrorByProtocol, AProgramDrivesTheRealRobotAndTheSimulationFollows) {
  start_real_robot();
  const std::string server = GetParam() ? player_name_ : server_name_;
  const std::string world = world_with({{"server", server}, {"drive", "both"}});
  const ProcessResult run = playpen({"run", world, "--out", out(), "--record", folder_ / "film/",
                                     "--record-fps", "5", "--quiet", "--", PROGRAM});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("drove from 0.70 with 682 beams"));
  const json mirror = report().at("mirror").at(0);
  EXPECT_EQ(mirror.at("server"), server);
  EXPECT_EQ(mirror.at("connected"), true);
  EXPECT_GT(mirror.at("poses"), 10);
  EXPECT_GT(mirror.at("scans"), 10);
  // The real robot sees a box that the mirrored world lacks.
  EXPECT_GT(mirror.at("scan_difference").at("share").at("max"), 0.02);
  EXPECT_LT(mirror.at("scan_difference").at("share").at("max"), 0.5);
  EXPECT_GE(mirror.at("ghost").at("distance").at("max"), 0.0);
  const json robot = report().at("robots").at(0);
  EXPECT_GE(robot.at("final_pose").at("x"), 1.0 - 1e-6) << "where the real robot is";
  EXPECT_GE(robot.at("path_length"), 0.3 - 1e-6);
  EXPECT_EQ(report().at("run").at("repeatable"), false);
  for (const char* file : {"layers/r1_scan_difference.png", "layers/r1_ghost_distance.png",
                           "canvas.png", "scene.png"}) {
    EXPECT_TRUE(fs::exists(fs::path(out()) / file)) << file;
  }
  EXPECT_FALSE(fs::is_empty(folder_ / "film"));
  EXPECT_EQ(playpen({"plot", out(), "--out", folder_ / "plot.png"}).status, 0);
  server_->send_signal(SIGTERM);
  EXPECT_EQ(server_->finish().status, 0);
  // The real robot has driven, and stands: the run stopped it.
  const json real = json::parse(read_bytes(folder_ / "real/report.json"));
  EXPECT_GE(real.at("robots").at(0).at("path_length"), 0.3 - 1e-6);
}

INSTANTIATE_TEST_SUITE_P(Protocols, MirrorByProtocol, testing::Bool(), [](const auto& protocol) {
  return protocol.param ? "Player" : "Playpen";
});

TEST_F(Mirror, AProgramIsToldWhenTheRealRobotIsLost) {
  start_real_robot();
  const std::string world = world_with({{"server", server_name_}, {"on_lost", "continue"}});
  Process run({PLAYPEN_COMMAND, "run", world, "--out", out(), "--quiet", "--", PROGRAM, "forever"});
  ASSERT_TRUE(run.read_until("drove from")) << run.finish().err;
  static_cast<void>(server_->kill_now());
  const ProcessResult end = run.finish();
  EXPECT_EQ(end.status, 1);
  EXPECT_THAT(end.err,
              AllOf(HasSubstr("told: "), HasSubstr("the connection to the real robot of r1"),
                    HasSubstr("the run continues without it")));
  EXPECT_EQ(report().at("mirror").at(0).at("connected"), false);
}

TEST_F(Mirror, TheRunEndsWhenTheRealRobotIsLostIfTheWorldSaysSo) {
  start_real_robot();
  const std::string world = world_with({{"server", server_name_}, {"on_lost", "end"}});
  Process run({PLAYPEN_COMMAND, "run", world, "--out", out(), "--quiet", "--", PROGRAM, "forever"});
  ASSERT_TRUE(run.read_until("drove from")) << run.finish().err;
  static_cast<void>(server_->kill_now());
  static_cast<void>(run.finish());
  EXPECT_EQ(report().at("ended").at("by"), "real robot");
}

TEST_F(Mirror, ARobotThatDoesNotAnswerIsAnErrorBeforeTheRun) {
  const std::string world = folder_.write("room.json", room_world());
  // Port 1 of this machine: nobody listens there.
  const ProcessResult run = playpen(
      {"run", world, "--out", out(), "--quiet", "--real", "r1=tcp://127.0.0.1:1", "--", PROGRAM});
  EXPECT_EQ(run.status, 1);
  EXPECT_THAT(run.err, AllOf(HasSubstr("/robots/0/real"), HasSubstr("tcp://127.0.0.1:1"),
                             HasSubstr("[run/real-robot]")));
}

TEST_F(Mirror, WrongChoicesAreErrors) {
  const std::string world = folder_.write("room.json", room_world());
  const auto error_of = [&](const std::vector<std::string>& options) {
    std::vector<std::string> call = {"run", world, "--out", out()};
    call.insert(call.end(), options.begin(), options.end());
    call.insert(call.end(), {"--", PROGRAM});
    const ProcessResult run = playpen(call);
    EXPECT_EQ(run.status, 2);
    return run.err;
  };
  EXPECT_THAT(error_of({"--real", "r2=tcp://a"}), HasSubstr("[run/real]"));
  EXPECT_THAT(error_of({"--real", "r1=a:6665"}), HasSubstr("ROBOT=SERVER"));
  EXPECT_THAT(error_of({"--real", "r1=tcp://a", "--time", "lockstep"}),
              HasSubstr("[run/real-time]"));
  EXPECT_EQ(playpen({"check", world_with({{"server", "tcp://a"}})}).status, 0)
      << "the check of a file connects to nobody";
}

}  // namespace
