// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Runs the command `playpen plot`.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstddef>
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
using test_support::TemporaryFolder;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

constexpr const char* kWorld = R"({"name": "small", "arena": {"size": [2, 1]},
  "robots": [{"name": "r1", "pose": {"x": 0.5, "y": 0.5}}]})";
constexpr const char* kRows =
    "time,robot,x,y,yaw,v,omega,stalled\n"
    "0.000,r1,0.500000,0.500000,0.000000,0.000000,0.000000,0\n"
    "0.100,r1,0.550000,0.500000,0.000000,0.500000,0.000000,0\n"
    "0.200,r1,0.600000,0.500000,0.000000,0.500000,-1.000000,0\n";

std::string report(const std::string& world_file, const std::string& world = "small") {
  return R"({"run": {"world": ")" + world + R"(", "world_file": ")" + world_file +
         R"(", "sim_time": 0.2}, "robots": [],
    "collisions": [{"time": 0.2, "robot": "r1", "with": "border", "x": 1.9, "y": 0.5}],
    "goals": [{"time": 0.0, "robot": "r1", "x": 1.5, "y": 0.5, "reached": null}]})";
}

void write_run(const TemporaryFolder& folder, const std::string& name) {
  folder.write("small.json", kWorld);
  folder.write(name + "/trajectory.csv", kRows);
  folder.write(name + "/report.json", report(folder / "small.json"));
}

ProcessResult plot(const TemporaryFolder& folder, const std::vector<std::string>& runs,
                   const std::string& file) {
  std::vector<std::string> call = {"plot"};
  for (const std::string& run : runs) call.push_back(folder / run);
  call.insert(call.end(), {"--out", folder / file});
  return playpen(call);
}

TEST(PlaypenPlot, RunOfAClass_HasTheGoalOfItsTask) {
  const TemporaryFolder folder;
  write_run(folder, "ada/task/small_seed1");
  folder.write("ada/records/task/small_seed1.json",
               R"({"key": "0", "value": {"folder": "small_seed1", "robot": "r1",
                   "goal": {"x": 0.6, "y": 0.5, "tolerance": 0.01}}})");
  const ProcessResult result = plot(folder, {"ada/task/small_seed1"}, "a.svg");
  EXPECT_EQ(result.status, 0) << result.err;
  // The other goal is that of the program.
  EXPECT_THAT(read_bytes(folder / "a.svg"), HasSubstr("1 of 2 goals reached"));
  folder.write("ada/records/task/small_seed1.json", "{}");
  EXPECT_THAT(plot(folder, {"ada/task/small_seed1"}, "a.svg").err,
              HasSubstr("small_seed1.json: expected the record of a run"));
}

TEST(PlaypenPlot, UnitOfABatch_HasTheGoalOfItsTask) {
  const TemporaryFolder folder;
  write_run(folder, "units/0123");
  folder.write("units/0123/unit.json", R"({"folder": "small_seed1", "robot": "r1", "passed": true,
    "goal": {"x": 0.6, "y": 0.5, "tolerance": 0.01}})");
  const ProcessResult result = plot(folder, {"units/0123"}, "a.svg");
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(read_bytes(folder / "a.svg"), HasSubstr("1 of 2 goals reached"));
  folder.write("units/0123/unit.json", "[]");
  EXPECT_THAT(plot(folder, {"units/0123"}, "a.svg").err,
              HasSubstr("unit.json: expected the record of a run"));
}

TEST(PlaypenPlot, Run_DrawnAsPngAndSvg) {
  const TemporaryFolder folder;
  write_run(folder, "one");
  const ProcessResult result = plot(folder, {"one"}, "a.png");
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(result.err, "");
  EXPECT_EQ(result.out, "plot: " + (folder / "a.png") + ", of 1 run\n");
  EXPECT_THAT(read_bytes(folder / "a.png"), StartsWith("\x89PNG"));
  ASSERT_EQ(plot(folder, {"one"}, "a.svg").status, 0);
  const std::string svg = read_bytes(folder / "a.svg");
  for (const char* text : {"speed [m/s]", "turn rate [rad/s]", "clearance [m]", "path [m]",
                           "time [s]", ">small<", ">r1<", "1 collision", "0 of 1 goal reached"}) {
    EXPECT_THAT(svg, HasSubstr(text));
  }
  EXPECT_THAT(svg, Not(HasSubstr("not known")));
  EXPECT_THAT(svg, Not(HasSubstr("stroke-dasharray")));
  // Two plots of one run are byte-identical.
  ASSERT_EQ(plot(folder, {"one"}, "b.svg").status, 0);
  EXPECT_EQ(read_bytes(folder / "b.svg"), svg);
}

TEST(PlaypenPlot, SecondRun_DashedAndNamedByFolder) {
  const TemporaryFolder folder;
  write_run(folder, "one");
  write_run(folder, "two");
  ASSERT_EQ(plot(folder, {"one", "two"}, "a.svg").status, 0);
  EXPECT_THAT(read_bytes(folder / "a.svg"),
              AllOf(HasSubstr(">one: r1<"), HasSubstr(">two: r1<"), HasSubstr("stroke-dasharray"),
                    HasSubstr("2 collisions")));
}

TEST(PlaypenPlot, MissingWorld_ReportedAndRestDrawn) {
  const TemporaryFolder folder;
  write_run(folder, "one");
  folder.write("one/report.json", report(folder / "gone.json"));
  const ProcessResult result = plot(folder, {"one"}, "a.svg");
  EXPECT_EQ(result.status, 0);
  EXPECT_THAT(result.err, AllOf(HasSubstr("no clearance and no scene"), HasSubstr("gone.json")));
  EXPECT_THAT(read_bytes(folder / "a.svg"), HasSubstr("not known"));
}

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
    ++count;
  }
  return count;
}

TEST(PlaypenPlot, Charts_MarkCollisionsAndReachedGoals) {
  const TemporaryFolder folder;
  write_run(folder, "one");
  ASSERT_EQ(plot(folder, {"one"}, "a.svg").status, 0);
  const std::string svg = read_bytes(folder / "a.svg");
  // A cross of two red lines on each of four curves, and in the key.
  EXPECT_EQ(count_of(svg, "#e01e37"), 2U * (4U + 1U));
  EXPECT_EQ(count_of(svg, "#1c8a3c"), 0U) << "the goal was not reached";
  std::string reached = report(folder / "small.json");
  reached.replace(reached.find("null"), 4, "0.1");
  folder.write("one/report.json", reached);
  ASSERT_EQ(plot(folder, {"one"}, "a.svg").status, 0);
  EXPECT_EQ(count_of(read_bytes(folder / "a.svg"), "#1c8a3c"), 4U + 1U);
}

TEST(PlaypenPlot, Scenes_OnePerWorld) {
  const TemporaryFolder folder;
  write_run(folder, "one");
  write_run(folder, "again");
  folder.write("large.json", R"({"name": "large", "arena": {"size": [9, 9]},
    "robots": [{"name": "r1", "pose": {"x": 0.5, "y": 0.5}}]})");
  folder.write("two/trajectory.csv", kRows);
  folder.write("two/report.json", report(folder / "large.json", "large"));
  ASSERT_EQ(plot(folder, {"one", "again"}, "a.svg").status, 0);
  EXPECT_EQ(count_of(read_bytes(folder / "a.svg"), "<image"), 1U);
  ASSERT_EQ(plot(folder, {"one", "two", "again"}, "a.svg").status, 0);
  const std::string svg = read_bytes(folder / "a.svg");
  EXPECT_EQ(count_of(svg, "<image"), 2U);
  EXPECT_THAT(svg, AllOf(HasSubstr(">small, large<"), HasSubstr(">small<"), HasSubstr(">large<"),
                         HasSubstr("2 collisions"), HasSubstr("1 collision<")));
}

TEST(PlaypenPlot, GradeFolder_Accepted) {
  const TemporaryFolder folder;
  write_run(folder, "grade/small_seed1");
  write_run(folder, "grade/small_seed2");
  folder.write("grade/grade.json", R"({"runs": [
    {"folder": "small_seed1", "robot": "r1", "goal": {"x": 0.6, "y": 0.5, "tolerance": 0.02}},
    {"folder": "small_seed2", "robot": "r1", "goal": null},
    {"folder": "small_seed3", "robot": "r1", "goal": null}]})");
  const ProcessResult result = plot(folder, {"grade"}, "a.svg");
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("a.svg, of 2 runs\n"));
  EXPECT_THAT(result.err, AllOf(HasSubstr("left out"), HasSubstr("small_seed3")));
  const std::string svg = read_bytes(folder / "a.svg");
  EXPECT_THAT(svg, AllOf(HasSubstr(">small_seed1: r1<"), HasSubstr(">small_seed2: r1<")));
  EXPECT_THAT(svg, HasSubstr("1 of 3 goals reached")) << "two of the reports, one of the task";
  // A single run of a grade knows the goal, too.
  ASSERT_EQ(plot(folder, {"grade/small_seed1/"}, "b.svg").status, 0);
  EXPECT_THAT(read_bytes(folder / "b.svg"), HasSubstr("1 of 2 goals reached"));
  folder.write("grade/grade.json", "[]");
  EXPECT_THAT(plot(folder, {"grade"}, "a.svg").err, HasSubstr("expected the grade of a program"));
}

TEST(PlaypenPlot, InvalidFolder_ErrorNamesCause) {
  const TemporaryFolder folder;
  write_run(folder, "one");
  const auto complaint = [&](const std::string& run) {
    const ProcessResult result = plot(folder, {run}, "a.png");
    EXPECT_EQ(result.status, 2);
    return result.err;
  };
  EXPECT_THAT(complaint("none"), HasSubstr("found no folder"));
  folder.write("empty/notes.txt", "");
  EXPECT_THAT(complaint("empty"),
              AllOf(HasSubstr("found no trajectory.csv in"), HasSubstr("playpen run")));
  folder.write("half/trajectory.csv", kRows);
  EXPECT_THAT(complaint("half"), HasSubstr("found no report.json in"));
  folder.write("half/report.json", "[1]");
  EXPECT_THAT(complaint("half"), HasSubstr("expected the report of a run"));
  const std::string header = "time,robot,x,y,yaw,v,omega,stalled\n";
  for (const auto& [rows, found] : std::vector<std::pair<std::string, std::string>>{
           {"a,b\n", "line 1"},
           {header, "found none"},
           {header + "0,r1,0,0,0,0,0\n", "line 2"},
           {header + "0,r1,0,0,0,0,0,0\n0.1,r1,nan,0,0,0,0,0\n", "line 3"},
           {header + "0.1,r1,0,0,0,0,0,0\n0,r1,0,0,0,0,0,0\n", "line 3"}}) {
    folder.write("one/trajectory.csv", rows);
    EXPECT_THAT(complaint("one"), AllOf(HasSubstr("trajectory.csv"), HasSubstr(found))) << rows;
  }
  EXPECT_EQ(playpen({"plot"}).status, 2);
  EXPECT_EQ(plot(folder, {"one"}, "a.gif").status, 2);
}

}  // namespace
