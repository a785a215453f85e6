// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Under a debugger simulated time stands still, and gdb shows the run.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "nightly.h"
#include "playpen_process.h"
#include "run_files.h"
#include "run_process.h"
#include "temporary_folder.h"

namespace {

using test_support::expect_equal_files;
using test_support::Files;
using test_support::files_of_run;
using test_support::Process;
using test_support::ProcessOptions;
using test_support::ProcessResult;
using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

using Words = std::vector<std::string>;

/// Why gdb cannot be used here; "": it can.
const std::string& obstacle_to_gdb() {
  static const std::string obstacle = [] {
    const ProcessResult tried =
        test_support::run_process({"gdb", "-batch", "-ex", "run", "--args", "/bin/true"});
    if (tried.status == 127) return "gdb is missing";
    const std::string said = tried.out + tried.err;
    return said.find("exited normally") == std::string::npos ? "debuggers are not allowed here"
                                                             : "";
  }();
  return obstacle;
}

// A breakpoint is held for longer than the silence limit.
constexpr const char* kSilenceLimit_s = "0.3";
constexpr const char* kHold = "break stop_here\nrun\nshell sleep 1\ncontinue\n";

class Debugger : public testing::Test {
 protected:
  void SetUp() override {
    if (!obstacle_to_gdb().empty()) GTEST_SKIP() << obstacle_to_gdb();
    options_.environment["PLAYPEN_SILENCE_LIMIT"] = kSilenceLimit_s;
  }

  /// Starts a program, gives it an input, and waits for its end.
  [[nodiscard]] ProcessResult execute(const Words& command, const std::string& input = "") const {
    Process process(command, options_);
    process.write_input(input);
    process.close_input();
    return process.finish();
  }
  [[nodiscard]] ProcessResult run(const Words& options, const Words& program,
                                  const std::string& input = "") const {
    Words call = {PLAYPEN_COMMAND, "run", world_, "--quiet", "--out", out_};
    call.insert(call.end(), options.begin(), options.end());
    call.emplace_back("--");
    call.insert(call.end(), program.begin(), program.end());
    return execute(call, input);
  }
  /// A run in gdb with these commands equals a run without it.
  void expect_same_run(const Words& program, const std::string& commands) const {
    const ProcessResult plain = run({}, program);
    ASSERT_EQ(plain.status, 0) << plain.err;
    const Files expected = files_of_run(out_);
    const ProcessResult debugged = run({"--debug"}, program, commands);
    EXPECT_EQ(debugged.status, 0) << debugged.out << debugged.err;
    EXPECT_THAT(debugged.out, HasSubstr("Breakpoint 1, stop_here")) << debugged.err;
    EXPECT_THAT(debugged.err, Not(HasSubstr("warning")));
    EXPECT_EQ(read_run().at("repeatable"), true);
    expect_equal_files(files_of_run(out_), expected);
  }
  [[nodiscard]] nlohmann::json read_run() const {
    return test_support::read_report(out_).at("run");
  }
  /// Runs a program as the client of a server. @return the files of the server's run.
  [[nodiscard]] Files serve(const Words& listening, const Words& options, const Words& program,
                            const std::string& input = "") {
    Words call = {PLAYPEN_COMMAND, "serve", world_, "--time", "lockstep", "--quiet", "--out", out_};
    call.insert(call.end(), listening.begin(), listening.end());
    Process server(call, options_);
    std::string address = "unix:" + listening.back();
    if (listening.front() == "--unix") {
      EXPECT_TRUE(server.read_until("listening on unix:")) << server.finish().err;
    } else {
      address = test_support::address_of(server);
    }
    Words client = {PLAYPEN_COMMAND, "run", address, "--quiet"};
    client.insert(client.end(), options.begin(), options.end());
    client.emplace_back("--");
    client.insert(client.end(), program.begin(), program.end());
    const ProcessResult result = execute(client, input);
    EXPECT_EQ(result.status, 0) << result.out << result.err;
    EXPECT_THAT(result.err, Not(HasSubstr("warning")));
    server.send_signal(SIGTERM);
    const ProcessResult end = server.finish();
    EXPECT_EQ(end.status, 0) << end.err;
    EXPECT_THAT(end.err, Not(HasSubstr("warning")));
    output_ = result.out;
    return files_of_run(out_);
  }

  test_support::TemporaryFolder folder_;
  std::string out_ = folder_ / "out";
  std::string world_ = folder_.write("two.json", R"({
    "arena": {"size": [4, 4]},
    "robots": [{"name": "r1", "pose": {"x": 1, "y": 1}, "devices": {"laser": {"noise": 0.01}}},
               {"name": "r2", "pose": {"x": 1, "y": 3}, "devices": {"laser": {"noise": 0.01}}}]})");
  ProcessOptions options_;
  std::string output_;  ///< of the last client
};

// --- Time stands still

TEST_F(Debugger, OneThreadAtBreakpoint_SameRun) { expect_same_run({PROGRAM, "one"}, kHold); }

TEST_F(Debugger, StartedAgain_SameRun) {
  expect_same_run({PROGRAM, "one"}, "break stop_here\nrun\nrun\ncontinue\n");
}

TEST_F(Debugger, TwoThreadsAtBreakpoint_SameRun) { expect_same_run({PROGRAM, "two"}, kHold); }

TEST_F(Debugger, OneOfTwoThreadsAtBreakpoint_SameRun) {
  expect_same_run({PROGRAM, "two"},
                  "set non-stop on\nbreak stop_here\nrun\nshell sleep 1\ncontinue -a\n");
}

TEST_F(Debugger, DefaultLimitExceeded_SameRun) {
  if (!test_support::nightly()) GTEST_SKIP() << test_support::kOnlyNightly;
  options_.environment.clear();
  for (const char* program : {"one", "two"}) {
    expect_same_run({PROGRAM, program}, "break stop_here\nrun\nshell sleep 20\ncontinue\n");
  }
  expect_same_run({PROGRAM, "two"},
                  "set non-stop on\nbreak stop_here\nrun\nshell sleep 20\ncontinue -a\n");
}

TEST_F(Debugger, ClientOfServer_SameRun) {
  for (const Words& listening : {Words{"--tcp-port", "0"}, Words{"--unix", folder_ / "robots"}}) {
    SCOPED_TRACE(listening.front());
    const Files expected = serve(listening, {}, {PROGRAM, "two"});
    const Files debugged = serve(listening, {"--debug"}, {PROGRAM, "two"}, kHold);
    EXPECT_THAT(output_, HasSubstr("Breakpoint 1, stop_here"));
    EXPECT_EQ(read_run().at("repeatable"), true);
    expect_equal_files(debugged, expected);
  }
}

// The command that started the programs serves their world.
TEST_F(Debugger, OneOfSeveralPrograms_SameRun) {
  const Words options = {"--clients", "2", "--time", "lockstep"};
  const std::string one = std::string(PROGRAM) + " one ";
  const auto both = [&](const std::string& first) {
    return Words{"sh", "-c", first + one + "6665 & " + one + "6666 & wait"};
  };
  const ProcessResult plain = run(options, both(""));
  ASSERT_EQ(plain.status, 0) << plain.err;
  const Files expected = files_of_run(out_);
  const ProcessResult debugged =
      run(options, both("gdb -batch -ex 'break stop_here' -ex run -ex 'shell sleep 1' -ex continue "
                        "--args "));
  EXPECT_EQ(debugged.status, 0) << debugged.err;
  EXPECT_THAT(debugged.out, HasSubstr("Breakpoint 1, stop_here"));
  // The start gate may warn: gdb needs longer than this limit to load the program.
  EXPECT_THAT(debugged.err, Not(HasSubstr("has not called Read()")));
  expect_equal_files(files_of_run(out_), expected);
}

TEST_F(Debugger, LongComputation_NotReported) {
  EXPECT_THAT(run({}, {PROGRAM, "busy", "1"}).err, HasSubstr("has computed for 0.3 s"));
  const ProcessResult debugged = run({"--debug"}, {PROGRAM, "busy", "1"}, "run\n");
  EXPECT_THAT(debugged.out, HasSubstr("exited normally"));
  EXPECT_THAT(debugged.err, Not(HasSubstr("has computed")));
}

// While the server stands, its clients wait longer for an answer than otherwise.
TEST_F(Debugger, ServerStands_ClientsWait) {
  if (!test_support::nightly()) GTEST_SKIP() << test_support::kOnlyNightly;
  Process server(
      {PLAYPEN_COMMAND, "serve", world_, "--time", "lockstep", "--quiet", "--tcp-port", "0"});
  const std::string address = test_support::address_of(server);
  Process client({PLAYPEN_COMMAND, "run", address, "--quiet", "--debug", "--", PROGRAM, "one"});
  client.write_input("break stop_here\nrun\n");
  ASSERT_TRUE(client.read_until("Breakpoint 1, stop_here"));
  const std::string process = std::to_string(server.process());
  Process gdb(
      {"gdb", "-batch", "-p", process, "-ex", "shell echo stands; sleep 14", "-ex", "detach"});
  ASSERT_TRUE(gdb.read_until("stands"));
  client.write_input("continue\n");  // more than the 10 s after which a server counts as lost
  client.close_input();
  const ProcessResult end = client.finish();
  EXPECT_EQ(end.status, 0) << end.err;
  EXPECT_THAT(end.out, HasSubstr("60 rounds")) << end.err;
  static_cast<void>(gdb.finish());
  server.send_signal(SIGTERM);
  EXPECT_EQ(server.finish().status, 0);
}

// --- gdb's commands

TEST_F(Debugger, Commands_ShowRun) {
  const ProcessResult end = run({"--debug"}, {PROGRAM, "two"},
                                "playpen-time\nbreak stop_here\nrun\nplaypen-time\nplaypen-robots\n"
                                "playpen-time now\nplaypen-robots r1\ncontinue\nplaypen-time\n");
  EXPECT_EQ(end.status, 0) << end.err;
  EXPECT_THAT(end.err, AllOf(HasSubstr("no simulation runs in this program yet"),
                             HasSubstr("playpen-time takes no argument"),
                             HasSubstr("playpen-robots takes no argument")));
  // The laser measures ten times a second, so that a round takes ten steps.
  EXPECT_THAT(end.out, HasSubstr("simulated time 2.100 s, 210 steps; the run goes on"));
  EXPECT_THAT(end.out,
              ContainsRegex("robot +x \\[m\\] +y \\[m\\] +yaw \\[rad\\] +front \\[m/s\\] +left "
                            "\\[m/s\\] +turn \\[rad/s\\] +stalled\n"
                            "r1 +1\\.[0-9]+ +[0-9.]+ +-?[0-9.]+ +0\\.200 +0\\.000 +-?[0-9.]+  no\n"
                            "r2 +1\\.[0-9]+ +[0-9.]+ +-?[0-9.]+ +0\\.200 +0\\.000 +-?[0-9.]+  no"));
  EXPECT_THAT(end.out, HasSubstr("the run is over; its results are written"));
}

TEST_F(Debugger, Commands_HaveHelp) {
  const ProcessResult end = run({"--debug"}, {PROGRAM, "one"},
                                "help playpen-time\n"
                                "help playpen-robots\n");
  EXPECT_THAT(end.out, AllOf(HasSubstr("Show the simulated time of the last step"),
                             HasSubstr("Show where the robots are")));
  EXPECT_EQ(end.status, 1) << "the program was never started";
  EXPECT_THAT(end.err, HasSubstr("never connected to a simulation"));
}

TEST_F(Debugger, CommandsWithoutPlaypenRun_ShowRun) {
  options_.environment["PLAYPEN_WORLD"] = world_;
  options_.environment["PLAYPEN_OUT"] = out_;
  const ProcessResult end =
      execute({"gdb", "-batch", "-x", COMMANDS_FILE, "-ex", "break stop_here", "-ex", "run", "-ex",
               "playpen-time", "-ex", "playpen-robots", "--args", PROGRAM, "one"});
  EXPECT_THAT(end.out, AllOf(HasSubstr("simulated time 2.100 s, 210 steps; the run goes on"),
                             ContainsRegex("r1 +1\\.")))
      << end.err;
}

// --- playpen run --debug

TEST_F(Debugger, PreloadedLibrary_InProgramOnly) {
  const ProcessResult end = run({"--debug"}, {PROGRAM, "one"},
                                "shell echo gdb has $LD_PRELOAD.\nshow environment LD_PRELOAD\n");
  EXPECT_THAT(end.out, AllOf(HasSubstr("gdb has ."),
                             ContainsRegex("LD_PRELOAD = .*libplaypen_virtual_time\\.so")));
}

TEST_F(Debugger, QuitAtBreakpoint_ResultsUntilThen) {
  const ProcessResult end =
      run({"--debug"}, {PROGRAM, "one"}, "break stop_here\nrun\nkill\nquit\n");
  EXPECT_EQ(end.status, 1);
  EXPECT_THAT(end.err, HasSubstr("gdb has ended the program in the middle of the run; the results "
                                 "are those until then"));
  EXPECT_EQ(read_run().at("steps"), 210);
}

TEST_F(Debugger, UntilTime_StopsThere) {
  const ProcessResult plain = run({}, {PROGRAM, "one"});
  ASSERT_EQ(plain.status, 0) << plain.err;
  const Files expected = files_of_run(out_);
  const ProcessResult end = run({"--until", "3.105", "--then", "debug"}, {PROGRAM, "one"},
                                "info symbol $pc\nprint round\ncontinue\n");
  EXPECT_EQ(end.status, 0) << end.err;
  EXPECT_THAT(end.out, HasSubstr("simulated time 3.110 s, 311 steps; the run goes on"));
  EXPECT_THAT(end.out, ContainsRegex("drive \\(.*debugged_program.cpp"));
  EXPECT_THAT(end.out, HasSubstr("$1 = 31"));
  expect_equal_files(files_of_run(out_), expected);
}

TEST_F(Debugger, ProgramEndsBeforeTime_GdbSaysSo) {
  const ProcessResult end = run({"--until", "300", "--then", "debug"}, {PROGRAM, "one"}, "quit\n");
  EXPECT_EQ(end.status, 0) << end.err;
  EXPECT_THAT(end.out, HasSubstr("exited normally"));
  EXPECT_THAT(end.out, HasSubstr("the run is over; its results are written"));
}

TEST_F(Debugger, RealTime_SaidAtStart) {
  const ProcessResult end = run({"--debug", "--time", "10"}, {PROGRAM, "one"}, "quit\n");
  EXPECT_THAT(end.err, HasSubstr("time is real in this run, so it does not stand still"));
}

class DebugOption : public testing::Test {
 protected:
  test_support::TemporaryFolder folder_;
};

TEST_F(DebugOption, WithoutGdb_NamesPackage) {
  ProcessOptions options;
  options.environment["PATH"] = folder_.path();
  const std::string out = folder_ / "out";
  const ProcessResult end = test_support::playpen(
      {"run", "cave", "--debug", "--out", out, "--", PROGRAM, "one"}, options);
  EXPECT_EQ(end.status, 2);
  EXPECT_THAT(end.err, AllOf(HasSubstr("--debug needs the debugger gdb"),
                             HasSubstr("sudo apt install gdb")));
  EXPECT_FALSE(std::filesystem::exists(out)) << "results of earlier runs stay";
}

TEST_F(DebugOption, Isolated_Refused) {
  for (const char* world : {"cave", "tcp://localhost"}) {
    const ProcessResult end = test_support::playpen(
        {"run", world, "--debug", "--isolated", "required", "--", PROGRAM, "one"});
    EXPECT_EQ(end.status, 2);
    EXPECT_THAT(end.err, HasSubstr("--debug: a debugger cannot reach an isolated program: leave "
                                   "out --isolated"));
  }
}

TEST_F(DebugOption, NoProgram_Refused) {
  const ProcessResult none = test_support::playpen({"run", "cave", "--debug"});
  EXPECT_EQ(none.status, 2);
  EXPECT_THAT(none.err, HasSubstr("-- PROGRAM is required"));
  const ProcessResult missing =
      test_support::playpen({"run", "cave", "--debug", "--", folder_ / "robot"});
  EXPECT_EQ(missing.status, 2);
  EXPECT_THAT(missing.err, HasSubstr("there is no program"));
}

}  // namespace
