// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Messages to programs that do not advance simulated time, or whose devices do not exist.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "playpen_process.h"
#include "run_process.h"
#include "temporary_folder.h"

namespace {

using test_support::playpen;
using test_support::ProcessOptions;
using test_support::ProcessResult;
using test_support::room_world;
using test_support::run_process;
using test_support::TemporaryFolder;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

constexpr const char* kStandsStill = "but simulated time stands still: it does not call Read()";
constexpr const char* kNothing = "nothing was simulated: the program has ended without calling";
constexpr const char* kBusy = "no simulated time has passed: it has not called Read()";

class StandingTime : public testing::Test {
 protected:
  /// Under `playpen run`, for a simulated second, with no unnecessary output.
  [[nodiscard]] ProcessResult run(const std::string& name,
                                  const ProcessOptions& options = {}) const {
    return playpen({"run", world_, "--out", folder_ / "out", "--quiet", "--duration", "1", "--",
                    FORGETFUL_PROGRAM, name},
                   options);
  }
  /// Without `playpen run`.
  [[nodiscard]] ProcessResult run_plainly(const std::string& name) const {
    return run_process({FORGETFUL_PROGRAM, name}, with("PLAYPEN_WORLD", world_));
  }
  static ProcessOptions with(const std::string& variable, const std::string& value) {
    ProcessOptions options;
    options.environment = {{variable, value}};
    return options;
  }
  /// Number of occurrences of a text.
  static int count(const std::string& text, const std::string& what) {
    int found = 0;
    for (auto at = text.find(what); at != text.npos; at = text.find(what, at + 1)) ++found;
    return found;
  }

  TemporaryFolder folder_;
  std::string world_ = folder_.write("room.json", room_world());
};

TEST_F(StandingTime, CommandsOnly_ReportedAtEnd) {
  for (const char* name : {"command_once", "c_command_once"}) {
    const ProcessResult result = run(name);
    EXPECT_EQ(result.status, 0);
    EXPECT_THAT(result.err,
                AllOf(StartsWith("playpen: warning: "), HasSubstr(kNothing),
                      HasSubstr("call client.Read() in each turn of its loop"),
                      HasSubstr("in C: playerc_client_read(client)"), HasSubstr(", or sleep\n")));
    EXPECT_THAT(run_plainly(name).err,
                AllOf(HasSubstr(kNothing), HasSubstr("sleeps count only under `playpen run`")));
  }
}

TEST_F(StandingTime, CommandLoop_ReportedOnce) {
  for (const char* name : {"command_for_ever", "look_for_ever", "read_once", "command_in_a_thread",
                           "c_command_for_ever"}) {
    const ProcessResult result = run(name);
    EXPECT_EQ(result.status, 0) << name;
    EXPECT_EQ(count(result.err, kStandsStill), 1) << name << ": " << result.err;
    EXPECT_THAT(result.err, Not(HasSubstr(kNothing))) << name;
  }
  EXPECT_THAT(run_plainly("command_in_a_thread").err, HasSubstr(kStandsStill));
}

TEST_F(StandingTime, CommandsAndSleeps_ReportedSoonerWithoutPlaypenRun) {
  const ProcessResult result = run_plainly("command_and_sleep");
  EXPECT_EQ(result.status, 0);
  EXPECT_THAT(result.err,
              AllOf(HasSubstr(kStandsStill), HasSubstr("sleeps count only under `playpen run`"),
                    Not(HasSubstr(kNothing))));
}

TEST_F(StandingTime, LoopWithoutCalls_ReportedByProcessorTime) {
  const ProcessResult result = run("compute_for_ever", with("PLAYPEN_SILENCE_LIMIT", "0.1"));
  EXPECT_EQ(result.status, 0);
  EXPECT_EQ(count(result.err, kBusy), 1) << result.err;
  EXPECT_THAT(result.err, AllOf(StartsWith("playpen: warning: the program has been busy for 0.1 s"),
                                Not(HasSubstr(kNothing))));
  // It gets only one of the two messages.
  const ProcessResult both = run("command_and_compute", with("PLAYPEN_SILENCE_LIMIT", "0.1"));
  EXPECT_EQ(count(both.err, "warning"), 1) << both.err;
  EXPECT_THAT(both.err, HasSubstr(kStandsStill));
  // With the usual limit, of 5 s, the message comes only at its end.
  EXPECT_THAT(run("compute_for_ever").err, AllOf(HasSubstr(kNothing), Not(HasSubstr(kBusy))));
}

TEST_F(StandingTime, ProgramThatExitsWithError_NotWarned) {
  const ProcessResult result = run_plainly("give_up");
  EXPECT_EQ(result.status, 3);
  EXPECT_THAT(result.err, IsEmpty());
}

TEST_F(StandingTime, ProgramsThatAdvanceTime_NotWarned) {
  for (const char* name : {"peek", "command_each_beam", "background", "sleep_only",
                           "read_in_a_thread", "look_at_the_map", "c_asks"}) {
    const ProcessResult result = run(name);
    EXPECT_EQ(result.status, 0) << name;
    EXPECT_THAT(result.err, IsEmpty()) << name;
  }
  for (const char* name : {"peek", "command_each_beam", "read_in_a_thread", "look_at_the_map"}) {
    const ProcessResult result = run_plainly(name);
    EXPECT_EQ(result.status, 0) << name;
    EXPECT_THAT(result.err, IsEmpty()) << name;
  }
}

TEST_F(StandingTime, CProgram_SuggestsSubscriptions) {
  const ProcessResult result = run("c_no_such_device");
  EXPECT_NE(result.status, 0);
  EXPECT_EQ(count(result.err,
                  "playpen: warning: playerc_laser_subscribe: there is no device "
                  "laser:7 on port 6665"),
            1)
      << result.err;
  EXPECT_THAT(result.err, AllOf(HasSubstr("laser:0"), HasSubstr("position2d:0"),
                                HasSubstr("ended with status 255")));
  EXPECT_THAT(
      run("c_no_such_port").err,
      AllOf(HasSubstr("playpen: warning: playerc_client_connect: "), HasSubstr("6665 (r1)")));
}

}  // namespace
