// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// `playpen batch` on this machine. tests/batch/engines_test.sh tries the engines.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <deque>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "playpen_process.h"
#include "run_files.h"
#include "temporary_folder.h"

namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test_support::playpen;
using test_support::ProcessResult;
using test_support::read_bytes;
using test_support::TemporaryFolder;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

using Words = std::vector<std::string>;

/// batch.json without what the clock says.
json batch_json(const std::string& out) {
  json whole = json::parse(read_bytes(out + "/batch.json"));
  for (json& unit : whole.at("units")) unit.erase("wall_time");
  return whole;
}

class Batch : public testing::Test {
 protected:
  Batch() { write_plan(6); }

  void write_plan(int seeds, const std::string& more = "") {
    folder_.write("plans/plan.json",
                  R"({"programs": [{"name": "robot", "command": [")" AVOID_PROGRAM
                  R"("]}, {"name": "none", "command": ["false"]}], "worlds": ["par_intro"],
                      "parameters": {"/robots/0/pose/x": [0.5, 0.55]}, "duration": 2, "seeds": )" +
                      std::to_string(seeds) + more + "}");
  }
  [[nodiscard]] Words call(const std::string& out, const Words& more = {}) const {
    Words words = {"batch", folder_ / "plans/plan.json", "--out", folder_ / out};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
  [[nodiscard]] ProcessResult on(const std::string& out, const Words& more) const {
    Words words = {"batch", "--out", folder_ / out};
    words.insert(words.end(), more.begin(), more.end());
    return playpen(words);
  }
  [[nodiscard]] std::size_t units_in(const std::string& out) const {
    std::error_code error;
    std::size_t count = 0;
    for (fs::directory_iterator entry(folder_ / out + "/units", error), end; !error && entry != end;
         entry.increment(error)) {
      ++count;
    }
    return count;
  }

  TemporaryFolder folder_;
};

TEST_F(Batch, AllUnits_HaveResults) {
  const ProcessResult first = playpen(call("out"));
  ASSERT_EQ(first.status, 0) << first.err;
  EXPECT_THAT(first.err, HasSubstr("batch: 24 runs\n"));
  EXPECT_THAT(first.out, AllOf(HasSubstr("24 runs, 24 ended, 12 passed"),
                               HasSubstr("the program ended with status 1"),
                               HasSubstr("and 7 more in results.csv"), HasSubstr(" --repeat ")));
  const json whole = batch_json(folder_ / "out");
  EXPECT_EQ(whole.at("complete"), true);
  const json& unit = whole.at("units").at(0);
  EXPECT_EQ(unit.at("world"), "par_intro");
  const std::string folder = folder_ / "out/" + unit.at("folder").get<std::string>();
  for (const char* file : {"report.json", "scene.png", "trajectory.csv", "program.log"}) {
    EXPECT_TRUE(fs::exists(folder + '/' + file)) << file;
  }
  EXPECT_NE(unit.at("path_length"), whole.at("units").at(6).at("path_length")) << "the parameter";
  EXPECT_FALSE(fs::exists(folder_ / "out/work"));

  const ProcessResult second = playpen(call("out"));
  EXPECT_THAT(second.err, HasSubstr("batch: 0 runs, 24 known from before"));
  write_plan(7);
  EXPECT_THAT(playpen(call("out")).err, HasSubstr("batch: 4 runs, 24 known from before"));
  EXPECT_THAT(playpen(call("out", {"--failed"})).err, HasSubstr("14 runs, 14 known from before"));
}

TEST_F(Batch, Sandbox_GivesTheSameResults) {
  write_plan(1);
  const ProcessResult isolated = playpen(call("isolated", {"--isolated", "required"}));
  if (isolated.err.find("cannot be isolated") != std::string::npos) GTEST_SKIP() << isolated.err;
  ASSERT_EQ(isolated.status, 0) << isolated.err;
  ASSERT_EQ(playpen(call("out")).status, 0);
  EXPECT_EQ(batch_json(folder_ / "isolated").at("groups"),
            batch_json(folder_ / "out").at("groups"));
}

TEST_F(Batch, Killed_GoesOnToTheSameResult) {
  ASSERT_EQ(playpen(call("whole")).status, 0);
  for (const std::size_t at : {std::size_t{3}, std::size_t{9}}) {
    Words words = call("killed", {"--jobs", "2"});
    words.insert(words.begin(), PLAYPEN_COMMAND);
    test_support::Process process(words);
    while (units_in("killed") < at) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    process.send_signal(SIGKILL);
    static_cast<void>(process.finish());
  }
  const ProcessResult last = playpen(call("killed"));
  EXPECT_EQ(last.status, 0) << last.err;
  EXPECT_THAT(last.err, HasSubstr("known from before"));
  EXPECT_EQ(batch_json(folder_ / "killed"), batch_json(folder_ / "whole"));
  EXPECT_FALSE(fs::exists(folder_ / "killed/work"));
}

TEST_F(Batch, Parts_DoubledOnesCountOnce) {
  ASSERT_EQ(playpen(call("whole")).status, 0);
  ASSERT_EQ(playpen(call("parts", {"--collect"})).status, 1) << "no unit has run";
  const ProcessResult none = on("parts", {"--collect"});
  EXPECT_THAT(none.out, HasSubstr("24 runs have no results yet"));
  std::deque<test_support::Process> workers;
  for (const char* part : {"1/2", "2/2", "1/1", "2/3"}) {
    workers.emplace_back(
        Words{PLAYPEN_COMMAND, "batch", "--out", folder_ / "parts", "--part", part, "--jobs", "1"});
  }
  for (test_support::Process& worker : workers) EXPECT_EQ(worker.finish().status, 0);
  EXPECT_EQ(on("parts", {"--collect"}).status, 0);
  EXPECT_EQ(batch_json(folder_ / "parts"), batch_json(folder_ / "whole"));
  EXPECT_EQ(units_in("parts"), 24U);
  EXPECT_FALSE(fs::exists(folder_ / "parts/work"));
}

TEST_F(Batch, BadInput_RunsNothing) {
  const auto error_of = [&](const std::string& plan) {
    folder_.write("plans/plan.json", plan);
    const ProcessResult result = playpen(call("out"));
    EXPECT_EQ(result.status, 2) << plan;
    EXPECT_EQ(units_in("out"), 0U) << plan;
    return result.err;
  };
  EXPECT_THAT(error_of(R"({"programs": ["no/robot"], "worlds": ["cave"]})"),
              HasSubstr(folder_ / "plans/no/robot"));
  EXPECT_THAT(error_of(R"({"programs": ["true"], "worlds": ["cav"]})"), HasSubstr("cave"));
  EXPECT_THAT(error_of(R"({"programs": ["true"], "task": "par_intr"})"), HasSubstr("par_intro"));
  EXPECT_THAT(error_of(R"({"programs": ["true"], "worlds": ["cave"], "parameters":
                           {"/robots/9/pose/x": [1]}})"),
              HasSubstr("[plan/parameter]"));
  const ProcessResult nothing = on("nothing", {"--collect"});
  EXPECT_EQ(nothing.status, 2);
  EXPECT_THAT(nothing.err, HasSubstr("units.json' cannot be read"));
  write_plan(1);
  ASSERT_EQ(playpen(call("out")).status, 0);
  EXPECT_THAT(on("out", {"--repeat", "0123"}).err, HasSubstr("no unit '0123'"));
  for (const char* part : {"0/2", "3/2", "1", "a/b", "1/2/3"}) {
    EXPECT_THAT(on("out", {"--part", part}).err, HasSubstr("two whole numbers, as 3/20")) << part;
  }
  EXPECT_EQ(on("out", {"--part", "1/2", "--collect"}).status, 2);
}

}  // namespace
