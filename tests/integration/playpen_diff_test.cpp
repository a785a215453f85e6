// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Runs the command `playpen diff` on runs of real programs, and on results that are no such.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "playpen_process.h"
#include "run_process.h"
#include "temporary_folder.h"

namespace {

using test_support::playpen;
using test_support::ProcessResult;
using test_support::read_bytes;
using test_support::run_process;
using test_support::TemporaryFolder;
using testing::AllOf;
using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

constexpr const char* kHeader = "time,robot,x,y,yaw,v,omega,stalled\n";

void run_program(const TemporaryFolder& folder, const std::string& world, const std::string& out,
                 const std::string& program) {
  const ProcessResult result = run_process(
      test_support::run_call(world, {"--duration", "10", "--quiet"}, folder / out, program, {}));
  ASSERT_EQ(result.status, 0) << result.err;
}

ProcessResult diff(const TemporaryFolder& folder, const std::string& first,
                   const std::string& second, const std::vector<std::string>& options = {}) {
  std::vector<std::string> call = {"diff", folder / first, folder / second};
  call.insert(call.end(), options.begin(), options.end());
  return playpen(call);
}

TEST(PlaypenDiff, SameProgramTwice_Equal) {
  const TemporaryFolder folder;
  run_program(folder, "par_intro", "one", AVOID_PROGRAM);
  run_program(folder, "par_intro", "two", AVOID_PROGRAM);
  const ProcessResult result = diff(folder, "one", "two", {"--out", folder / "d.svg"});
  EXPECT_EQ(result.status, 0) << result.out << result.err;
  EXPECT_EQ(result.err, "");
  // A row each 0.1 s, and one at the start.
  EXPECT_THAT(result.out, AllOf(HasSubstr("conditions: equal (world par_intro, seed 1, "),
                                HasSubstr("The runs are equal: all 101 rows of trajectories")));
  EXPECT_THAT(read_bytes(folder / "d.svg"), Not(HasSubstr("apart")));
}

TEST(PlaypenDiff, TwoPrograms_DifferWithPlaceTimeAndPicture) {
  const TemporaryFolder folder;
  run_program(folder, "par_intro", "avoid", AVOID_PROGRAM);
  run_program(folder, "par_intro", "wall", WALL_PROGRAM);
  const ProcessResult result = diff(folder, "avoid", "wall", {"--out", folder / "d.svg"});
  EXPECT_EQ(result.status, 1) << result.out << result.err;
  EXPECT_EQ(result.err, "");
  EXPECT_THAT(
      result.out,
      AllOf(HasSubstr("conditions: equal"), HasSubstr("first difference: at 0."), HasSubstr("1 mm"),
            HasSubstr("100 mm"), HasSubstr("10° of heading"), HasSubstr("greatest distance"),
            HasSubstr("r1: path length [m]"),
            HasSubstr("first command that differs: at 0.200 s, r1.motion: twist v=0.3 omega="),
            HasSubstr("first reading that differs: at 0.300 s, r1.laser ranges[0]: "),
            EndsWith("picture: " + (folder / "d.svg") + "\n")));
  const std::string svg = read_bytes(folder / "d.svg");
  EXPECT_THAT(svg, AllOf(HasSubstr(">avoid: r1<"), HasSubstr(">wall: r1<"), HasSubstr(">1 mm<"),
                         HasSubstr(">10 mm<"), HasSubstr(">100 mm<"),
                         HasSubstr("distance between the runs [mm]"),
                         HasSubstr("difference of the headings [degrees]")));
  EXPECT_EQ(diff(folder, "avoid", "wall", {"--out", folder / "d.png"}).status, 1);
  EXPECT_THAT(read_bytes(folder / "d.png"), StartsWith("\x89PNG"));
}

TEST(PlaypenDiff, OtherStartPose_DiffersFromTheFirstRowOn) {
  const TemporaryFolder folder;
  std::string world = read_bytes(PLAYPEN_SOURCE_DIR "/worlds/tasks/par_intro.json");
  const std::string pose = R"("x": 0.5, "y": 0.4)";
  ASSERT_NE(world.find(pose), std::string::npos);
  world.replace(world.find(pose), pose.size(), R"("x": 0.52, "y": 0.4)");
  folder.write("moved.json", world);
  run_program(folder, "par_intro", "one", AVOID_PROGRAM);
  run_program(folder, folder / "moved.json", "moved", AVOID_PROGRAM);
  const ProcessResult result = diff(folder, "one", "moved");
  EXPECT_EQ(result.status, 1) << result.err;
  EXPECT_THAT(result.out,
              AllOf(HasSubstr("conditions that differ:"), HasSubstr("content of the world's file"),
                    HasSubstr("moved.json"),
                    HasSubstr("first difference: at 0.000 s, r1, x: 0.500000 m in run 1, "
                              "0.520000 m in run 2")));
}

// --- Results that no run has made

std::string report(const std::string& path_m = "1.0") {
  return R"({"run": {"world": "small", "world_file": "none.json", "sim_time": 0.2},
    "robots": [{"name": "r1", "path_length": )" +
         path_m + R"(, "collisions": 0, "least_clearance": null, "stalled_time": 0}]})";
}

void write_run(const TemporaryFolder& folder, const std::string& name, const std::string& rows) {
  folder.write(name + "/trajectory.csv", kHeader + rows);
  folder.write(name + "/report.json", report());
}

TEST(PlaypenDiff, RunsOfGrades_MatchedByName) {
  const TemporaryFolder folder;
  const std::string still = "0.0,r1,0,0,0,0,0,0\n0.1,r1,0,0,0,0,0,0\n";
  const std::string moved = "0.0,r1,0,0,0,0,0,0\n0.1,r1,0.1,0,0,1,0,0\n";
  for (const char* const name : {"a/s_seed1", "a/s_seed2", "b/s_seed1"}) {
    write_run(folder, name, still);
  }
  write_run(folder, "b/s_seed2", moved);
  write_run(folder, "b/s_seed3", moved);
  folder.write("a/grade.json", R"({"runs": [{"folder": "s_seed1"},
    {"folder": "s_seed2", "passed": false, "faults": ["too short a path"]}]})");
  folder.write("b/grade.json", R"({"runs": [{"folder": "s_seed1"},
    {"folder": "s_seed2", "passed": true, "faults": []}, {"folder": "s_seed3"}]})");
  const ProcessResult result = diff(folder, "a", "b", {"--out", folder / "d.svg"});
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.out, AllOf(HasSubstr("The runs are equal: all 2 rows"),
                                HasSubstr("first difference: at 0.100 s, r1, x"),
                                HasSubstr("run 1 failed: too short a path\n"),
                                HasSubstr("1 of 2 pairs of runs differ")));
  EXPECT_THAT(result.err, AllOf(HasSubstr("left out"), HasSubstr("b/s_seed3")));
  // The picture shows the runs that differ. Their folders have the same name.
  EXPECT_THAT(read_bytes(folder / "d.svg"),
              AllOf(HasSubstr(">a/s_seed2: r1<"), HasSubstr(">b/s_seed2: r1<")));
  EXPECT_EQ(diff(folder, "a", "b/s_seed1").status, 0) << "matched by the name of the run";
  write_run(folder, "c", still);
  const ProcessResult unmatched = diff(folder, "a", "c");
  EXPECT_EQ(unmatched.status, 2);
  EXPECT_THAT(unmatched.err, HasSubstr("expected runs of the same name"));
}

TEST(PlaypenDiff, HugeNumbers_ComparedAndDrawn) {
  const TemporaryFolder folder;
  write_run(folder, "one", "0.0,r1,0,0,0,0,0,0\n0.1,r1,1e300,-1e300,1e300,1e300,-1e300,0\n");
  write_run(folder, "two", "0.0,r1,0,0,0,0,0,0\n0.1,r1,-1e300,1.7e308,-9e99,0,0,0\n");
  const ProcessResult result = diff(folder, "one", "two", {"--out", folder / "d.png"});
  EXPECT_EQ(result.status, 1) << result.err;
  EXPECT_THAT(result.err, HasSubstr("no arena in the picture"));
  EXPECT_THAT(read_bytes(folder / "d.png"), StartsWith("\x89PNG"));
}

TEST(PlaypenDiff, BadInput_ErrorNamesCause) {
  const TemporaryFolder folder;
  write_run(folder, "one", "0.0,r1,0,0,0,0,0,0\n");
  folder.write("bad/report.json", report());
  const auto complaint = [&](const std::string& second) {
    const ProcessResult result = diff(folder, "one", second);
    EXPECT_EQ(result.status, 2) << result.out;
    return result.err;
  };
  EXPECT_THAT(complaint("none"), AllOf(HasSubstr("found no folder"), HasSubstr("none")));
  EXPECT_THAT(complaint("bad"), HasSubstr("found no trajectory.csv in"));
  const std::string header = kHeader;
  for (const auto& [rows, found] : std::vector<std::pair<std::string, std::string>>{
           {"", "found none"},
           {"time,robot,x\n0,r1,0\n", "line 1"},
           {header + "0,r1,nan,0,0,0,0,0\n", "line 2"}}) {
    folder.write("bad/trajectory.csv", rows);
    EXPECT_THAT(complaint("bad"), AllOf(HasSubstr("trajectory.csv"), HasSubstr(found))) << rows;
  }
  write_run(folder, "bad", "0.0,r1,0,0,0,0,0,0\n");
  folder.write("bad/report.json", R"({"run": {"world": "small", "sim_time": "long"}})");
  EXPECT_THAT(complaint("bad"), AllOf(HasSubstr("report.json"), HasSubstr("expected the report")));
  EXPECT_EQ(playpen({"diff", folder / "one"}).status, 2);
  EXPECT_EQ(diff(folder, "one", "one", {"--out", "a.gif"}).status, 2);
  EXPECT_EQ(diff(folder, "one", "one", {"--out", folder / "no/d.png"}).status, 2);
}

}  // namespace
