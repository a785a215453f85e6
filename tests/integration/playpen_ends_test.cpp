// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// What is left of a run, however it ends, and that nothing of it goes on.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "playpen_process.h"
#include "run_process.h"
#include "temporary_folder.h"

namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test_support::Process;
using test_support::ProcessOptions;
using test_support::ProcessResult;
using test_support::read_bytes;
using test_support::room_world;
using test_support::TemporaryFolder;
using testing::HasSubstr;
using testing::Not;

class PlaypenEnds : public testing::Test {
 protected:
  /// `playpen run room.json OPTIONS --out out -- ends_program PROGRAM`.
  [[nodiscard]] std::vector<std::string> command(const std::vector<std::string>& options,
                                                 const std::vector<std::string>& program) const {
    std::vector<std::string> call = {PLAYPEN_COMMAND, "run", world_};
    call.insert(call.end(), options.begin(), options.end());
    call.insert(call.end(), {"--out", out_, "--", ENDS_PROGRAM});
    call.insert(call.end(), program.begin(), program.end());
    return call;
  }
  [[nodiscard]] fs::path result(const std::string& name) const { return fs::path(out_) / name; }
  [[nodiscard]] json report() const { return json::parse(read_bytes(result("report.json"))); }
  [[nodiscard]] bool has(const std::string& name) const {
    return fs::is_regular_file(result(name)) && fs::file_size(result(name)) > 0;
  }
  void expect_all_results() const {
    for (const char* name : {"report.json", "trajectory.csv", "scene.png", "canvas.png"}) {
      EXPECT_TRUE(has(name)) << name;
    }
  }

  TemporaryFolder folder_;
  std::string world_ = folder_.write("room.json", room_world());
  std::string out_ = folder_ / "out";
};

TEST_F(PlaypenEnds, OneSignalHoweverOftenItComesEndsTheRunCleanly) {
  for (const char* time : {"lockstep", "20"}) {
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
      SCOPED_TRACE(std::string(time) + ", signal " + std::to_string(signal));
      Process process(command({"--quiet", "--time", time}, {"drive"}));
      ASSERT_TRUE(process.read_until("ready"));
      // As timeout does: to the command, and to its group.
      process.send_signal(signal);
      process.send_signal_to_group(signal);
      const ProcessResult end = process.finish();
      ASSERT_FALSE(end.timed_out);
      EXPECT_EQ(end.status, 0) << end.err;
      expect_all_results();
      const json ended = report().at("ended");
      EXPECT_EQ(ended.at("by"), "request");
      EXPECT_EQ(ended.at("signal"), std::string("SIG") + sigabbrev_np(signal));
    }
  }
}

TEST_F(PlaypenEnds, AProgramsOwnHandlerGetsTheSignalOnce) {
  Process process(command({"--real-sleep"}, {"handler"}));
  ASSERT_TRUE(process.read_until("ready"));
  process.send_signal(SIGTERM);
  process.send_signal(SIGTERM);
  const ProcessResult end = process.finish();
  EXPECT_EQ(end.status, 0) << end.err;
  EXPECT_THAT(end.out, HasSubstr("signals 1"));
  EXPECT_EQ(report().at("ended").at("by"), "program");
}

TEST_F(PlaypenEnds, SignalsThatAreIgnoredFromTheStartStayIgnored) {
  ProcessOptions options;
  options.ignored_signals = {SIGHUP};  // as nohup has it
  Process process(command({"--time", "20"}, {"drive"}), options);
  ASSERT_TRUE(process.read_until("ready"));
  process.send_signal_to_group(SIGHUP);
  process.send_signal(SIGTERM);
  EXPECT_EQ(process.finish().status, 0);
  EXPECT_EQ(report().at("ended").at("signal"), "SIGTERM");
}

TEST_F(PlaypenEnds, NothingThatTheProgramHasStartedOutlivesTheRun) {
  Process process(command({}, {"child"}));
  // Ends when the last process has gone that holds the output.
  const ProcessResult end = process.finish();
  EXPECT_FALSE(end.timed_out);
  EXPECT_EQ(end.status, 0) << end.err;
  expect_all_results();
  EXPECT_EQ(report().at("ended"), json({{"by", "program"}, {"status", 0}}));
}

TEST_F(PlaypenEnds, KillingTheCommandEndsTheProgramAndWhatItHasStarted) {
  for (const char* what : {"drive", "compute"}) {
    for (const bool group : {false, true}) {
      SCOPED_TRACE(std::string(what) + (group ? ", the group" : ""));
      fs::remove_all(out_);
      Process process(command({"--time", "20"}, {what}));
      ASSERT_TRUE(process.read_until("ready"));
      group ? process.send_signal_to_group(SIGKILL) : process.send_signal(SIGKILL);
      const ProcessResult end = process.finish();
      EXPECT_FALSE(end.timed_out) << "something goes on";
      EXPECT_EQ(end.signal, SIGKILL);
      expect_all_results();
      EXPECT_FALSE(report().at("ended").is_null());
    }
  }
}

TEST_F(PlaypenEnds, AProgramThatNeverLooksIsEndedAllTheSame) {
  for (const char* whom : {"command", "group", "program"}) {
    SCOPED_TRACE(whom);
    fs::remove_all(out_);
    Process process(command({}, {"compute"}));
    ASSERT_TRUE(process.read_until("\n"));
    if (whom == std::string("command")) process.send_signal(SIGINT);
    if (whom == std::string("group")) process.send_signal_to_group(SIGINT);
    if (whom == std::string("program")) kill(std::stoi(process.output().substr(6)), SIGINT);
    const ProcessResult end = process.finish();
    EXPECT_FALSE(end.timed_out);
    EXPECT_EQ(end.status, 1);
    EXPECT_THAT(end.err, HasSubstr("had been asked to end"));
    expect_all_results();
    EXPECT_EQ(report().at("run").at("steps"), 510);
    EXPECT_EQ(report().at("ended"), json({{"by", "request"}, {"signal", "SIGINT"}}));
  }
}

TEST_F(PlaypenEnds, ACrashLeavesTheResultsOfItsLastStep) {
  // What a run leaves that ends in good order at the same moment.
  const std::string crashed = out_;
  out_ = folder_ / "whole";
  ASSERT_EQ(test_support::run_process(command({"--duration", "5.1"}, {"drive", "99"})).status, 0);
  const std::string whole = out_;
  const json whole_report = report();
  out_ = crashed;
  struct Case {
    const char* what;
    json ended;
    const char* told;
  };
  const std::vector<Case> cases = {
      {"segv", {{"by", "signal"}, {"signal", "SIGSEGV"}}, "gdb -ex run --args"},
      {"null", {{"by", "signal"}, {"signal", "SIGSEGV"}}, "playpen run --real-sleep"},
      {"abort", {{"by", "signal"}, {"signal", "SIGABRT"}}, "was ended by signal 6"},
      {"throw", {{"by", "signal"}, {"signal", "SIGABRT"}}, "thrown by the program"},
      {"kill", {{"by", "signal"}, {"signal", "SIGKILL"}}, "was ended by signal 9"},
      {"leave", {{"by", "program"}, {"status", 3}}, "ended with status 3"}};
  for (const Case& c : cases) {
    SCOPED_TRACE(c.what);
    fs::remove_all(out_);
    const ProcessResult end = test_support::run_process(command({}, {c.what}));
    EXPECT_EQ(end.status, 1);
    EXPECT_THAT(end.err, HasSubstr(c.told));
#ifdef __SANITIZE_ADDRESS__
    // The sanitizer catches the signal, and ends the program with a status of its own.
    if (c.what == std::string("segv") || c.what == std::string("null")) continue;
#endif
    EXPECT_EQ(report().at("ended"), c.ended);
    EXPECT_EQ(report().at("robots"), whole_report.at("robots"));
    EXPECT_EQ(report().at("run").at("steps"), 510);
    for (const char* name : {"trajectory.csv", "scene.png", "canvas.png", "layers/canvas.png",
                             "layers/graphics2d.png"}) {
      EXPECT_TRUE(read_bytes(result(name)) == read_bytes(fs::path(whole) / name)) << name;
    }
  }
}

TEST_F(PlaypenEnds, AProgramThatKillsWhoeverStartedItEndsToo) {
  Process process(command({}, {"killer"}));
  const ProcessResult end = process.finish();
  EXPECT_FALSE(end.timed_out) << "something goes on";
  EXPECT_EQ(end.status, 1);
  EXPECT_THAT(end.err, HasSubstr("was ended by signal 9"));
  expect_all_results();
}

TEST_F(PlaypenEnds, AFileThatReachesItsLimitKeepsTheReport) {
  ProcessOptions options;
  options.file_limit = 4096;  // enough for the report, and for no picture
  const ProcessResult end =
      test_support::run_process(command({"--duration", "1"}, {"drive"}), options);
  EXPECT_EQ(end.status, 1);
  EXPECT_THAT(end.err, HasSubstr("scene.png"));
  EXPECT_EQ(report().at("ended").at("by"), "duration");
  EXPECT_FALSE(fs::exists(result("scene.png")));
  EXPECT_FALSE(fs::exists(result("scene.part.png")));
}

}  // namespace
