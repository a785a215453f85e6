// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// The same program gives the same result every time, however busy the machine is. The test runs
// every program with threads twice per merge, beside a busy process per core. In nightly runs it
// runs them four times or as often as PLAYPEN_REPEATS in the environment says, beside four busy
// processes per core.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "machine_load.h"
#include "nightly.h"
#include "playpen_process.h"
#include "run_files.h"
#include "run_process.h"
#include "temporary_folder.h"

namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test_support::MachineLoad;
using test_support::patient;
using test_support::playpen;
using test_support::Process;
using test_support::ProcessOptions;
using test_support::ProcessResult;
using test_support::read_bytes;
using test_support::read_report;
using test_support::repeats;
using test_support::TemporaryFolder;
using test_support::without_wall_time;
using testing::HasSubstr;

const char* const kPreloaded = PRELOADED_LIBRARY;
constexpr const char* kDuration_s = "4";

using Command = std::vector<std::string>;

/// All programs with threads.
std::vector<Command> programs() {
  std::istringstream lines(test_support::run_process({THREAD_PROGRAMS}).out);
  std::vector<Command> all;
  for (std::string line; std::getline(lines, line);) all.push_back({THREAD_PROGRAMS, line});
  for (const char* name : {"read_in_background", "read_in_own_thread", "have_threads_with_clients",
                           "join_threads", "wait_for_each_other", "steer_when_told"}) {
    all.push_back({SLEEPING_PROGRAM, name});
  }
  return all;
}

class Repeats : public testing::Test {
 protected:
  /// The environment that `playpen run` gives a program, but without results, which cost time.
  [[nodiscard]] ProcessOptions environment() const {
    ProcessOptions options = patient();
    options.environment.insert({{"LD_PRELOAD", kPreloaded},
                                {"PLAYPEN_VIRTUAL_TIME", "1"},
                                {"PLAYPEN_RUN", "1"},
                                {"PLAYPEN_WORLD", world_},
                                {"PLAYPEN_DURATION", kDuration_s}});
    return options;
  }
  [[nodiscard]] Command whole_run(const Command& program) const {
    Command command = {PLAYPEN_COMMAND, "run",   world_, "--quiet", "--duration",
                       kDuration_s,     "--out", out_,   "--"};
    command.insert(command.end(), program.begin(), program.end());
    return command;
  }
  /// The results of a run: the report, without wall-clock times, and the trajectory.
  [[nodiscard]] std::string results() const {
    return without_wall_time(read_report(out_)).dump() +
           read_bytes(fs::path(out_) / "trajectory.csv");
  }

  TemporaryFolder folder_;
  std::string world_ =
      folder_.write("two.json", json{{"name", "two"},
                                     {"arena", {{"size", {2.0, 2.0}}}},
                                     {"robots",
                                      {{{"name", "r1"},
                                        {"pose", {{"x", 0.5}, {"y", 1.0}, {"yaw_deg", 0.0}}},
                                        {"devices", {{"laser", {{"noise", 0.01}}}}}},
                                       {{"name", "r2"},
                                        {"pose", {{"x", 1.5}, {"y", 1.0}, {"yaw_deg", 180.0}}},
                                        {"devices", {{"laser", {{"noise", 0.01}}}}}}}}}
                                    .dump());
  std::string out_ = folder_ / "out";
};

TEST_F(Repeats, ThreadedProgramsUnderLoad_Repeatable) {
  const std::vector<Command> all = programs();
  ASSERT_GE(all.size(), 29U);
  int runs = 0;
  int different = 0;
  const int most = repeats(test_support::cases(2, 4), 2);
  const MachineLoad load;
  for (const Command& program : all) {
    const std::string& name = program.back();
    std::optional<std::string> printed;
    std::optional<std::string> left;
    const auto compare = [&](const ProcessResult& result) {
      ++runs;
      EXPECT_EQ(result.status, 0) << name << ": " << result.err;
      if (!printed) printed = result.out;
      different += result.out == *printed ? 0 : 1;
      EXPECT_EQ(result.out, *printed) << name;
    };
    // Every fifth run writes results; the others run two at a time.
    for (int i = 0; i < most; ++i) {
      if (i % 5 == 0) {
        compare(Process(whole_run(program), patient()).finish());
        const std::string results_now = results();
        EXPECT_THAT(results_now, HasSubstr(R"("repeatable":true)")) << name;
        if (!left) left = results_now;
        different += results_now == *left ? 0 : 1;
        EXPECT_EQ(results_now, *left) << name;
        continue;
      }
      Process other(program, environment());
      if (++i < most && i % 5 != 0) {
        Process beside(program, environment());
        compare(beside.finish());
      } else {
        --i;
      }
      compare(other.finish());
    }
  }
  std::cout << all.size() << " programs, " << runs << " runs, " << different
            << " different results\n";
  EXPECT_EQ(different, 0);
}

// The system's clocks start at its boot. No result may depend on that.
TEST_F(Repeats, RecentBoot_SameResults) {
  std::ifstream file("/proc/uptime");
  double uptime_s = 0.0;
  ASSERT_TRUE(file >> uptime_s);
  const std::string offset = std::to_string(5 - static_cast<long long>(uptime_s));
  std::vector<std::string> command = {"unshare", "--user",     "--map-root-user",
                                      "--time",  "--fork",     "--monotonic",
                                      offset,    "--boottime", offset};
  std::vector<std::string> probe = command;
  probe.insert(probe.end(), {"true"});
  if (const ProcessResult result = test_support::run_process(probe); result.status != 0) {
    GTEST_SKIP() << "no time namespaces here: " << result.err;
  }
  for (const Command& program : programs()) {
    const std::string& name = program.back();
    const ProcessResult usual = Process(program, environment()).finish();
    Command in_namespace = command;
    in_namespace.insert(in_namespace.end(), program.begin(), program.end());
    const ProcessResult early = Process(in_namespace, environment()).finish();
    EXPECT_EQ(early.status, 0) << name << ": " << early.err;
    EXPECT_EQ(early.out, usual.out) << name;
  }
}

}  // namespace
