// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// What users read about programs that crash, or go on without an end.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "playpen_process.h"
#include "run_files.h"
#include "run_process.h"
#include "temporary_folder.h"

namespace {

using nlohmann::json;
using test_support::Process;
using test_support::ProcessOptions;
using test_support::ProcessResult;
using test_support::read_bytes;
using test_support::read_report;
using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

class PlaypenAdvice : public testing::Test {
 protected:
  [[nodiscard]] std::vector<std::string> command(const std::vector<std::string>& options,
                                                 const std::vector<std::string>& program) const {
    return test_support::run_call(world_, options, out_, ENDS_PROGRAM, program);
  }
  /// The rest of the line that begins with a text.
  static std::string after(const std::string& text, const std::string& begin) {
    const std::size_t at = text.find(begin);
    if (at == std::string::npos) return "";
    const std::size_t from = at + begin.size();
    return text.substr(from, text.find('\n', from) - from);
  }

  test_support::TemporaryFolder folder_;
  std::string world_ = folder_.write("my room.json", test_support::room_world(0.01));
  std::string out_ = folder_ / "out";
};

constexpr const char* kDebuggerHint = "to see where it happened: ";

TEST_F(PlaypenAdvice, Crash_SuggestsSameRunWithAllOptions) {
  const std::vector<std::string> options = {
      "--seed", "7",      "--duration",  "60",     "--clients", "1",           "--realism",
      "real",   "--hide", "fans,labels", "--time", "lockstep",  "--interface", "laser:0=laser"};
  const ProcessResult end =
      test_support::run_process(command(options, {"null", "20", "it's an argument"}));
  EXPECT_EQ(end.status, 1);
  EXPECT_EQ(after(end.err, kDebuggerHint),
            PLAYPEN_COMMAND " run '" + world_ +
                "' --seed 7 --duration 60 --clients 1 --realism real --hide fans,labels --time "
                "lockstep --interface laser:0=laser --out " +
                out_ + " -- gdb -ex run --args " ENDS_PROGRAM " null 20 'it'\\''s an argument'");
}

TEST_F(PlaypenAdvice, Debugger_SameStepCrashesAndGettersWork) {
  if (test_support::run_process({"gdb", "--version"}).status != 0) GTEST_SKIP() << "gdb is missing";
  const ProcessResult end =
      test_support::run_process(command({"--seed", "7", "--quiet"}, {"null", "20"}));
  const json report = read_report(out_);
  const std::string trajectory = read_bytes(out_ + "/trajectory.csv");
  std::filesystem::remove_all(out_);
  std::string hint = after(end.err, kDebuggerHint);
  const std::string gdb = "gdb -ex run";
  ASSERT_THAT(hint, HasSubstr(gdb));
  hint.replace(hint.find(gdb), gdb.size(),
               "gdb -batch -ex run -ex backtrace -ex 'frame function main' -ex 'print "
               "laser.GetRange(341)' -ex 'print laser[341]' -ex 'print laser.GetCount()' -ex "
               "'print position.GetXPos()'");
  const ProcessResult debugged = test_support::run_process({"sh", "-c", hint});
  const std::string both = debugged.out + debugged.err;
  if (both.find("ptrace") != std::string::npos) GTEST_SKIP() << "debuggers are not allowed here";
  EXPECT_THAT(both, HasSubstr("SIGSEGV"));
  EXPECT_THAT(both, HasSubstr("end_badly"));
  EXPECT_THAT(both, Not(HasSubstr("incomplete type")));
  EXPECT_THAT(both, ContainsRegex("\\$1 = [0-9.]+\n\\$2 = [0-9.]+\n\\$3 = 682\n\\$4 = [0-9.]+\n"));
  EXPECT_EQ(read_report(out_).at("run").at("steps"), report.at("run").at("steps"));
  EXPECT_EQ(read_report(out_).at("robots"), report.at("robots"));
  EXPECT_EQ(read_bytes(out_ + "/trajectory.csv"), trajectory);
}

TEST_F(PlaypenAdvice, EndlessLoopAfterFirstRead_Reported) {
  ProcessOptions options;
  options.environment = {{"PLAYPEN_SILENCE_LIMIT", "0.2"}};
  Process process(command({"--quiet"}, {"compute", "20"}), options);
  EXPECT_TRUE(process.read_error_until("`gdb -p "));
  process.send_signal(SIGINT);
  const ProcessResult end = process.finish();
  EXPECT_THAT(end.err, AllOf(HasSubstr("has computed for 0.2 s of processor time without calling "
                                       "Read(), and simulated time stands still at 2.10 s"),
                             HasSubstr("had been asked to end, and did not")));
}

TEST_F(PlaypenAdvice, ProgramWithoutCommand_EndlessLoopReported) {
  ProcessOptions options;
  options.environment = {{"PLAYPEN_SILENCE_LIMIT", "0.2"}, {"PLAYPEN_WORLD", world_}};
  Process process({ENDS_PROGRAM, "compute", "20"}, options);
  EXPECT_TRUE(process.read_error_until(
      "without calling Read(), and simulated time stands still at 2.10 s. If this is an endless"));
}

TEST_F(PlaypenAdvice, ProgramWithoutCommand_MissingEndReported) {
  ProcessOptions options;
  options.environment = {{"PLAYPEN_SILENCE_LIMIT", "0.1"}, {"PLAYPEN_WORLD", world_}};
  Process process({ENDS_PROGRAM, "drive", "-1"}, options);
  EXPECT_TRUE(process.read_error_until("this goes on until the program ends or Ctrl-C ends it"));
  options.environment["PLAYPEN_DURATION"] = "200";
  const ProcessResult limited = test_support::run_process({ENDS_PROGRAM, "drive", "-1"}, options);
  EXPECT_THAT(limited.err, Not(HasSubstr("this goes on")));
}

TEST_F(PlaypenAdvice, UnwritableFolder_ErrorNamesOption) {
  const std::string file = folder_.write("file", "");
  for (const std::string& out : {std::string("/proc/out"), file}) {
    out_ = out;
    const ProcessResult end = test_support::run_process(command({}, {"drive"}));
    EXPECT_EQ(end.status, 2);
    EXPECT_THAT(end.err, AllOf(HasSubstr("the output folder '" + out + "' can't be made"),
                               HasSubstr("--out DIR chooses another one")));
  }
}

TEST_F(PlaypenAdvice, Messages_AreValidUtf8ForAnyName) {
  const std::string program = folder_ / "caf\xe9";
  const ProcessResult none =
      test_support::run_process({PLAYPEN_COMMAND, "run", world_, "--", program});
  EXPECT_EQ(none.status, 2);
  EXPECT_THAT(none.err, AllOf(HasSubstr("caf\\xe9"), Not(HasSubstr("\xe9"))));
  std::filesystem::create_symlink(ENDS_PROGRAM, program);
  std::filesystem::create_symlink(world_, folder_ /
                                              "r\xfc"
                                              "m.json");
  const ProcessResult crash = test_support::run_process({PLAYPEN_COMMAND, "run",
                                                         folder_ / "r\xfc"
                                                                   "m.json",
                                                         "--out", out_, "--", program, "null"});
  EXPECT_EQ(crash.status, 1);
  EXPECT_THAT(crash.err, AllOf(HasSubstr("caf\\xe9 was ended by signal 11"), Not(HasSubstr("\xe9")),
                               Not(HasSubstr("\xfc"))));
  const ProcessResult bad =
      test_support::run_process({PLAYPEN_COMMAND, "run", world_, "--out", out_,
                                 "--se\xe9"
                                 "d",
                                 "--", program});
  EXPECT_EQ(bad.status, 2);
  EXPECT_THAT(bad.err, HasSubstr("--se\\xe9"
                                 "d"));
}

}  // namespace
