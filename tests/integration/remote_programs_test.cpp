// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Unchanged client programs with `playpen serve`: the results equal those of `playpen run`.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "nightly.h"
#include "playpen_process.h"
#include "run_files.h"
#include "run_process.h"
#include "temporary_folder.h"

namespace {

using nlohmann::json;
using test_support::address_of;
using test_support::cases;
using test_support::expect_equal_files;
using test_support::Files;
using test_support::files_of_run;
using test_support::playpen;
using test_support::Process;
using test_support::ProcessOptions;
using test_support::ProcessResult;
using test_support::TemporaryFolder;
using testing::AllOf;
using testing::HasSubstr;

using Words = std::vector<std::string>;

std::string task_world(const std::string& name) {
  return std::string(PLAYPEN_SOURCE_DIR "/worlds/tasks/") + name + ".json";
}

/// Every file of a run. The report is without wall times and without the reason of its end, because
/// a server outlives its clients.
Files files_of(const std::string& folder) {
  return files_of_run(folder, [](json& report) { EXPECT_EQ(report.erase("ended"), 1U); });
}

class RemotePrograms : public testing::Test {
 protected:
  /// `playpen run WORLD OPTIONS -- PROGRAM`. Its sleeps are real unless `virtual_time_` is set.
  [[nodiscard]] ProcessResult run(const std::string& world, Words options, const Words& program) {
    const std::string out = folder_ / "run";
    options.insert(options.begin(), {"run", world});
    if (!virtual_time_) options.emplace_back("--real-sleep");
    options.insert(options.end(), {"--quiet", "--out", out, "--"});
    options.insert(options.end(), program.begin(), program.end());
    const ProcessResult result = playpen(options);
    files_ = files_of(out);
    return result;
  }

  /// The environment of a program for a server.
  [[nodiscard]] ProcessOptions environment(const std::string& address,
                                           const std::string& encoding) const {
    ProcessOptions remote;
    remote.environment["PLAYPEN_WORLD"] = address;
    remote.environment["PLAYPEN_ENCODING"] = encoding;
    if (virtual_time_ && preloads_) {
      remote.environment.insert(
          {{"LD_PRELOAD", PRELOADED_LIBRARY}, {"PLAYPEN_VIRTUAL_TIME", "1"}, {"PLAYPEN_RUN", "1"}});
    }
    remote.folder = folder_.path();
    return remote;
  }

  /// Runs `playpen serve WORLD OPTIONS` and these programs; the server outlives them. In virtual
  /// time it listens on a Unix socket, otherwise on a TCP port.
  /// @return how each program ended, and its output.
  [[nodiscard]] std::vector<ProcessResult> serve(const std::string& world, Words options,
                                                 const std::vector<Words>& programs,
                                                 const std::string& encoding = "cbor") {
    const std::string out = folder_ / "serve";
    const std::string socket = folder_ / "robots";
    options.insert(options.begin(), {PLAYPEN_COMMAND, "serve", world, "--time", "lockstep",
                                     "--quiet", "--out", out});
    const Words listening = virtual_time_ ? Words{"--unix", socket} : Words{"--tcp-port", "0"};
    options.insert(options.end(), listening.begin(), listening.end());
    Process server(options);
    if (virtual_time_) {
      EXPECT_TRUE(server.read_until("listening on unix:" + socket + "\n")) << server.finish().err;
    }
    const ProcessOptions remote =
        environment(virtual_time_ ? "unix:" + socket : address_of(server), encoding);
    std::vector<std::unique_ptr<Process>> running;
    for (const Words& program : programs) {
      running.push_back(std::make_unique<Process>(program, remote));
    }
    std::vector<ProcessResult> results;
    for (const auto& program : running) results.push_back(program->finish());
    // If the run has a limit, the server ends by itself after it; programs in virtual time may end
    // before.
    const bool ends =
        !virtual_time_ && std::find(options.begin(), options.end(), "--duration") != options.end();
    if (!ends) server.send_signal(SIGTERM);
    const ProcessResult end = server.finish();
    EXPECT_EQ(end.status, 0) << end.err;
    files_ = files_of(out);
    return results;
  }

  /// The files of a run.
  [[nodiscard]] const Files& files() const { return files_; }

  void expect_the_same_across_a_network(const std::string& world, const Words& options,
                                        const Words& program,
                                        const std::string& encoding = "cbor") {
    SCOPED_TRACE(program.front() + ' ' + program.back());
    const ProcessResult here = run(world, options, program);
    ASSERT_EQ(here.status, 0) << here.err;
    const Files expected = files();
    EXPECT_EQ(expected.count("canvas.png"), 1U);
    const ProcessResult there = serve(world, options, {program}, encoding).front();
    EXPECT_EQ(there.status, 0) << there.err;
    EXPECT_EQ(there.out, here.out);
    expect_equal_files(files(), expected);
  }

  /// Two programs at one server, twice, with the same results.
  void expect_two_programs_repeatable() {
    // A wall between the robots, so that neither sees the other or draws over its drawing.
    const std::string world = folder_.write("two.json", R"({
    "arena": {"size": [3.42, 3.72],
              "obstacles": [{"center": [1.71, 1.86], "size": [0.2, 3.72], "type": "static"}]},
    "robots": [{"name": "r1", "pose": {"x": 0.5, "y": 0.5}, "devices": {"laser": {"noise": 0.01}}},
               {"name": "r2", "pose": {"x": 2.9, "y": 3.2},
                "devices": {"laser": {"noise": 0.01}}}]})");
    const Words options = {"--clients", "2", "--duration", "15"};
    const std::vector<Words> programs = {{WALL_PROGRAM, "--port=6665"},
                                         {AVOID_PROGRAM, "--port=6666"}};
    Files first;
    for (int i = 0; i < 2; ++i) {
      for (const ProcessResult& result : serve(world, options, programs)) {
        EXPECT_EQ(result.status, 0) << result.err;
      }
      const json report = json::parse(files().at("report.json"));
      for (const json& robot : report.at("robots")) {
        EXPECT_GT(robot.at("path_length").get<double>(), 0.5);
      }
      if (i == 0) {
        first = files();
      } else {
        expect_equal_files(files(), first);
      }
    }
  }

  TemporaryFolder folder_;
  Files files_;
  bool virtual_time_ = false;
  bool preloads_ = true;  ///< in virtual time: the program does not start under `playpen run`
};

TEST_F(RemotePrograms, Introduction_SameAsInProcess) {
  expect_the_same_across_a_network(task_world("par_intro"), {"--duration", "20"}, {AVOID_PROGRAM});
  expect_the_same_across_a_network(task_world("par_intro"), {"--duration", "20"}, {WALL_PROGRAM},
                                   "json");
}

TEST_F(RemotePrograms, Planning_SameAsInProcess) {
  for (const char* program : {DIJKSTRA_PROGRAM, THETA_PROGRAM}) {
    expect_the_same_across_a_network(task_world("par_planning"), {}, {program});
  }
}

TEST_F(RemotePrograms, Exploration_SameAsInProcess) {
  for (const char* program : {NEAREST_PROGRAM, GAIN_PROGRAM}) {
    expect_the_same_across_a_network(task_world("par_exploration"), {"--duration", "30"},
                                     {program});
  }
}

TEST_F(RemotePrograms, Traps_SameAsInProcess) {
  expect_the_same_across_a_network(task_world("par_traps"), {"--seed", "3"}, {TRAPS_PROGRAM});
}

TEST_F(RemotePrograms, ExistingPrograms_SameAsInProcess) {
  const std::string world = PLAYPEN_SOURCE_DIR "/worlds/syrotek.json";
  expect_the_same_across_a_network(world, {}, {PLAYER_PROGRAM});
  expect_the_same_across_a_network(world, {}, {CCMORSE_PROGRAM});
}

TEST_F(RemotePrograms, TwoProcesses_Repeatable) { expect_two_programs_repeatable(); }

// --- Virtual time

class RemoteVirtualTime : public RemotePrograms {
 protected:
  RemoteVirtualTime() { virtual_time_ = true; }

  /// Two robots with noisy lasers in a room.
  [[nodiscard]] std::string two_robots() const {
    const auto robot = [](const char* name, double x_m, double yaw_deg) {
      return json{{"name", name},
                  {"pose", {{"x", x_m}, {"y", 1.0}, {"yaw_deg", yaw_deg}}},
                  {"devices", {{"laser", {{"noise", 0.01}}}}}};
    };
    return folder_.write("two.json",
                         json{{"name", "two"},
                              {"arena", {{"size", {2.0, 2.0}}}},
                              {"robots", {robot("r1", 0.5, 0.0), robot("r2", 1.5, 180.0)}}}
                             .dump());
  }
};

TEST_F(RemoteVirtualTime, Course_SameAsInProcess) {
  expect_the_same_across_a_network(task_world("par_intro"), {"--duration", "20"}, {AVOID_PROGRAM});
  expect_the_same_across_a_network(task_world("par_intro"), {"--duration", "20"}, {WALL_PROGRAM},
                                   "json");
  expect_the_same_across_a_network(task_world("par_planning"), {}, {DIJKSTRA_PROGRAM});
  for (const char* program : {NEAREST_PROGRAM, GAIN_PROGRAM}) {
    expect_the_same_across_a_network(task_world("par_exploration"),
                                     {"--duration", cases("10", "60")}, {program});
  }
}

TEST_F(RemoteVirtualTime, ExistingPrograms_SameAsInProcess) {
  const std::string world = PLAYPEN_SOURCE_DIR "/worlds/syrotek.json";
  expect_the_same_across_a_network(world, {}, {PLAYER_PROGRAM});
  expect_the_same_across_a_network(world, {}, {CCMORSE_PROGRAM});
}

TEST_F(RemoteVirtualTime, TwoProcesses_Repeatable) { expect_two_programs_repeatable(); }

// Sleeps, clocks, timed waits, signals, several clients, drivers and background threads.
TEST_F(RemoteVirtualTime, ProgramsWithThreads_SameAsInProcess) {
  std::vector<Words> programs;
  std::istringstream lines(test_support::run_process({THREAD_PROGRAMS}).out);
  for (std::string line; std::getline(lines, line);) programs.push_back({THREAD_PROGRAMS, line});
  ASSERT_GE(programs.size(), 23U);
  for (const char* name : {"read_in_background", "read_in_own_thread", "have_threads_with_clients",
                           "join_threads", "wait_for_each_other", "steer_when_told"}) {
    programs.push_back({SLEEPING_PROGRAM, name});
  }
  const std::string world = two_robots();
  // A merge runs every third one.
  const std::size_t stride = cases<std::size_t>(3, 1);
  for (std::size_t i = stride - 1; i < programs.size(); i += stride) {
    expect_the_same_across_a_network(world, {"--duration", "4"}, programs[i]);
    EXPECT_THAT(files().at("report.json"), HasSubstr(R"("repeatable": true)"))
        << programs[i].back();
  }
}

TEST_F(RemotePrograms, NoServer_ErrorNamesAddress) {
  ProcessOptions remote;
  remote.environment["PLAYPEN_WORLD"] = "tcp://127.0.0.1:1";
  const ProcessResult result = test_support::run_process({PLAYER_PROGRAM}, remote);
  EXPECT_NE(result.status, 0);
  EXPECT_THAT(result.err, AllOf(HasSubstr("127.0.0.1:1"), HasSubstr("playpen serve")));
}

TEST_F(RemoteVirtualTime, PlaypenRunAtServer_SameAsInProcess) {
  const std::string world = task_world("par_intro");
  const Words program = {THREAD_PROGRAMS, "use_futures"};
  ASSERT_EQ(run(world, {"--duration", "5"}, program).status, 0);
  const Files expected = files();
  preloads_ = false;
  Words call = {PLAYPEN_COMMAND, "run", "unix:" + folder_ / "robots", "--"};
  call.insert(call.end(), program.begin(), program.end());
  const ProcessResult there = serve(world, {"--duration", "5"}, {call}).front();
  EXPECT_EQ(there.status, 0) << there.err;
  expect_equal_files(files(), expected);
}

TEST_F(RemotePrograms, PlaypenRunAtServer_RefusesSettingsOfServer) {
  const ProcessResult result =
      playpen({"run", "tcp://lab:4000", "--duration", "5", "--", PLAYER_PROGRAM});
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.err, AllOf(HasSubstr("--duration"), HasSubstr("playpen serve")));
  const ProcessResult failed = playpen({"run", "tcp://127.0.0.1:1", "--", PLAYER_PROGRAM});
  EXPECT_EQ(failed.status, 1);
  EXPECT_THAT(failed.err, HasSubstr("127.0.0.1:1"));
}

}  // namespace
