// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// worlds/examples/living_arena.json, with two timers, three traps and two robots: its report,
// trajectory, pictures and film are equal in every run, in one process and over sockets, however
// busy the machine is. PLAYPEN_REPEATS in the environment sets the number of runs under load.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "machine_load.h"
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
using test_support::TemporaryFolder;
using testing::HasSubstr;
using testing::IsSupersetOf;

using Words = std::vector<std::string>;
using Files = std::map<std::string, std::string>;

constexpr const char* kWorld = PLAYPEN_SOURCE_DIR "/worlds/examples/living_arena.json";

int repeats() {
  const char* text = std::getenv("PLAYPEN_REPEATS");
  return text == nullptr ? 1 : std::max(1, std::atoi(text));
}

/// Every file of a folder by its name. The report is without wall times, without the reason of its
/// end, because a server outlives its clients, and without the promise to be repeatable, which
/// `playpen serve` does not make for two programs.
Files files_of(const std::string& folder) {
  Files result;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    result[fs::relative(entry.path(), folder).string()] = read_bytes(entry.path());
  }
  json report = json::parse(result.at("report.json"));
  EXPECT_EQ(report["run"].erase("wall_time"), 1U);
  EXPECT_EQ(report["run"].erase("real_time_factor"), 1U);
  EXPECT_EQ(report["run"].erase("repeatable"), 1U);
  report["run"].erase("repeatable_why");
  EXPECT_EQ(report.erase("ended"), 1U);
  result["report.json"] = report.dump(1);
  return result;
}

class LivingArena : public testing::Test {
 protected:
  /// The results of `playpen run` with one program for both robots.
  [[nodiscard]] Files run() const {
    TemporaryFolder folder;
    Words command = {PLAYPEN_COMMAND, "run", kWorld};
    add_options(command, folder);
    for (const char* word : {"--real-sleep", "--", PROGRAM}) command.emplace_back(word);
    const ProcessResult result = Process(command, patient()).finish();
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(result.out, kPrinted);
    return files_of(folder / "out");
  }

  /// The results of `playpen serve` with these programs.
  [[nodiscard]] Files serve(const std::vector<Words>& programs) const {
    TemporaryFolder folder;
    Words command = {PLAYPEN_COMMAND,
                     "serve",
                     kWorld,
                     "--time",
                     "lockstep",
                     "--port",
                     "0",
                     "--clients",
                     std::to_string(programs.size())};
    add_options(command, folder);
    Process server(command, patient());
    EXPECT_TRUE(server.read_until("\n")) << server.finish().err;
    const std::string said = server.output();
    EXPECT_THAT(said, HasSubstr("listening on 127.0.0.1:"));
    const std::string port = said.substr(said.rfind(':') + 1);
    ProcessOptions remote = patient();
    remote.environment["PLAYPEN_WORLD"] = "tcp://127.0.0.1:" + port.substr(0, port.find('\n'));
    std::vector<std::unique_ptr<Process>> running;
    for (const Words& program : programs) {
      running.push_back(std::make_unique<Process>(program, remote));
    }
    for (const auto& program : running) {
      const ProcessResult result = program->finish();
      EXPECT_EQ(result.status, 0) << result.err;
      EXPECT_EQ(result.out, kPrinted);
    }
    const ProcessResult end = server.finish();  // the world's controller ends the run
    EXPECT_EQ(end.status, 0) << end.err;
    return files_of(folder / "out");
  }

  /// Compares with the results of the first run.
  static void expect_equal(const Files& found, const Files& expected, const std::string& which) {
    EXPECT_EQ(found.at("report.json"), expected.at("report.json")) << which;
    for (const auto& [name, bytes] : expected) {
      // Not EXPECT_EQ, because pictures do not print well.
      EXPECT_TRUE(found.count(name) == 1 && found.at(name) == bytes)
          << which << ": " << name << " differs";
    }
    EXPECT_EQ(found.size(), expected.size()) << which;
  }

  static constexpr const char* kPrinted = "11 5 the runner is at the goal\n";

 private:
  static void add_options(Words& command, const TemporaryFolder& folder) {
    const std::string out = folder / "out";
    for (const std::string& word :
         Words{"--quiet", "--duration", "60", "--out", out, "--record", out + "/film",
               "--record-fps", "2", "--film-size", "320x240"}) {
      command.push_back(word);
    }
  }
  /// On a very busy machine, a client may be silent for longer than the usual limit, which is in
  /// wall-clock time.
  static ProcessOptions patient() {
    ProcessOptions options;
    options.environment = {{"PLAYPEN_SILENCE_LIMIT", "900"}};
    return options;
  }
};

TEST_F(LivingArena, GivesTheSameReportsAndFilmsEverywhereAndUnderLoad) {
  const Files expected = run();

  // The run does what it is for: everything happens that this world can do.
  const json report = json::parse(expected.at("report.json"));
  std::vector<std::string> happened;
  for (const json& event : report.at("events")) {
    happened.push_back(event.at("kind").get<std::string>() + " " +
                       event.at("what").get<std::string>());
  }
  EXPECT_THAT(happened,
              IsSupersetOf({"timer opening", "timer closing", "trap plate", "trap caught",
                            "trap goal", "configuration open", "configuration closed",
                            "sinking gate", "retracted gate", "waiting gate", "rising gate",
                            "extended gate", "placed puck", "score plate", "restart runner",
                            "enabled closing", "text opening", "message caught", "end goal"}))
      << report.at("events").dump(1);
  EXPECT_GT(expected.size(), 80U) << "pictures of the film";

  expect_equal(run(), expected, "again");
  expect_equal(serve({{PROGRAM}}), expected, "over TCP");
  expect_equal(serve({{PROGRAM, "runner"}, {PROGRAM, "chaser"}}), expected, "two programs");
  const test_support::MachineLoad load;
  for (int i = 0; i < repeats(); ++i) {
    expect_equal(run(), expected, "under load");
    expect_equal(serve({{PROGRAM, "chaser"}, {PROGRAM, "runner"}}), expected,
                 "over TCP under load");
  }
}

}  // namespace
