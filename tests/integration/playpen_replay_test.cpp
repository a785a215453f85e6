// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Runs `playpen replay` and `playpen why` on runs of real programs, and compares the runs that are
// made again with what the programs' own runs have left.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <charconv>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "playerlike/host/rerun.h"
#include "playpen_process.h"
#include "run_process.h"
#include "sim/core/number_text.h"
#include "sim/render/render.h"
#include "temporary_folder.h"

namespace {

namespace fs = std::filesystem;
using test_support::playpen;
using test_support::ProcessResult;
using test_support::read_bytes;
using test_support::run_process;
using test_support::TemporaryFolder;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

constexpr std::size_t kMostReplay = 5'000'000;

void run_program(const std::string& world, const std::string& folder, const std::string& program,
                 std::vector<std::string> options = {}) {
  options.insert(options.end(), {"--quiet"});
  const ProcessResult result =
      run_process(test_support::run_call(world, options, folder, program, {}));
  ASSERT_EQ(result.status, 0) << result.err;
}

/// Expects that the run that is made again has the poses of trajectory.csv.
void expect_same_trajectory(const std::string& folder) {
  playerlike::Rerun rerun(folder);
  std::istringstream rows(read_bytes(fs::path(folder) / "trajectory.csv"));
  std::string row;
  std::getline(rows, row);
  int compared = 0;
  while (std::getline(rows, row)) {
    std::vector<std::string> values;
    std::istringstream cells(row);
    for (std::string cell; std::getline(cells, cell, ',');) values.push_back(cell);
    double time_s = 0.0;  // std::stod() would read it in the language of the locale
    std::from_chars(values.at(0).data(), values.at(0).data() + values.at(0).size(), time_s);
    ASSERT_TRUE(rerun.advance_to(sim::from_seconds(time_s)));
    const sim::Simulation& run = rerun.simulation();
    const sim::BodyState& body = run.body(run.find_robot(values.at(1)).value());
    const sim::Pose& pose = body.X_WB;
    const double numbers[] = {pose.x_m, pose.y_m, pose.yaw_rad, body.twist.v_mps,
                              body.twist.omega_radps};
    for (std::size_t i = 0; i < 5; ++i) {
      ASSERT_EQ(sim::fixed_text(numbers[i], 6), values.at(2 + i)) << row;
    }
    ++compared;
  }
  EXPECT_GT(compared, 50);
  while (rerun.step()) {
  }
  EXPECT_TRUE(rerun.complete());
}

/// Expects that the layers of the run that is made again are those of its canvas.png.
void expect_same_drawings(const std::string& folder) {
  playerlike::Rerun rerun(folder);
  while (rerun.step()) {
  }
  // 172 x 186 cells with 6 pixels each.
  const sim::LayerStack& layers = rerun.layers();
  std::vector<std::string> names;
  for (const sim::LayerInfo& layer : layers.layers()) {
    const std::string& name = layer.style.name;
    names.push_back(name);
    const fs::path made = fs::path(folder) / ("again_" + name + ".png");
    sim::render::write_png(
        sim::render::draw_canvas(layers.description(), layers.picture(layer.id), 6), made.string());
    EXPECT_TRUE(read_bytes(made) == read_bytes(fs::path(folder) / "layers" / (name + ".png")))
        << name;
  }
  EXPECT_THAT(names, testing::Contains("occupancy"));
}

TEST(PlaypenReplay, ExplorationWithItsDrawings_SameAgainAndSmall) {
  const TemporaryFolder folder;
  const std::string out = folder / "out";
  const std::string page = folder / "page.html";
  run_program("par_exploration", out, EXPLORE_PROGRAM, {"--html", page});
  expect_same_trajectory(out);
  expect_same_drawings(out);
  const std::string text = read_bytes(page);
  EXPECT_LT(text.size(), kMostReplay);
  EXPECT_THAT(text, AllOf(StartsWith("<!DOCTYPE html>"), HasSubstr("Content-Security-Policy")));
  EXPECT_EQ(playpen({"replay", out, "--mcap", folder / "run.mcap"}).out,
            "MCAP file: " + (folder / "run.mcap") + "\n");
  EXPECT_THAT(read_bytes(folder / "run.mcap"), StartsWith("\x89MCAP0\r\n"));
  const ProcessResult again = playpen({"replay", out, "--at", "3.5", "--robot", "r1"});
  EXPECT_EQ(again.status, 0) << again.err;
  EXPECT_EQ(again.out, "replay: " + out + "/replay.html\nopen it: file://" + out +
                           "/replay.html#t=3.5&robot=r1\n");
  EXPECT_TRUE(read_bytes(out + "/replay.html") == text);
  const ProcessResult both = playpen({"replay", out, out, "--html", page, "--replay-size", "0.5"});
  EXPECT_EQ(both.status, 0) << both.err;
  EXPECT_LT(read_bytes(page).size(), 500'000U);
}

TEST(PlaypenReplay, SeveralProgramsAndServedWorld_SameAgain) {
  const TemporaryFolder folder;
  const std::string out = folder / "out";
  const ProcessResult result = playpen({"run", "par_traps", "--duration", "20", "--quiet",
                                        "--clients", "1", "--out", out, "--", AVOID_PROGRAM});
  ASSERT_EQ(result.status, 0) << result.err;
  expect_same_trajectory(out);
}

TEST(PlaypenReplay, GradedRuns_PageForEachWithPrintedLines) {
  const TemporaryFolder folder;
  const std::string out = folder / "grade";
  const ProcessResult graded =
      playpen({"grade", "par_intro", "--seeds", "2", "--html", "--out", out, "--", AVOID_PROGRAM});
  EXPECT_THAT(graded.out, AllOf(HasSubstr("replay: " + out + "/par_intro_seed1/replay.html\n"),
                                HasSubstr("replay: " + out + "/par_intro_seed2/replay.html\n")));
}

TEST(PlaypenReplay, OutputIntoProgramLog_HasTimes) {
  const TemporaryFolder folder;
  const std::string out = folder / "out";
  fs::create_directory(out);
  const std::string log = out + "/program.log";
  const ProcessResult result =
      run_process({"sh", "-c",
                   std::string(PLAYPEN_COMMAND) + " run par_exploration --quiet --out '" + out +
                       "' -- " + EXPLORE_PROGRAM + " > '" + log + "'"});
  ASSERT_EQ(result.status, 0) << result.err;
  playerlike::Rerun rerun(out);
  EXPECT_EQ(rerun.program_log(), log);
  EXPECT_EQ(rerun.printed_bytes(), 0U);
  while (rerun.step()) {
  }
  EXPECT_GT(rerun.printed_bytes(), 0U);
  EXPECT_LE(rerun.printed_bytes(), fs::file_size(log));
}

TEST(PlaypenReplay, Unusable_NamedWithReason) {
  const TemporaryFolder folder;
  const std::string out = folder / "out";
  const ProcessResult unwritable =
      playpen({"run", "par_intro", "--duration", "1", "--quiet", "--out", out, "--html",
               folder.write("file", "") + "/page.html", "--", AVOID_PROGRAM});
  EXPECT_EQ(unwritable.status, 1);
  EXPECT_THAT(unwritable.err, HasSubstr("playpen: there is no replay: "));
  run_program("par_intro", out, AVOID_PROGRAM, {"--duration", "2"});
  EXPECT_THAT(playpen({"replay", folder / "none"}).err, HasSubstr("found no folder '"));
  EXPECT_THAT(playpen({"replay", out, "--html", "page.txt"}).err,
              HasSubstr("must be a file ending in .html, but is 'page.txt'"));
  EXPECT_THAT(playpen({"replay", out, "--replay-size", "0"}).err,
              HasSubstr("must be a number of megabytes in [0.2, 1000], but is '0'"));
  EXPECT_THAT(playpen({"replay", out, "--mcap", "run.txt"}).err,
              HasSubstr("must be a file ending in .mcap, but is 'run.txt'"));
  EXPECT_THAT(playpen({"replay", out, "--mcap", "run.mcap", "--at", "1"}).err,
              HasSubstr("--at excludes --mcap"));
  EXPECT_THAT(playpen({"replay", out, "--at", "-1"}).err, HasSubstr("--at: must be a number of"));
  EXPECT_THAT(playpen({"why", out, "--robot", "r9"}).err,
              HasSubstr("--robot: expected a robot of the run (r1), found 'r9'"));
  fs::remove(out + "/recording.bin");
  for (const char* const command : {"replay", "why"}) {
    const ProcessResult result = playpen({command, out});
    EXPECT_EQ(result.status, 2);
    EXPECT_THAT(result.err, HasSubstr("expected the recording of a run, found no file of that"));
  }
}

TEST(PlaypenWhy, TemplateThatDoesNothing_SaidOnceWithPicture) {
  const TemporaryFolder folder;
  const std::string out = folder / "out";
  run_program("par_intro", out, IDLE_PROGRAM, {"--duration", "5"});
  const ProcessResult result = playpen({"why", out});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(result.out, "run: " + out +
                            "\nrobot r1: 5.0 s of simulated time\n"
                            "1. All 48 velocities that the program commanded were 0.\n"
                            "picture after 0.0 s: " +
                            out + "/why.png\nsee it: playpen replay " + out + " --at 0.0\n");
  EXPECT_THAT(read_bytes(out + "/why.png"), StartsWith("\x89PNG"));
}

TEST(PlaypenWhy, Grade_FailedRunsOnly) {
  const TemporaryFolder folder;
  const std::string out = folder / "grade";
  static_cast<void>(
      playpen({"grade", "par_planning", "--seeds", "1", "--out", out, "--", PLANNING_TEMPLATE}));
  const ProcessResult failed = playpen({"why", out});
  EXPECT_EQ(failed.status, 0) << failed.err;
  EXPECT_THAT(failed.out, AllOf(HasSubstr("robot r1: failed; "), HasSubstr("goal not reached")));
  const std::string json = folder / "new/reasons.json";
  ASSERT_EQ(playpen({"why", out, "--json", json}).status, 0);
  const auto runs = nlohmann::json::parse(read_bytes(json)).at("runs");
  ASSERT_EQ(runs.size(), 2U);
  EXPECT_EQ(runs.at(0).at("passed"), false);
  EXPECT_FALSE(runs.at(0).at("reasons").empty());
  static_cast<void>(
      playpen({"grade", "par_intro", "--seeds", "2", "--out", out, "--", AVOID_PROGRAM}));
  const ProcessResult passed = playpen({"why", out, "--json", json});
  EXPECT_EQ(passed.status, 0) << passed.err;
  EXPECT_EQ(passed.out, "All 2 runs have passed.\n");
  EXPECT_TRUE(nlohmann::json::parse(read_bytes(json)).at("runs").empty());
  const std::string impossible = folder.write("file", "") + "/reasons.json";
  const ProcessResult unwritable = playpen({"why", out, "--json", impossible});
  EXPECT_NE(unwritable.status, 0);
  EXPECT_THAT(unwritable.err, HasSubstr("the file '" + impossible + "' can't be written: "));
}

}  // namespace
