// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// worlds/examples/living_arena.json, with two timers, three traps and two robots: its report,
// trajectory, pictures and film are equal in every run, in one process and over sockets, however
// busy the machine is. PLAYPEN_REPEATS in the environment sets the number of runs under load.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "machine_load.h"
#include "nightly.h"
#include "playpen_process.h"
#include "run_files.h"
#include "run_process.h"
#include "temporary_folder.h"

namespace {

using nlohmann::json;
using test_support::address_of;
using test_support::expect_equal_files;
using test_support::Files;
using test_support::files_of_run;
using test_support::MachineLoad;
using test_support::patient;
using test_support::Process;
using test_support::ProcessOptions;
using test_support::ProcessResult;
using test_support::repeats;
using test_support::TemporaryFolder;
using testing::IsSupersetOf;

using Words = std::vector<std::string>;

constexpr const char* kWorld = PLAYPEN_SOURCE_DIR "/worlds/examples/living_arena.json";

/// Every file of a run. The report is without wall times, without the reason of its end, because a
/// server outlives its clients, and without the promise to be repeatable, which `playpen serve`
/// does not make for two programs.
Files files_of(const std::string& folder) {
  return files_of_run(folder, [](json& report) {
    EXPECT_EQ(report["run"].erase("repeatable"), 1U);
    report["run"].erase("repeatable_why");
    report["run"].erase("repeatable_on");
    EXPECT_EQ(report.erase("ended"), 1U);
  });
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
                     "--tcp-port",
                     "0",
                     "--clients",
                     std::to_string(programs.size())};
    add_options(command, folder);
    Process server(command, patient());
    ProcessOptions remote = patient();
    remote.environment["PLAYPEN_WORLD"] = address_of(server);
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
};

TEST_F(LivingArena, ReportsAndFilms_SameInEveryModeAndUnderLoad) {
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

  if (test_support::nightly()) expect_equal_files(run(), expected, "again");
  expect_equal_files(serve({{PROGRAM}}), expected, "over TCP");
  expect_equal_files(serve({{PROGRAM, "runner"}, {PROGRAM, "chaser"}}), expected, "two programs");
  const MachineLoad load;
  for (int i = 0; i < repeats(1, 1); ++i) {
    expect_equal_files(run(), expected, "under load");
    expect_equal_files(serve({{PROGRAM, "chaser"}, {PROGRAM, "runner"}}), expected,
                       "over TCP under load");
  }
}

}  // namespace
