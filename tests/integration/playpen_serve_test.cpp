// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// `playpen serve` as a user runs it; the library's tests cover its answers to clients.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <libplayerc++/playerc++.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstddef>
#include <filesystem>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "playpen_process.h"
#include "raw_client.h"
#include "run_files.h"
#include "run_process.h"
#include "temporary_folder.h"

namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test_support::playpen;
using test_support::Process;
using test_support::ProcessOptions;
using test_support::ProcessResult;
using test_support::RawClient;
using test_support::read_report;
using test_support::room_world;
using test_support::TemporaryFolder;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

class PlaypenServe : public testing::Test {
 protected:
  [[nodiscard]] std::vector<std::string> arguments(const std::vector<std::string>& options) const {
    std::vector<std::string> call = {"serve", world_, "--out", out_};
    call.insert(call.end(), options.begin(), options.end());
    return call;
  }
  /// Starts a server on any free port (unless the options name one) and waits until it listens.
  void start(std::vector<std::string> options, const ProcessOptions& process = {}) {
    if (std::find(options.begin(), options.end(), "--tcp-port") == options.end()) {
      options.insert(options.end(), {"--tcp-port", "0"});
    }
    options = arguments(options);
    options.insert(options.begin(), PLAYPEN_COMMAND);
    server_.emplace(options, process);
    ASSERT_TRUE(server_->read_until("\n")) << server_->finish().err;
    const std::string& line = server_->output();
    ASSERT_THAT(line, testing::StartsWith("listening on "));
    port_ = std::stoi(line.substr(line.find(':') + 1));
  }
  [[nodiscard]] RawClient connect() const { return RawClient("127.0.0.1", port_); }
  [[nodiscard]] fs::path result(const std::string& name) const { return fs::path(out_) / name; }
  [[nodiscard]] json report() const { return read_report(out_); }

  TemporaryFolder folder_;
  std::string world_ = folder_.write("room.json", room_world());
  std::string out_ = folder_ / "out";
  std::optional<Process> server_;
  int port_ = 0;
};

TEST_F(PlaypenServe, Signal_WritesReportAndPictures) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    start({"--time", "lockstep"});
    RawClient client = connect();
    client.send("1 simulation list_robots\n2 r1.motion set_speed [0.1, 0]\n3 time sleep [1]\n");
    EXPECT_EQ(client.line(), "1 SUCCESS [\"r1\"]");
    EXPECT_EQ(client.line(), "2 SUCCESS");
    EXPECT_EQ(client.line(), "3 SUCCESS");
    server_->send_signal(signal);
    server_->send_signal(signal);  // a copy, as timeout sends one
    EXPECT_THAT(client.rest(), AllOf(HasSubstr("- FAILED"), HasSubstr("server/closing")));
    client.close();
    const ProcessResult end = server_->finish();
    EXPECT_EQ(end.status, 0) << end.err;
    EXPECT_THAT(end.out, AllOf(HasSubstr("1.0 s simulated"), HasSubstr("pictures:")));
    EXPECT_THAT(end.err, AllOf(HasSubstr("127.0.0.1:"), HasSubstr("3 requests")));
    EXPECT_EQ(report().at("run").at("steps"), 100);
    EXPECT_EQ(report().at("ended"),
              json({{"by", "request"}, {"signal", std::string("SIG") + sigabbrev_np(signal)}}));
    for (const char* file : {"scene.png", "canvas.png", "trajectory.csv"}) {
      EXPECT_TRUE(fs::exists(result(file))) << file;
    }
  }
}

TEST_F(PlaypenServe, TimeMode_PacedUnlessWorldSetsIt) {
  const auto mode = [&] {
    RawClient client = connect();
    client.send("1 time statistics\n");
    const json statistics = json::parse(client.line().substr(10));
    client.send("2 simulation quit\n");
    EXPECT_EQ(client.line(), "2 SUCCESS");
    client.close();
    EXPECT_EQ(server_->finish().status, 0);
    return statistics.at("mode").get<std::string>();
  };
  start({});
  EXPECT_EQ(mode(), "paced");
  json world = json::parse(room_world());
  world["simulation"]["time"] = "lockstep";
  world_ = folder_.write("lockstep.json", world.dump());
  start({});
  EXPECT_EQ(mode(), "lockstep");
  start({"--time", "4"});
  EXPECT_EQ(mode(), "paced");
}

TEST_F(PlaypenServe, EndOfRun_SentToClientsThenExits) {
  start({"--time", "lockstep", "--duration", "0.5", "--record", folder_ / "film/",
         "--snapshot-every", "0.25", "--quiet"});
  RawClient client = connect();
  client.send(
      "1 playpen hello [{\"version\": 1}]\n{\"id\": 2, \"do\": \"read\", \"wait\": \"sleep\", "
      "\"timeout\": 10}\n{\"id\": 3, \"do\": \"time\"}\n");
  EXPECT_THAT(client.line(), testing::StartsWith("1 SUCCESS"));
  // Two answers follow; that of the sleep reports the end.
  std::string answer = client.line();
  if (answer.find("\"id\":3") != std::string::npos) answer = client.line();
  EXPECT_THAT(answer, AllOf(HasSubstr("\"id\":2"), HasSubstr("\"finished\":true")));
  // The round that the end interrupted, and then the message that there is no other.
  client.send("{\"id\": 4, \"do\": \"read\", \"wait\": \"data\"}\n");
  client.send("{\"id\": 5, \"do\": \"read\", \"wait\": \"data\"}\n");
  do {
    answer = client.line();
  } while (answer.find("\"id\":5") == std::string::npos);
  EXPECT_THAT(answer, HasSubstr("session/finished"));
  client.close();
  const ProcessResult end = server_->finish();
  EXPECT_EQ(end.status, 0) << end.err;
  EXPECT_THAT(end.out, Not(HasSubstr("simulated")));
  EXPECT_EQ(report().at("run").at("steps"), 50);
  const auto files = [](const fs::path& folder) {
    return std::distance(fs::directory_iterator(folder), {});
  };
  EXPECT_EQ(files(folder_ / "film"), 13);  // 0.5 s at 25 frames per second, and the first frame
  EXPECT_EQ(files(result("snapshots")), 3);
}

// Cells on a side of a canvas whose last results are written before the server is late. With
// AddressSanitizer those of the largest one take too long.
#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#define PLAYPEN_TEST_CANVAS_SIDE 4096
#endif
#endif
#ifndef PLAYPEN_TEST_CANVAS_SIDE
#define PLAYPEN_TEST_CANVAS_SIDE 8192
#endif
constexpr int kCanvasSide = PLAYPEN_TEST_CANVAS_SIDE;

// A regression: the server hashed the canvas for each report, and took minutes for the drawings and
// maps below. The signal's handler waited for both.
TEST_F(PlaypenServe, SignalDuringMuchWork_EndsWithResults) {
  start({});
  RawClient painter = connect();
  const std::string side = std::to_string(kCanvasSide);
  painter.send(
      "1 playpen hello [{\"version\": 1}]\n"
      "{\"id\": 2, \"do\": \"resize_canvas\", \"width\": " +
      side + ", \"height\": " + side +
      "}\n"
      "{\"id\": 3, \"do\": \"draw\", \"drawings\": [[\"fill\", 0, 255]]}\n");
  EXPECT_THAT(painter.line(), testing::StartsWith("1 SUCCESS"));
  EXPECT_THAT(painter.line(), HasSubstr(side));
  EXPECT_THAT(painter.line(), HasSubstr("\"id\":3"));
  RawClient mapper = connect();
  std::string maps = "1 playpen hello [{\"version\": 1}]\n";
  for (int i = 0; i < 64; ++i) {
    maps +=
        "{\"id\": 2, \"do\": \"world_map\", \"cell_size\": 0.0005, "
        "\"tile\": [0, 0, 2048, 2048]}\n";
  }
  mapper.send(maps);
  EXPECT_THAT(mapper.line(), testing::StartsWith("1 SUCCESS"));
  // Work without end, none of which can be left out.
  const std::string last = std::to_string(kCanvasSide - 1);
  const std::string line = "[\"line\", 0, 0, 0, " + last + ", " + last + ", 1],";
  std::string lines = "{\"do\": \"draw\", \"drawings\": [";
  for (int i = 0; i < 20'000; ++i) lines += line;
  lines += "[\"pixel\", 0, 0, 0, 1]]}\n";
  std::thread writer([&] {
    while (painter.send_if_open(lines)) {
    }
  });
  // Simulated time goes on, and so does the report of each second.
  RawClient other = connect();
  fs::remove(result("report.json"));
  do {
    other.send("1 time now\n");
    EXPECT_THAT(other.line(), testing::StartsWith("1 SUCCESS"));
  } while (!fs::exists(result("report.json")));
  EXPECT_EQ(report().at("ended"), nullptr);
  EXPECT_EQ(report().at("run").at("state_hash"), nullptr);
  server_->send_signal(SIGTERM);
  const ProcessResult end = server_->finish();
  EXPECT_EQ(end.status, 0) << end.err;
  writer.join();
  EXPECT_EQ(report().at("ended"), json({{"by", "request"}, {"signal", "SIGTERM"}}));
  EXPECT_TRUE(report().at("run").at("state_hash").is_string());
}

TEST_F(PlaypenServe, EndOfRun_ExitsDespiteConnectedClient) {
  start({"--time", "lockstep", "--duration", "0.5"});
  RawClient client = connect();
  client.send("1 time sleep [10]\n");
  EXPECT_THAT(client.rest(), HasSubstr("server/closing"));
  EXPECT_EQ(server_->finish().status, 0);
}

TEST_F(PlaypenServe, PortInUse_ErrorBeforeResultsAreRemoved) {
  start({"--time", "lockstep"});
  ASSERT_TRUE(fs::exists(result("trajectory.csv")));
  const ProcessResult second = playpen(arguments({"--tcp-port", std::to_string(port_)}));
  EXPECT_EQ(second.status, 2);
  EXPECT_THAT(second.err, AllOf(HasSubstr("server/port-taken"), HasSubstr("port 0 takes any"),
                                HasSubstr(std::to_string(port_))));
  EXPECT_THAT(second.out, IsEmpty());
  EXPECT_TRUE(fs::exists(result("trajectory.csv")));
  EXPECT_FALSE(fs::exists(result("report.json")));
}

TEST_F(PlaypenServe, StartGate_HoldsTimeUntilClientsJoin) {
  start({"--time", "lockstep", "--clients", "2"});
  const std::string hello = "1 playpen hello [{\"version\": 1, \"process\": \"P\"}]\n";
  const std::string sleep = R"({"id": 2, "do": "read", "wait": "sleep", "timeout": 1})"
                            "\n";
  RawClient one = connect();
  one.send(hello + sleep);
  EXPECT_THAT(one.line(), testing::StartsWith("1 SUCCESS"));
  RawClient two = connect();
  two.send("1 playpen hello [{\"version\": 1, \"process\": \"Q\"}]\n" + sleep);
  EXPECT_THAT(two.line(), testing::StartsWith("1 SUCCESS"));
  EXPECT_EQ(json::parse(one.line()).at("t"), 1'000'000'000);
  EXPECT_EQ(json::parse(two.line()).at("t"), 1'000'000'000);
}

TEST_F(PlaypenServe, StartGateOfZero_StartsWithoutClients) {
  start({"--time", "1000", "--clients", "0", "--duration", "1"});
  const ProcessResult end = server_->finish();
  EXPECT_EQ(end.status, 0) << end.err;
  EXPECT_EQ(report().at("run").at("steps"), 100);
}

TEST_F(PlaypenServe, TokenFile_RobotObeysHolderOnly) {
  const std::string tokens = folder_.write("tokens.json", R"({"robots": {"r1": "only alice"}})");
  const ProcessResult blank = playpen(arguments({"--token-file", tokens}));
  EXPECT_EQ(blank.status, 2);
  EXPECT_THAT(blank.err, AllOf(HasSubstr("access/token"), Not(HasSubstr("alice"))));

  folder_.write("tokens.json", R"({"robots": {"r9": "only-alice"}})");
  const ProcessResult unknown = playpen(arguments({"--token-file", tokens}));
  EXPECT_EQ(unknown.status, 2);
  EXPECT_THAT(unknown.err, AllOf(HasSubstr("access/unknown-robot"), HasSubstr("r9")));

  folder_.write("tokens.json", R"({"robots": {"r1": "only-alice"}})");
  start({"--token-file", tokens});
  RawClient client = connect();
  client.send(
      "1 r1.motion set_speed [0.1, 0]\n2 playpen token [\"only-alice\"]\n"
      "3 r1.motion set_speed [0.1, 0]\n");
  EXPECT_THAT(client.line(), HasSubstr("1 FAILED"));
  EXPECT_EQ(client.line(), "2 SUCCESS");
  EXPECT_EQ(client.line(), "3 SUCCESS");
}

TEST_F(PlaypenServe, OtherMachines_NeedTokenOrOpenOption) {
  const ProcessResult refused = playpen(arguments({"--bind", "0.0.0.0", "--tcp-port", "0"}));
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.err, AllOf(HasSubstr("server/token-needed"), HasSubstr("--open")));
  start({"--bind", "0.0.0.0", "--open"});
  RawClient client = connect();
  client.send("1 time mode\n");
  EXPECT_THAT(client.line(), testing::StartsWith("1 SUCCESS"));
}

TEST_F(PlaypenServe, Limits_AreOptions) {
  start({"--max-message", "300", "--first-request-timeout", "0.3", "--sync-port", "0"});
  EXPECT_THAT(server_->output(), HasSubstr(", clock synchronisation on "));
  RawClient silent = connect();
  EXPECT_THAT(silent.rest(), HasSubstr("server/first-request"));
  std::string answer;
  do {  // on a loaded machine this client may be late, too
    RawClient client = connect();
    static_cast<void>(client.send_if_open(std::string(400, 'x')));
    answer = client.rest();
  } while (answer.find("server/first-request") != std::string::npos);
  EXPECT_THAT(answer, HasSubstr("protocol/too-long"));
}

TEST_F(PlaypenServe, PlayerClients_FindEachRobotOnItsPort) {
  start({"--player-port", "0"});
  const std::string start_of_line = "Player's protocol on 127.0.0.1:";
  ASSERT_TRUE(server_->read_until(start_of_line));
  ASSERT_TRUE(server_->read_until(": r1\n"));
  const std::string& text = server_->output();
  const int port = std::stoi(text.substr(text.find(start_of_line) + start_of_line.size()));
  RawClient client("127.0.0.1", port);
  EXPECT_THAT(client.bytes(32), testing::StartsWith("Player v.3."));
}

// A free port may be taken again before the server opens it.
TEST_F(PlaypenServe, Port_SetsFirstRobotInBothProtocols) {
  for (int attempt = 0; attempt < 20; ++attempt) {
    const std::string port = std::to_string(20'000 + (getpid() * 7 + attempt * 1009) % 30'000);
    server_.emplace(std::vector<std::string>{PLAYPEN_COMMAND, "serve", world_, "--out", out_,
                                             "--time", "lockstep", "--tcp-port", "0", "--port",
                                             port});
    if (!server_->read_until("Player's protocol on 127.0.0.1:" + port + ": r1\n")) continue;
    RawClient client("127.0.0.1", std::stoi(port));
    EXPECT_THAT(client.bytes(32), testing::StartsWith("Player v.3."));
    const std::string& line = server_->output();
    const std::string server =
        "tcp://127.0.0.1" + line.substr(line.find(':'), line.find('\n') - line.find(':'));
    PlayerCc::PlayerClient robot(server, static_cast<uint32_t>(std::stoi(port)));
    PlayerCc::Position2dProxy position(&robot, 0);
    EXPECT_THROW(PlayerCc::PlayerClient(server, 6665), PlayerCc::PlayerError);
    return;
  }
  FAIL() << "no free port";
}

TEST_F(PlaypenServe, RunVariablesOfShell_Ignored) {
  ProcessOptions process;
  process.environment = {{"PLAYPEN_SEED", "no number"}, {"PLAYPEN_DURATION", "1"}};
  start({"--time", "lockstep"}, process);
  RawClient client = connect();
  client.send("1 time sleep [2]\n");
  EXPECT_EQ(client.line(), "1 SUCCESS");
}

TEST_F(PlaypenServe, InvalidOptions_RefusedByNameAndValue) {
  struct Case {
    const char* option;
    const char* value;
  };
  for (const Case& c : std::vector<Case>{{"--tcp-port", "65536"},
                                         {"--tcp-port", "http"},
                                         {"--port", "4000"},
                                         {"--stream-port", "70000"},
                                         {"--sync-port", "x"},
                                         {"--player-port", "65536"},
                                         {"--clients", "-1"},
                                         {"--time", "slow"},
                                         {"--duration", "0"},
                                         {"--log-level", "loud"},
                                         {"--max-connections", "0"},
                                         {"--max-message", "10"},
                                         {"--max-requests", "many"},
                                         {"--max-queued", "5"},
                                         {"--first-request-timeout", "nan"},
                                         {"--request-timeout", "soon"},
                                         {"--idle-timeout", "1e9"}}) {
    const ProcessResult result = playpen(arguments({c.option, c.value}));
    EXPECT_EQ(result.status, 2) << c.option;
    EXPECT_THAT(result.err, AllOf(HasSubstr(c.option), HasSubstr(c.value))) << c.option;
  }
  for (const auto& options : std::vector<std::vector<std::string>>{{"--bind", "203.0.113.7"},
                                                                   {"--token-file", "none.json"}}) {
    const ProcessResult result = playpen(arguments(options));
    EXPECT_EQ(result.status, 2) << options.front();
    EXPECT_FALSE(fs::exists(out_)) << options.front();
  }
}

}  // namespace
