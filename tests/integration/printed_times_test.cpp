// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// When a program printed what, as the recordings of its runs say it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <charconv>
#include <filesystem>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "playerlike/host/kept_run.h"
#include "playerlike/host/program.h"
#include "playerlike/host/rerun.h"
#include "playpen_process.h"
#include "sim/core/time.h"
#include "temporary_folder.h"

namespace {

namespace fs = std::filesystem;
using test_support::playpen;
using test_support::ProcessResult;
using test_support::read_bytes;
using test_support::TemporaryFolder;
using testing::HasSubstr;

double number_at(const std::string& text, std::size_t place) {
  double number = -1.0;
  std::from_chars(text.data() + place, text.data() + text.size(), number);
  return number;
}

/// Expects that the run that is made again prints each line within a tenth of a second of the time
/// that the line begins with. @return number of lines with a time.
int expect_times(const fs::path& folder) {
  constexpr double kPeriod_s = 0.1;
  constexpr double kStep_s = 0.011;
  playerlike::Rerun rerun(folder.string());
  EXPECT_EQ(rerun.program_log(), (folder / "program.log").string());
  const std::string log = read_bytes(folder / "program.log");
  std::size_t begin = 0;
  int lines = 0;
  while (rerun.step()) {
    for (;;) {
      const std::size_t end = log.find('\n', begin);
      if (end >= rerun.printed_bytes()) break;
      const double now_s = sim::to_seconds(rerun.simulation().now_ns());
      const double line_s = number_at(log, begin);
      EXPECT_GE(now_s, line_s);
      EXPECT_LE(now_s, line_s + kPeriod_s + kStep_s);
      begin = end + 1;
      ++lines;
    }
  }
  return lines;
}

TEST(PrintedTimes, GradedRun_ToATenthOfASecond) {
  const TemporaryFolder folder;
  const std::string out = folder / "grade";
  static_cast<void>(
      playpen({"grade", "par_intro", "--seeds", "1", "--out", out, "--", PRINTING_PROGRAM}));
  EXPECT_GE(expect_times(fs::path(out) / "par_intro_seed1"), 28);
}

TEST(PrintedTimes, IsolatedRun_ToATenthOfASecond) {
  const TemporaryFolder folder;
  const std::string out = folder / "grade";
  const ProcessResult graded = playpen({"grade", "par_intro", "--isolated=required", "--seeds", "1",
                                        "--out", out, "--", PRINTING_PROGRAM});
  if (graded.err.find("cannot be isolated") != std::string::npos) GTEST_SKIP() << graded.err;
  EXPECT_GE(expect_times(fs::path(out) / "par_intro_seed1"), 28);
}

/// Programs that print a lot, so that their supervisors read while they print.
class ManyRuns : public testing::Test {
 protected:
  [[nodiscard]] playerlike::ProgramJob job(std::size_t number, std::uint64_t limit) {
    playerlike::RunSettings settings;
    settings.output_folder = folder(number).string();
    fs::create_directories(settings.output_folder);
    settings.quiet_end = true;
    settings.duration_s = 4.0;
    playerlike::ProgramJob job;
    job.command = {PRINTING_PROGRAM, "50000"};
    job.environment =
        playerlike::run_environment(PLAYPEN_SOURCE_DIR "/worlds/tasks/par_intro.json", settings);
    job.output_file = (folder(number) / "program.log").string();
    job.output_limit = limit;
    job.at_start = [this, number] {
      kept_[number] = std::make_unique<playerlike::KeptRun>();
      return playerlike::EnvironmentChanges{{"PLAYPEN_STATE", kept_[number]->file()}};
    };
    job.kept = [this, number]() -> const playerlike::KeptRun& { return *kept_[number]; };
    return job;
  }
  [[nodiscard]] fs::path folder(std::size_t number) const {
    return folder_.path() / std::to_string(number);
  }

  TemporaryFolder folder_;
  std::vector<std::unique_ptr<playerlike::KeptRun>> kept_{100};
};

TEST_F(ManyRuns, SameProgram_SameRecordings) {
  std::vector<playerlike::ProgramJob> jobs;
  for (std::size_t i = 0; i < kept_.size(); ++i) jobs.push_back(job(i, 10'000'000));
  // Half of the runs share the processors.
  const auto half = jobs.begin() + 50;
  static_cast<void>(playerlike::run_programs({jobs.begin(), half}, {.at_once = 1}));
  static_cast<void>(playerlike::run_programs({half, jobs.end()}, {.at_once = 8}));
  std::set<std::string> recordings;
  for (std::size_t i = 0; i < kept_.size(); ++i) {
    recordings.insert(read_bytes(folder(i) / "recording.bin"));
  }
  EXPECT_EQ(recordings.size(), 1U);
  EXPECT_GE(expect_times(folder(0)), 28);
}

TEST_F(ManyRuns, LimitOfOutput_TimesUntilThere) {
  constexpr std::uint64_t kLimit = 500'000;
  static_cast<void>(playerlike::run_programs({job(0, kLimit)}, {}));
  EXPECT_EQ(expect_times(folder(0)), 9);
  playerlike::Rerun rerun(folder(0).string());
  while (rerun.step()) {
  }
  EXPECT_EQ(rerun.printed_bytes(), kLimit);
  EXPECT_THAT(read_bytes(folder(0) / "program.log"), HasSubstr("more than 500000 bytes"));
}

}  // namespace
