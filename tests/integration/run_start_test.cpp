// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Runs that begin in the middle of a finished one (--from), or stop at a time (--until).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "playpen_process.h"
#include "run_files.h"
#include "run_process.h"
#include "temporary_folder.h"

namespace {

using test_support::ProcessResult;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;

using Words = std::vector<std::string>;

class RunStart : public testing::Test {
 protected:
  [[nodiscard]] static ProcessResult run(Words options, const std::string& out) {
    options.insert(options.begin(), "run");
    options.insert(options.end(), {"--quiet", "--out", out, "--", PROGRAM, "one"});
    return test_support::playpen(options);
  }
  /// Makes the run from which the others start: 6 s.
  void make_first() {
    const ProcessResult end = run({world_}, first_);
    ASSERT_EQ(end.status, 0) << end.err;
  }
  void expect_refused(const Words& options, const std::string& words) const {
    const std::string out = folder_ / "refused";
    const ProcessResult end = run(options, out);
    EXPECT_EQ(end.status, 2) << end.err;
    EXPECT_THAT(end.err, HasSubstr(words));
    EXPECT_FALSE(std::filesystem::exists(out));
  }
  [[nodiscard]] static Words rows(const std::string& out) {
    std::ifstream file(out + "/trajectory.csv");
    Words all;
    for (std::string row; std::getline(file, row);) all.push_back(row);
    return all;
  }

  test_support::TemporaryFolder folder_;
  std::string world_ = folder_.write("room.json", test_support::room_world(0.01));
  std::string first_ = folder_ / "first";
  std::string second_ = folder_ / "second";
};

TEST_F(RunStart, FromRun_BeginsThere) {
  make_first();
  const ProcessResult end = run({"--from", first_ + "@3.1"}, second_);
  ASSERT_EQ(end.status, 0) << end.err;
  EXPECT_THAT(end.err, IsEmpty());
  const Words begin = rows(second_);
  const Words before = rows(first_);
  EXPECT_EQ(begin.at(1), before.at(32));  // at 3.1 s, after the line of titles
  EXPECT_THAT(begin.back(), HasSubstr("9.100,r1,"));
  const auto report = test_support::read_report(second_).at("run");
  EXPECT_EQ(report.at("repeatable"), true);
  EXPECT_EQ(report.at("sim_time"), 9.1);

  // Its recording can be used in the same way, with the world's name and a duration.
  const std::string third = folder_ / "third";
  const ProcessResult again = run({world_, "--from", second_ + "@5", "--duration", "7"}, third);
  ASSERT_EQ(again.status, 0) << again.err;
  EXPECT_EQ(rows(third).at(1), begin.at(20));
  EXPECT_THAT(rows(third).back(), HasSubstr("7.000,r1,"));
}

TEST_F(RunStart, SameStart_SameRunAlsoIsolated) {
  make_first();
  const std::string moment = first_ + "@2.345";
  ASSERT_EQ(run({"--from", moment}, second_).status, 0);
  const std::string other = folder_ / "other";
  const ProcessResult end = run({"--from", moment, "--isolated", "best"}, other);
  ASSERT_EQ(end.status, 0) << end.err;
  EXPECT_EQ(rows(other), rows(second_));
}

TEST_F(RunStart, SeveralPrograms_SameGate) {
  const std::string two = std::string(PROGRAM) + " one 6665 & " + PROGRAM + " one 6666 & wait";
  const std::string world = folder_.write("two.json", R"({"arena": {"size": [4, 4]}, "robots": [
    {"name": "r1", "pose": {"x": 1, "y": 1}}, {"name": "r2", "pose": {"x": 1, "y": 3}}]})");
  const auto both = [&two](const Words& options, const std::string& out) {
    Words call = {"run", "--quiet", "--out", out, "--time", "lockstep"};
    call.insert(call.end(), options.begin(), options.end());
    call.insert(call.end(), {"--", "sh", "-c", two});
    return test_support::playpen(call);
  };
  const ProcessResult before = both({world, "--clients", "2"}, first_);
  ASSERT_EQ(before.status, 0) << before.err;
  const ProcessResult end = both({"--from", first_ + "@3"}, second_);
  ASSERT_EQ(end.status, 0) << end.err;
  EXPECT_THAT(rows(second_).at(1), HasSubstr("3.000,r1,"));
  EXPECT_THAT(rows(second_).back(), HasSubstr("9.000,r2,"));
  expect_refused({"--from", first_ + "@3", "--until", "4", "--then", "debug"},
                 "not in the program's process");
}

TEST_F(RunStart, UntilThenSave_EndsThere) {
  ASSERT_EQ(run({world_, "--until", "3.1", "--then", "save"}, first_).status, 0);
  EXPECT_THAT(rows(first_).back(), HasSubstr("3.100,r1,"));
  const ProcessResult end = run({"--from", first_ + "@3.1"}, second_);
  ASSERT_EQ(end.status, 0) << end.err;
  EXPECT_EQ(rows(second_).at(1), rows(first_).back());
  EXPECT_THAT(rows(second_).back(), HasSubstr("9.100,r1,"));
}

TEST_F(RunStart, UnusableMoment_Refused) {
  make_first();
  for (const char* text : {"out", "@3", "out@", "out@-1", "out@x", "out@nan"}) {
    expect_refused({"--from", text}, "--from: must be FOLDER@SECONDS");
  }
  expect_refused({"--from", folder_ / "none@1"}, "expected the recording of a run, found no file");
  expect_refused({"--from", first_ + "@6.5"}, "the run ends at 6 s");
  expect_refused({"--from", first_ + "@3", "--duration", "2"}, "a duration of 2 s is over then");
  expect_refused({"cave", "--from", first_ + "@3"}, "the world's name can be left out");
  const ProcessResult same = run({"--from", first_ + "@3"}, first_);
  EXPECT_EQ(same.status, 2);
  EXPECT_THAT(same.err, HasSubstr("would replace those of that run"));
  EXPECT_THAT(rows(first_).back(), HasSubstr("6.000,r1,")) << "it stays";
  ASSERT_EQ(run({"--from", first_ + "@3"}, second_).status, 0);
  expect_refused({"--from", second_ + "@2"}, "the run begins at 3 s");
}

TEST_F(RunStart, ChangedWorldOrVersion_Refused) {
  make_first();
  folder_.write("room.json", test_support::room_world(0.02));
  expect_refused({"--from", first_ + "@3"}, "the world has changed since the run");
  std::string recording;
  {
    std::ifstream file(first_ + "/recording.bin", std::ios::binary);
    recording.assign(std::istreambuf_iterator<char>(file), {});
  }
  const std::size_t version = recording.find("\"version\":\"");
  ASSERT_NE(version, std::string::npos);
  recording.replace(version + 11, 1, "9");
  std::ofstream(first_ + "/recording.bin", std::ios::binary) << recording;
  expect_refused({"--from", first_ + "@3"}, "can be made again by the version that made it");
}

TEST_F(RunStart, SettingsOfRecordedRun_Refused) {
  const Words options[] = {{"--seed", "3"},           {"--realism", "ideal"},
                           {"--view-mode", "ground"}, {"--port", "7000"},
                           {"--clients", "2"},        {"--interface", "ranger:0=sonar"},
                           {"--take-over"},           {"--real", "r1=tcp://localhost:4000"}};
  for (Words words : options) {
    words.insert(words.begin(), {"--from", "out@3"});
    expect_refused(words, words[2] + ": with --from, the recorded run decides about this");
  }
  expect_refused({}, "world is required");
  expect_refused({"tcp://localhost", "--from", "out@3"}, "--from: the world is that of a server");
}

TEST_F(RunStart, UnusableUntil_Refused) {
  const auto refused = [this](Words options, const std::string& words) {
    options.insert(options.begin(), world_);
    expect_refused(options, words);
  };
  refused({"--until", "3"}, "--until requires --then");
  refused({"--then", "save"}, "--then requires --until");
  refused({"--until", "x", "--then", "save"}, "--until: must be a number of seconds");
  refused({"--until", "3", "--then", "fly"}, "--then: must be debug, view or save");
  refused({"--until", "0", "--then", "save"}, "--until must be above 0");
  refused({"--until", "3", "--then", "save", "--duration", "5"}, "leave out --duration");
  for (const char* then : {"debug", "view"}) {
    refused({"--until", "3", "--then", then, "--time", "real"}, "leave out --time");
    refused({"--until", "3", "--then", then, "--duration", "3"}, "the run is over at 3 s");
  }
  refused({"--until", "3", "--then", "debug", "--clients", "2"}, "not in the program's process");
  refused({"--until", "3", "--then", "debug", "--isolated", "best"}, "a debugger cannot reach");
  expect_refused({"tcp://localhost", "--until", "3", "--then", "save"},
                 "--until: the world is that of a server");
  make_first();
  expect_refused({"--from", first_ + "@4", "--until", "3", "--then", "debug"},
                 "the run begins later, at 4 s");
}

}  // namespace
