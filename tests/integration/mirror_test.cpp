// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// A program drives a robot that mirrors a real one. `playpen serve` plays the real robot.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <string>
#include <tuple>
#include <vector>

#include "playpen_process.h"
#include "raw_client.h"
#include "relay.h"
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

TEST_P(MirrorByProtocol, Program_DrivesRealRobotAndSimulationFollows) {
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

// --- Ends of those who command a real robot

/// How somebody who drives a real robot ends.
struct End {
  const char* name;
  std::function<void(class RealRobotStops&)> happen;
  bool by_watchdog = false;  ///< nobody is left to stop the robot, or to close the connection
};

/// A real robot on a long floor, driven through a mirror. Another client has opened its position2d,
/// so that it does not stop because it has no client left.
class RealRobotStops : public Mirror, public testing::WithParamInterface<std::tuple<bool, End>> {
 public:
  using Clock = std::chrono::steady_clock;

  /// The process ids of the program and of its supervisor.
  [[nodiscard]] int program() const { return std::stoi(run_->output().substr(8)); }
  [[nodiscard]] int supervisor() const {
    const std::string stat = read_bytes("/proc/" + std::to_string(program()) + "/stat");
    return std::stoi(stat.substr(stat.rfind(')') + 4));
  }
  void kill_all_of(const std::vector<int>& processes) const {
    for (const int process : processes) kill(process, SIGKILL);
  }

  std::optional<Process> run_;
  std::optional<test::Relay> relay_;

 protected:
  void drive_by_mirror() {
    json world = json::parse(room_world());
    world["arena"]["size"] = {200.0, 2.0};
    world["robots"][0]["devices"]["pose"] = {{"frequency", 50.0}};
    server_.emplace(std::vector<std::string>{
        PLAYPEN_COMMAND, "serve", folder_.write("real.json", world.dump()), "--out",
        folder_ / "real", "--tcp-port", "0", "--player-port", "0", "--time", "real"});
    ASSERT_TRUE(server_->read_until(": r1\n")) << server_->finish().err;
    const auto& [by_player, end] = GetParam();
    const int port = port_after(by_player ? "Player's protocol on " : "listening on ");
    relay_.emplace(port);
    world["robots"][0]["real"] = {
        {"server",
         (by_player ? "player://127.0.0.1:" : "tcp://127.0.0.1:") + std::to_string(relay_->port())},
        // Otherwise a watchdog must not be faster than a busy machine.
        {"watchdog", end.by_watchdog ? watchdog_s() : 600.0}};
    run_.emplace(std::vector<std::string>{PLAYPEN_COMMAND, "run",
                                          folder_.write("mirrored.json", world.dump()), "--out",
                                          out(), "--quiet", "--", PROGRAM, "drive"});
    ASSERT_TRUE(run_->read_until("process ") && run_->read_until("\n")) << run_->finish().err;
    looker_.emplace("127.0.0.1", port_after("listening on "));
    watcher_.emplace("127.0.0.1", port_after("listening on "));
    watcher_->send("1 playpen hello [{\"version\": 3, \"port\": 6665}]\n");
    static_cast<void>(watcher_->line());
    while (position() < 0.55) {  // until it drives
    }
  }
  [[nodiscard]] int port_after(const std::string& text) const {
    const std::string address = address_after(text);
    return std::stoi(address.substr(address.rfind(':') + 1));
  }
  /// Where the real robot is; asks for it in MORSE's protocol, which holds no robot.
  [[nodiscard]] double position() {
    looker_->send("1 r1.pose get_local_data\n");
    const std::string line = looker_->line();
    const auto begin = line.find('{');
    if (begin == std::string::npos) return 0.0;
    const json data = json::parse(line.substr(begin));
    now_s_ = data.at("timestamp");
    return data.at("x");
  }
  /// Waits until the robot has stood for half a second of its own time.
  /// @return when it began to stand, by the wall clock.
  [[nodiscard]] Clock::time_point wait_for_standstill() {
    constexpr double kFar_m = 4.0;  // more than the longest watchdog takes
    const double begin = position();
    double last = begin;
    double since_s = now_s_;
    Clock::time_point still = Clock::now();
    while (now_s_ < since_s + 0.5) {
      const double x = position();
      if (x == last) continue;
      if (x > begin + kFar_m) {
        ADD_FAILURE() << "the real robot drives on";
        break;
      }
      last = x;
      since_s = now_s_;
      still = Clock::now();
    }
    return still;
  }
  [[nodiscard]] static double watchdog_s() {
    const char* const given = std::getenv("PLAYPEN_TEST_WATCHDOG");
    return given != nullptr ? std::stod(given) : 3.0;
  }

  std::optional<test_support::RawClient> looker_;
  std::optional<test_support::RawClient> watcher_;
  double now_s_ = 0.0;  ///< time of the real robot, with its last position
};

TEST_P(RealRobotStops, CommanderLeaves_Stops) {
  drive_by_mirror();
  if (HasFatalFailure()) return;
  const End& end = std::get<1>(GetParam());
  const Clock::time_point begin = Clock::now();
  end.happen(*this);
  const std::chrono::duration<double> time = wait_for_standstill() - begin;
  // The times are for docs/mirror.md: no verdict.
  std::printf("standstill after %.2f s: %s\n", time.count(), end.name);
}

const End kEnds[] = {
    {"program_killed", [](RealRobotStops& t) { kill(t.program(), SIGKILL); }},
    {"program_aborts", [](RealRobotStops& t) { t.run_->write_input("a"); }},
    {"program_leaves_its_robot", [](RealRobotStops& t) { t.run_->write_input("q"); }},
    {"program_interrupted", [](RealRobotStops& t) { kill(t.program(), SIGINT); }},
    {"group_interrupted", [](RealRobotStops& t) { t.run_->send_signal_to_group(SIGINT); }},
    {"command_killed", [](RealRobotStops& t) { t.run_->send_signal(SIGKILL); }},
    {"supervisor_killed", [](RealRobotStops& t) { t.kill_all_of({t.supervisor()}); }},
    {"group_killed", [](RealRobotStops& t) { t.run_->send_signal_to_group(SIGKILL); }},
    {"all_killed",
     [](RealRobotStops& t) {
       const int supervisor = t.supervisor();
       t.kill_all_of({supervisor, t.program()});
       t.run_->send_signal(SIGKILL);
     }},
    {"program_hangs", [](RealRobotStops& t) { kill(t.program(), SIGSTOP); }, true},
    {"link_cut", [](RealRobotStops& t) { t.relay_->freeze(); }, true},
};

INSTANTIATE_TEST_SUITE_P(Ends, RealRobotStops,
                         testing::Combine(testing::Bool(), testing::ValuesIn(kEnds)),
                         [](const auto& one) {
                           return std::string(std::get<0>(one.param) ? "Player_" : "Playpen_") +
                                  std::get<1>(one.param).name;
                         });

class TwoMirrors : public Mirror, public testing::WithParamInterface<bool> {};

TEST_P(TwoMirrors, SecondMirror_RefusedUnlessItTakesOver) {
  start_real_robot();
  const std::string server = GetParam() ? player_name_ : server_name_;
  const std::string world = world_with({{"server", server}, {"watchdog", 5.0}});
  Process first(
      {PLAYPEN_COMMAND, "run", world, "--out", out(), "--quiet", "--", PROGRAM, "forever"});
  ASSERT_TRUE(first.read_until("drove from")) << first.finish().err;
  std::vector<std::string> second = {"run",     world, "--out", folder_ / "second",
                                     "--quiet", "--",  PROGRAM};
  const ProcessResult refused = playpen(second);
  EXPECT_EQ(refused.status, 1);
  EXPECT_THAT(refused.err, AllOf(HasSubstr("/robots/0/real"), HasSubstr("in charge of"),
                                 HasSubstr("take over")));
  second.insert(second.begin() + 4, "--take-over");
  const ProcessResult taken = playpen(second);
  EXPECT_EQ(taken.status, 0) << taken.err;
  const ProcessResult end = first.finish();
  EXPECT_THAT(end.err, AllOf(HasSubstr("told: "), HasSubstr("take")));
}

INSTANTIATE_TEST_SUITE_P(Protocols, TwoMirrors, testing::Bool(), [](const auto& protocol) {
  return protocol.param ? "Player" : "Playpen";
});

TEST_F(Mirror, LostLink_ReconnectsIfWorldAllows) {
  start_real_robot();
  test::Relay relay(std::stoi(server_name_.substr(server_name_.rfind(':') + 1)));
  const std::string world =
      world_with({{"server", "tcp://127.0.0.1:" + std::to_string(relay.port())},
                  {"watchdog", 1.0},
                  {"on_lost", "reconnect"}});
  Process run({PLAYPEN_COMMAND, "run", world, "--out", out(), "--quiet", "--", PROGRAM, "forever"});
  ASSERT_TRUE(run.read_until("drove from")) << run.finish().err;
  relay.freeze();
  ASSERT_TRUE(run.read_error_until("the mirror reconnects as soon as possible"));
  relay.freeze(false);
  ASSERT_TRUE(run.read_error_until("is there again")) << run.errors();
  run.send_signal(SIGTERM);
  static_cast<void>(run.finish());
  EXPECT_EQ(report().at("mirror").at(0).at("connected"), true);
  EXPECT_GE(report().at("mirror").at(0).at("reconnections"), 1);
}

TEST_F(Mirror, LostRobot_ReportedToProgram) {
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

TEST_F(Mirror, LostRobot_EndsRunIfWorldSaysSo) {
  start_real_robot();
  const std::string world = world_with({{"server", server_name_}, {"on_lost", "end"}});
  Process run({PLAYPEN_COMMAND, "run", world, "--out", out(), "--quiet", "--", PROGRAM, "forever"});
  ASSERT_TRUE(run.read_until("drove from")) << run.finish().err;
  static_cast<void>(server_->kill_now());
  static_cast<void>(run.finish());
  EXPECT_EQ(report().at("ended").at("by"), "real robot");
}

TEST_F(Mirror, UnreachableRobot_ErrorBeforeRun) {
  const std::string world = folder_.write("room.json", room_world());
  // Port 1 of this machine: nobody listens there.
  const ProcessResult run = playpen(
      {"run", world, "--out", out(), "--quiet", "--real", "r1=tcp://127.0.0.1:1", "--", PROGRAM});
  EXPECT_EQ(run.status, 1);
  EXPECT_THAT(run.err, AllOf(HasSubstr("/robots/0/real"), HasSubstr("tcp://127.0.0.1:1"),
                             HasSubstr("[run/real-robot]")));
}

TEST_F(Mirror, InvalidOptions_Errors) {
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
