// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Several programs under one `playpen run`.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "playpen_process.h"
#include "run_files.h"
#include "run_process.h"
#include "temporary_folder.h"

namespace {

using nlohmann::json;
using test_support::playpen;
using test_support::ProcessResult;
using test_support::read_report;
using test_support::TemporaryFolder;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

using Words = std::vector<std::string>;

class SharedRun : public testing::Test {
 protected:
  [[nodiscard]] ProcessResult run(const Words& options, const Words& program) const {
    Words call = {"run", world_, "--out", out_};
    call.insert(call.end(), options.begin(), options.end());
    call.emplace_back("--");
    call.insert(call.end(), program.begin(), program.end());
    return playpen(call);
  }
  [[nodiscard]] json report() const { return read_report(out_); }
  /// Both robots are in the one report, and it says why another run may differ.
  void expect_shared(const ProcessResult& result) const {
    EXPECT_EQ(result.status, 0) << result.out << result.err;
    EXPECT_THAT(result.out, AllOf(HasSubstr("r1 has moved, as port 6666 sees it"),
                                  HasSubstr("r2 has moved, as port 6665 sees it")))
        << result.err;
    const json whole = report();
    // They drive at 0.2 m/s until each has seen the other one 0.05 m from its start.
    EXPECT_GT(whole.at("robots").at(0).at("path_length"), 0.049);
    EXPECT_GT(whole.at("robots").at(1).at("path_length"), 0.049);
    EXPECT_EQ(whole.at("run").at("repeatable"), false);
    EXPECT_FALSE(whole.at("run").at("repeatable_why").empty());
  }

  TemporaryFolder folder_;
  std::string world_ = folder_.write("two.json", R"({
    "arena": {"size": [20, 4], "border_height": 0.5},
    "robots": [{"name": "r1", "pose": {"x": 1, "y": 1, "yaw_deg": 0}},
               {"name": "r2", "pose": {"x": 1, "y": 3, "yaw_deg": 0}}]})");
  std::string out_ = folder_ / "out";
  std::string both_ = std::string(PROGRAM) + " 6665 r2 0.5 & " + PROGRAM + " 6666 r1 0.5; wait";
};

TEST_F(SharedRun, ProgramsOfShell_ShareWorld) {
  const ProcessResult result = run({}, {"sh", "-c", both_});
  expect_shared(result);
  EXPECT_THAT(result.err, HasSubstr("several programs share the world"));
}

TEST_F(SharedRun, StartGate_CountsClientsOfAllPrograms) {
  for (const char* time : {"lockstep", "10"}) {
    expect_shared(run({"--clients", "2", "--time", time}, {"sh", "-c", both_}));
  }
}

TEST_F(SharedRun, ForkedProgram_HasItsOwnClient) {
  expect_shared(run({"--time", "10", "--clients", "2"}, {PROGRAM, "6665", "r2", "0.5", "fork"}));
}

// A program of a shell has its own world, which two runs repeat.
TEST_F(SharedRun, SingleProgram_RunsInItsProcess) {
  const std::string line = std::string(PROGRAM) + " 6665 r1 0.5 | cat; true";
  for (int i = 0; i < 2; ++i) {
    const ProcessResult result = run({}, {"sh", "-c", line});
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_THAT(result.err, Not(HasSubstr("share")));
    EXPECT_EQ(report().at("run").at("repeatable"), true);
  }
}

TEST_F(SharedRun, SequentialPrograms_GetSeparateWorlds) {
  const std::string line = std::string(PROGRAM) + " 6665 r1 0.5; " + PROGRAM + " 6666 r2 0.7";
  const ProcessResult result = run({}, {"sh", "-c", line});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(report().at("robots").at(0).at("path_length"), 0.0);
  EXPECT_GT(report().at("robots").at(1).at("path_length"), 0.1);
}

// The first program holds the world, and waits for a line of input, when the second one comes.
TEST_F(SharedRun, LateProgram_Refused) {
  const std::string input = folder_ / "input";
  const std::string output = folder_ / "output";
  const std::string line =
      "mkfifo " + input + ' ' + output + "; exec 3<>" + input + " 4<>" + output + "; " + PROGRAM +
      " 6665 r1 0.5 hold <&3 >&4 & read drove <&4; " + PROGRAM + " 6666 r2 0.5; echo >&3; wait";
  const ProcessResult result = run({}, {"sh", "-c", line});
  EXPECT_EQ(result.status, 1) << result.out << result.err;
  EXPECT_THAT(result.err,
              AllOf(HasSubstr("came later"), HasSubstr("playpen serve"), HasSubstr("--clients N")));
  EXPECT_EQ(report().at("run").at("repeatable"), false);
}

}  // namespace
