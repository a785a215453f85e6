// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Copies of a program that was started once.
#include "playerlike/host/prepared_program.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <poll.h>

#include <filesystem>

#include "playerlike/host/report.h"
#include "run_files.h"
#include "temporary_folder.h"

namespace playerlike {
namespace {

namespace fs = std::filesystem;
using test_support::read_bytes;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr const char* kIntroWorld = PLAYPEN_SOURCE_DIR "/worlds/tasks/par_intro.json";

class PreparedProgramTest : public testing::Test {
 protected:
  PreparedProgramTest() {
    RunSettings settings;
    settings.figures_only = true;
    settings.quiet_end = true;
    settings.duration_s = 5.0;
    environment_ = run_environment(kIntroWorld, settings);
  }
  // Runs a copy with a seed, in a folder of that name.
  ProgramEnd run(PreparedProgram& program, const std::string& seed) const {
    program.start({{"PLAYPEN_SEED", seed}, {"PLAYPEN_OUT", folder_ / seed}}, folder_ / "printed");
    for (;;) {
      if (const auto end = program.poll()) return *end;
      pollfd readable{program.descriptor(), POLLIN, 0};
      ::poll(&readable, 1, -1);
    }
  }
  Report report(const std::string& seed) const {
    return report_from(read_bytes(fs::path(folder_ / seed) / "report.json"));
  }

  const test_support::TemporaryFolder folder_;
  EnvironmentChanges environment_;
};

TEST_F(PreparedProgramTest, Copies_HaveTheirOwnRuns) {
  PreparedProgram program({WALL_PROGRAM}, environment_);
  for (const char* const seed : {"1", "2", "3"}) {
    EXPECT_TRUE(run(program, seed).success()) << read_bytes(folder_ / "printed");
  }
  EXPECT_EQ(report("2").run.seed, 2U);
  EXPECT_EQ(report("2").run.sim_time_s, 5.0);
  EXPECT_GT(report("3").robots[0].path_length_m, 0.5);
  // Figures only: no pictures, no recording.
  EXPECT_TRUE(fs::exists(folder_ / "1/trajectory.csv"));
  EXPECT_FALSE(fs::exists(folder_ / "1/scene.png"));
  EXPECT_FALSE(fs::exists(folder_ / "1/recording.bin"));
}

TEST_F(PreparedProgramTest, EqualCopies_EqualStates) {
  PreparedProgram program({WALL_PROGRAM}, environment_);
  PreparedProgram other({WALL_PROGRAM}, environment_);
  EXPECT_TRUE(run(program, "7").success());
  const std::optional<std::string> hash = report("7").run.state_hash;
  EXPECT_TRUE(run(program, "7").success());
  EXPECT_EQ(report("7").run.state_hash, hash);
  EXPECT_TRUE(run(other, "7").success());
  EXPECT_EQ(report("7").run.state_hash, hash);
}

TEST_F(PreparedProgramTest, KilledCopy_NextOneRuns) {
  environment_["PLAYPEN_DURATION"] = "1e6";
  PreparedProgram program({WALL_PROGRAM}, environment_);
  program.start({{"PLAYPEN_OUT", folder_ / "long"}}, folder_ / "printed");
  program.kill_copy();
  std::optional<ProgramEnd> end;
  while (!end) end = program.poll();
  EXPECT_EQ(end->signal, SIGKILL);
  program.start({{"PLAYPEN_DURATION", "1"}, {"PLAYPEN_OUT", folder_ / "short"}},
                folder_ / "printed");
  for (end.reset(); !end; end = program.poll()) {
  }
  EXPECT_TRUE(end->success());
}

TEST_F(PreparedProgramTest, ProgramWithoutPlaypen_Error) {
  EXPECT_THAT([&] { const PreparedProgram program({"/bin/true"}, environment_); },
              ThrowsMessage<ProgramError>(HasSubstr("linked with Playpen")));
  EXPECT_THAT([&] { const PreparedProgram program({"/no/such/program"}, environment_); },
              ThrowsMessage<ProgramError>(HasSubstr("cannot be started")));
}

}  // namespace
}  // namespace playerlike
