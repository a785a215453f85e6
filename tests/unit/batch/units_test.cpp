// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "batch/units.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "batch/batch_results.h"
#include "batch/group_charts.h"
#include "batch/unit_runs.h"
#include "grade/run_record.h"
#include "grade/text.h"
#include "sim/core/error.h"
#include "sim/simulation/simulation.h"
#include "temporary_folder.h"

namespace playpen::batch {
namespace {

namespace fs = std::filesystem;
using test_support::TemporaryFolder;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::SizeIs;
using testing::StartsWith;

std::string text_of(const fs::path& file) {
  std::ifstream stream(file);
  return {std::istreambuf_iterator<char>(stream), {}};
}

class BatchUnits : public testing::Test {
 protected:
  BatchUnits() {
    grade::write_text_file(world(), R"({"name": "a", "arena": {"size": [4, 4]}, "robots": [
        {"name": "r1", "pose": {"x": 1, "y": 1}}]})");
    grade::write_text_file(program(), "one");
    plan.programs = {{"robot", {program(), "--fast"}}};
    plan.worlds = {world()};
    plan.seeds = {1, 2};
    settings.version = "1.0";
    settings.out = folder.path() / "out";
  }

  [[nodiscard]] std::string world() const { return (folder.path() / "a.json").string(); }
  [[nodiscard]] std::string program() const { return (folder.path() / "robot").string(); }
  [[nodiscard]] Batch made() const { return make_batch(plan, settings); }
  [[nodiscard]] std::string first_id() const { return made().units.front().id; }

  /// Gives a unit a result, as a process on some machine does.
  void give_result(const Unit& unit, double path_length_m,
                   const std::vector<std::string>& faults = {}) const {
    grade::GradedRun run;
    run.world = "a-0123";
    run.robot = "r1";
    run.seed = unit.seed;
    run.folder = "a-0123_seed";
    run.ending = grade::Ending::kTimeOver;
    run.measures.path_length_m = path_length_m;
    run.faults = faults;
    run.wall_time_s = 0.5;
    grade::write_text_file(folder_of(settings.out, unit) / "unit.json", grade::run_text(run));
  }

  TemporaryFolder folder;
  Plan plan;
  BatchSettings settings;
};

TEST_F(BatchUnits, Parameters_ChangeTheWorlds) {
  plan.parameters = {{"/robots/0/pose/x", {"1", "2"}}, {"/robots/0/pose/yaw_deg", {"0", "90"}}};
  const Batch batch = made();
  EXPECT_THAT(batch.conditions, SizeIs(4));
  EXPECT_THAT(batch.units, SizeIs(8));
  EXPECT_THAT(batch.conditions[1].values, ElementsAre("1", "90"));
  const sim::WorldDescription last = sim::load_world(batch.conditions[3].file);
  EXPECT_EQ(last.robots[0].pose.x_m, 2.0);
  EXPECT_EQ(last.robots[0].pose.y_m, 1.0);
  EXPECT_EQ(batch.conditions[3].world, "a");
  std::set<std::string> ids;
  for (const Unit& unit : batch.units) ids.insert(unit.id);
  EXPECT_THAT(ids, SizeIs(8));
}

TEST_F(BatchUnits, Parameters_ThatLeadNowhere_AreErrors) {
  const auto error_of = [&](const std::string& pointer, const std::string& value) -> std::string {
    plan.parameters = {{pointer, {value}}};
    try {
      static_cast<void>(made());
    } catch (const sim::ConfigError& error) {
      return error.what();
    }
    return "no error";
  };
  EXPECT_THAT(error_of("/robots/1/pose/x", "1"),
              AllOf(HasSubstr(world()), HasSubstr("/robots/1/pose/x"),
                    HasSubstr("a list of 1 before '1'"), HasSubstr("[plan/parameter]")));
  EXPECT_THAT(error_of("/robots/-/pose", "1"), HasSubstr("[plan/parameter]"));
  EXPECT_THAT(error_of("/name/0", "1"), HasSubstr("neither an object nor a list before '0'"));
  EXPECT_THAT(error_of("/robots/0/pose/z", "1"), HasSubstr("/robots/0/pose/z"));
  EXPECT_THAT(error_of("/robots/0/pose/x", "100"), HasSubstr("/robots/0"));
  EXPECT_EQ(error_of("/simulation/duration", "30"), "no error") << "a new member";
}

TEST_F(BatchUnits, Ids_ChangeWithWhatMattersOnly) {
  const std::string before = first_id();
  plan.timeout_s = 3.0;
  plan.programs[0].name = "other";
  plan.seeds = {1};
  EXPECT_EQ(first_id(), before);
  const auto expect_other = [&](const char* what) { EXPECT_NE(first_id(), before) << what; };
  plan.seeds = {2};
  expect_other("seed");
  plan.seeds = {1};
  plan.duration_s = 5.0;
  expect_other("duration");
  plan.duration_s.reset();
  plan.programs[0].command[1] = "--slow";
  expect_other("arguments");
  plan.programs[0].command[1] = "--fast";
  settings.version = "1.1";
  expect_other("version");
  settings.version = "1.0";
  EXPECT_EQ(first_id(), before);
  grade::write_text_file(program(), "two");
  expect_other("program");
  grade::write_text_file(program(), "one");
  grade::write_text_file(world(), R"({"name": "a", "arena": {"size": [5, 4]}, "robots": [
      {"name": "r1", "pose": {"x": 1, "y": 1}}]})");
  expect_other("world");
}

TEST_F(BatchUnits, File_GivesTheSameBatch) {
  plan.parameters = {{"/robots/0/pose/x", {"1", "1.5"}}};
  plan.duration_s = 7.5;
  plan.realism = sim::Realism::kReal;
  settings.readable = {"/data"};
  const Batch batch = made();
  write_batch(batch, settings.out);
  const std::string text = text_of(settings.out / "units.json");
  write_batch(read_batch(settings.out), settings.out);
  EXPECT_EQ(text_of(settings.out / "units.json"), text);
  EXPECT_EQ(read_batch(settings.out).units.size(), 4U);
}

TEST_F(BatchUnits, File_BadOnes_AreErrors) {
  const auto error_of = [&](const std::string& text) -> std::string {
    grade::write_text_file(settings.out / "units.json", text);
    try {
      static_cast<void>(read_batch(settings.out));
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "no error";
  };
  EXPECT_THROW(static_cast<void>(read_batch(settings.out)), std::runtime_error) << "missing";
  write_batch(made(), settings.out);
  const std::string good = text_of(settings.out / "units.json");
  EXPECT_EQ(error_of(good), "no error");
  EXPECT_THAT(error_of(good.substr(0, good.size() / 2)), HasSubstr("units.json"));
  EXPECT_THAT(error_of("{}"), HasSubstr("is not one that playpen batch has written"));
  const std::string id = made().units.front().id;
  std::string other = good;
  other.replace(other.find(id), id.size(), "../../../../etc/");
  EXPECT_THAT(error_of(other), HasSubstr("a unit")) << "ids are names of folders";
}

TEST_F(BatchUnits, Results_CountEachUnitOnce) {
  plan.parameters = {{"/robots/0/pose/x", {"1", "1.5"}}};
  const Batch batch = made();
  give_result(batch.units[0], 2.0);
  give_result(batch.units[1], 4.0, {"it failed, \"badly\""});
  give_result(batch.units[2], 5.0);
  const BatchResult result = collect(batch, settings.out);
  EXPECT_EQ(result.ended(), 3U);
  EXPECT_EQ(result.passed(), 2U);
  const std::vector<GroupSummary> groups = summarize(result);
  ASSERT_THAT(groups, SizeIs(2));
  EXPECT_EQ(groups[0].ended, 2U);
  EXPECT_EQ(groups[1].units, 2U);
  EXPECT_EQ(groups[1].ended, 1U);
  EXPECT_EQ(groups[0].figures.at(0).name, "passed");
  EXPECT_EQ(groups[0].figures.at(0).summary.mean, 0.5);
  EXPECT_EQ(groups[0].figures.at(1).name, "path_length");
  EXPECT_EQ(groups[0].figures.at(1).summary.mean, 3.0);
  const Chart chart = chart_of(batch, groups, "path_length");
  EXPECT_EQ(chart.x_name, "/robots/0/pose/x");
  ASSERT_THAT(chart.series, SizeIs(1));
  EXPECT_EQ(chart.series[0].points.at(1).x, 1.5);
  EXPECT_EQ(chart.series[0].points.at(1).value, 5.0);

  write_results(result, groups, settings.out);
  const std::string csv = text_of(settings.out / "results.csv");
  EXPECT_THAT(csv, AllOf(StartsWith("unit,program,world,/robots/0/pose/x,seed,passed,end,faults,"),
                         HasSubstr(batch.units[1].id + ",robot,a,1,2,no,time-over,"
                                                       "\"it failed, \"\"badly\"\"\","),
                         HasSubstr(batch.units[3].id + ",robot,a,1.5,2,,missing,,")));
  EXPECT_THAT(text_of(settings.out / "statistics.csv"),
              HasSubstr("robot,a,1,path_length,m,2,3,1.4142135623730951,2,3,4,"));
  EXPECT_THAT(text_of(settings.out / "batch.json"),
              AllOf(HasSubstr("\"complete\": false"), HasSubstr("\"missing\": true"),
                    HasSubstr("units/" + batch.units[0].id)));
  EXPECT_TRUE(fs::exists(settings.out / "charts/path_length.png"));
  EXPECT_THAT(batch_table(result, groups, 80),
              AllOf(HasSubstr("program  x    passed  path [m]"),
                    HasSubstr("robot    1    1 of 2      3.00"), HasSubstr("4 runs, 3 ended")));
  EXPECT_THAT(batch_table(result, groups, 20),
              AllOf(HasSubstr("program  x"), Not(HasSubstr("path"))));
}

TEST_F(BatchUnits, BrokenRecord_IsNoResult) {
  const Batch batch = made();
  give_result(batch.units[0], 2.0);
  grade::write_text_file(folder_of(settings.out, batch.units[0]) / "unit.json", "{\"world\": ");
  EXPECT_FALSE(read_unit(settings.out, batch.units[0]));
  give_result(batch.units[0], 2.0);
  EXPECT_TRUE(read_unit(settings.out, batch.units[0]));
  forget_unit(settings.out, batch.units[0]);
  EXPECT_FALSE(fs::exists(folder_of(settings.out, batch.units[0])));
}

}  // namespace
}  // namespace playpen::batch
