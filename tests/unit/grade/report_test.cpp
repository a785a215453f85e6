// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "grade/report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "grade/grade.h"
#include "grade/text.h"
#include "sim/core/error.h"
#include "temporary_folder.h"

namespace playpen::grade {
namespace {

using nlohmann::json;
using test_support::TemporaryFolder;
using testing::HasSubstr;

GradedRun good_run() {
  GradedRun run;
  run.world = "room";
  run.seed = 1;
  run.folder = "room_seed1";
  run.robot = "r1";
  run.goal = Goal{{1.0, 2.0}, std::nullopt};
  run.ending = Ending::kBySelf;
  run.wall_time_s = 0.25;
  run.measures.reached = true;
  run.measures.goal_distance_m = 0.05;
  run.measures.coverage = 0.9876;
  run.measures.correctness = 1.0;
  run.measures.path_length_m = 12.345;
  run.measures.shortest_path_m = 10.0;
  run.measures.path_ratio = 1.2345;
  run.measures.collisions = 0;
  run.measures.least_clearance_m = 0.0321;
  run.measures.stalled_time_s = 0.0;
  run.measures.sim_time_s = 61.04;
  return run;
}

GradedRun crashed_run() {
  GradedRun run;
  run.world = "long_room";
  run.seed = 12;
  run.folder = "long_room_seed12";
  run.ending = Ending::kSignal;
  run.signal = SIGSEGV;
  run.wall_time_s = 1.5;
  run.faults = {"the program was ended by signal 11 (Segmentation fault)"};
  return run;
}

Grade grade_of(std::vector<GradedRun> runs) {
  Grade grade;
  grade.task.name = "explore";
  grade.program = {"./robot", "--fast"};
  grade.runs = std::move(runs);
  return grade;
}

TEST(Table, HasLinePerRunThenFaultsThenSummary) {
  EXPECT_EQ(table(grade_of({good_run(), crashed_run()}), {.columns = 200}),
            "world      seed        end        goal  cover  correct   path  ratio  coll  clear  "
            " sim  wall\n"
            "room          1  pass  by itself   yes  0.988    1.000  12.35   1.23     0  0.032  "
            "61.0   0.2\n"
            "long_room    12  FAIL  signal 11     -      -        -      -      -     -      -  "
            "   -   1.5\n"
            "long_room seed 12: the program was ended by signal 11 (Segmentation fault)\n"
            "explore: 1 of 2 runs passed\n"
            "  coverage: 0.988 to 0.988, mean 0.988\n"
            "  map correctness: 1.000 to 1.000, mean 1.000\n"
            "  path ratio: 1.23 to 1.23, mean 1.23\n"
            "  path [m]: 12.35 to 12.35, mean 12.35\n"
            "  least clearance [m]: 0.032 to 0.032, mean 0.032\n"
            "  simulated time [s]: 61.0 to 61.0, mean 61.0\n");
}

TEST(Table, CommonFaults_PrintedOnce) {
  const auto failed = [](std::uint64_t seed, std::vector<std::string> faults) {
    GradedRun run = good_run();
    run.seed = seed;
    run.faults = std::move(faults);
    return run;
  };
  GradedRun other_world = failed(1, {"late"});
  other_world.world = "hall";
  const std::string text =
      table(grade_of({failed(1, {"hit", "late"}), failed(2, {"late"}), failed(3, {"late", "hit"}),
                      failed(4, {}), failed(5, {"hit", "only here"}), other_world}),
            {.columns = 200});
  EXPECT_THAT(text, HasSubstr("\nroom seeds 1, 3 and 5: hit\n"
                              "room seeds 1 to 3: late\n"
                              "room seed 5: only here\n"
                              "hall seed 1: late\n"
                              "explore: 1 of 6 runs passed\n"));
}

TEST(Table, Advice_PrintedOncePerKindOfEnd) {
  GradedRun hit = good_run();
  hit.faults = {"hit"};
  GradedRun again = hit;
  again.seed = 2;
  GradedRun crashed = crashed_run();
  crashed.world = "room";
  TableStyle style{.columns = 200};
  style.advice = [](const GradedRun& run) {
    return std::vector<std::string>{"look at seed " + std::to_string(run.seed)};
  };
  const std::string text = table(grade_of({hit, again, crashed, good_run()}), style);
  EXPECT_THAT(text, HasSubstr("room seeds 1 and 2: hit\n"
                              "room seed 12: the program was ended by signal 11 (Segmentation "
                              "fault)\n"
                              "  look at seed 1\n"
                              "  look at seed 12\n"
                              "explore: "));
}

TEST(JsonText, HasFirstCollisionAndRefusals) {
  GradedRun run = good_run();
  run.measures.first_collision = Contact{10.5, "border", {1.25, 3.5}};
  run.measures.first_collision->sight =
      Sight{Sight::State::kOutside, "laser", 0.0, 2.5, 0.25, -1.5, 4.5};
  run.measures.commanded = {"a"};
  run.measures.refused = {{0.5, "the map of the world"}};
  const json whole = json::parse(json_text(grade_of({run}))).at("runs").at(0);
  EXPECT_EQ(whole.at("first_collision"), json({{"time", 10.5},
                                               {"with", "border"},
                                               {"x", 1.25},
                                               {"y", 3.5},
                                               {"sight",
                                                {{"state", "outside"},
                                                 {"sensor", "laser"},
                                                 {"shown_for", 0.0},
                                                 {"last_shown", 2.5},
                                                 {"distance", 0.25},
                                                 {"bearing", -1.5},
                                                 {"field_of_view", 4.5}}}}));
  EXPECT_EQ(whole.at("commanded"), json({"a"}));
  EXPECT_EQ(whole.at("refused"), json({{{"time", 0.5}, {"what", "the map of the world"}}}));
}

TEST(Table, OneRun_HasNoSummary) {
  EXPECT_EQ(table(grade_of({good_run()}), {.columns = 200}),
            "world  seed        end        goal  cover  correct   path  ratio  coll  clear   sim  "
            "wall\n"
            "room      1  pass  by itself   yes  0.988    1.000  12.35   1.23     0  0.032  61.0  "
            " 0.2\n"
            "explore: 1 of 1 runs passed\n");
}

/// The lines of a table of runs, without the text below.
std::vector<std::string> rows_of(const std::vector<GradedRun>& runs, const TableStyle& style) {
  std::istringstream lines(table(grade_of(runs), style));
  std::vector<std::string> rows;
  for (std::string line; std::getline(lines, line) && !line.starts_with("explore: ");) {
    rows.push_back(line);
  }
  return rows;
}

TEST(Table, UnmeasuredColumn_Omitted) {
  GradedRun run = good_run();
  run.measures.reached.reset();
  run.measures.coverage.reset();
  run.measures.correctness.reset();
  run.measures.path_ratio.reset();
  EXPECT_THAT(rows_of({run}, {}),
              testing::ElementsAre("world  seed        end         path  coll  clear   sim  wall",
                                   "room      1  pass  by itself  12.35     0  0.032  61.0   0.2"));
}

TEST(Table, HasPointsAndVerdict) {
  GradedRun run = good_run();
  run.measures.reached.reset();
  run.measures.coverage.reset();
  run.measures.correctness.reset();
  run.measures.path_ratio.reset();
  run.measures.score = -3.0;
  run.ending = Ending::kVerdict;
  EXPECT_THAT(
      rows_of({run}, {}),
      testing::ElementsAre("world  seed        end      score   path  coll  clear   sim  wall",
                           "room      1  pass  verdict     -3  12.35     0  0.032  61.0   0.2"));
}

TEST(Table, NarrowTerminal_DropsBlanksThenNamesThenColumns) {
  // With all columns, 7 + 4 + 4 + 9 + 4 + 5 + 7 + 5 + 5 + 4 + 5 + 4 + 4 = 67 characters and 12 gaps
  // of one blank: 79.
  GradedRun run = good_run();
  run.world = "kitchen";
  const std::vector<std::string> tight = rows_of({run}, {.columns = 80});
  ASSERT_EQ(tight.size(), 2U);
  EXPECT_EQ(tight[0],
            "world   seed      end       goal cover correct  path ratio coll clear  sim wall");
  EXPECT_EQ(tight[0].size(), 79U);
  // A longer name becomes a heading, once for all runs on that world.
  run.world = "the_kitchen_of_the_house";
  GradedRun second = run;
  second.seed = 2;
  const std::vector<std::string> headed = rows_of({run, second}, {.columns = 80});
  ASSERT_EQ(headed.size(), 4U);
  EXPECT_EQ(headed[1], "the_kitchen_of_the_house:");
  EXPECT_EQ(headed[2], "   1 pass by itself  yes 0.988   1.000 12.35  1.23    0 0.032 61.0  0.2");
  for (const std::size_t columns : {71U, 60U, 50U, 40U, 30U}) {
    const std::vector<std::string> rows = rows_of({run}, {.columns = columns});
    ASSERT_EQ(rows.size(), 3U);
    EXPECT_LE(rows[0].size(), columns);
    EXPECT_LE(rows[2].size(), columns);
    EXPECT_THAT(rows[2], HasSubstr("1 pass by itself"));
  }
}

TEST(Table, Colours_OnlyIfRequested) {
  const std::string plain = table(grade_of({good_run(), crashed_run()}), {.columns = 80});
  EXPECT_THAT(plain, testing::Not(HasSubstr("\033")));
  std::string coloured = table(grade_of({good_run(), crashed_run()}), {80, true});
  EXPECT_THAT(coloured, HasSubstr("\033[32mpass\033[0m"));
  EXPECT_THAT(coloured, HasSubstr("\033[1;31mFAIL\033[0m"));
  // Without the colours it is the same table.
  EXPECT_EQ(std::regex_replace(coloured, std::regex("\033\\[[0-9;]*m"), ""), plain);
}

TEST(Table, Endings_InWords) {
  GradedRun run = good_run();
  const auto text_for = [&run](Ending ending) {
    run.ending = ending;
    run.status = 3;
    return table(grade_of({run}), {.columns = 200});
  };
  EXPECT_THAT(text_for(Ending::kTimeOver), HasSubstr("  time over  "));
  EXPECT_THAT(text_for(Ending::kBadStatus), HasSubstr("  status 3  "));
  EXPECT_THAT(text_for(Ending::kTimedOut), HasSubstr("  timeout  "));
  EXPECT_THAT(text_for(Ending::kInterrupted), HasSubstr("  interrupted  "));
  EXPECT_THAT(text_for(Ending::kNotRun), HasSubstr("  not run  "));
}

TEST(JsonText, HasAllMeasuresAndNulls) {
  const json whole = json::parse(json_text(grade_of({good_run(), crashed_run()})));
  EXPECT_EQ(whole.at("task"), "explore");
  EXPECT_EQ(whole.at("program"), json({"./robot", "--fast"}));
  EXPECT_EQ(whole.at("passed"), false);
  EXPECT_EQ(whole.at("summary").at("runs"), 2);
  EXPECT_EQ(whole.at("summary").at("passed"), 1);
  EXPECT_EQ(whole.at("summary").at("failed"), 1);
  EXPECT_EQ(whole.at("summary").at("coverage"),
            json({{"min", 0.9876}, {"mean", 0.9876}, {"max", 0.9876}}));
  const json expected = {{"world", "room"},
                         {"seed", 1},
                         {"folder", "room_seed1"},
                         {"passed", true},
                         {"faults", json::array()},
                         {"end", {{"kind", "by-itself"}}},
                         {"robot", "r1"},
                         {"goal", {{"x", 1.0}, {"y", 2.0}, {"tolerance", 0.1}}},
                         {"reached", true},
                         {"goal_distance", 0.05},
                         {"coverage", 0.9876},
                         {"correctness", 1.0},
                         {"drawn", nullptr},
                         {"seen", nullptr},
                         {"path_length", 12.345},
                         {"shortest_path", 10.0},
                         {"distance", nullptr},
                         {"visited_area", nullptr},
                         {"path_ratio", 1.2345},
                         {"collisions", 0},
                         {"first_collision", nullptr},
                         {"commanded", json::array()},
                         {"refused", json::array()},
                         {"least_clearance", 0.0321},
                         {"stalled_time", 0.0},
                         {"sim_time", 61.04},
                         {"score", nullptr},
                         {"verdict", nullptr},
                         {"verdict_reason", nullptr},
                         {"wall_time", 0.25}};
  EXPECT_EQ(whole.at("runs").at(0), expected);
  const json& crashed = whole.at("runs").at(1);
  EXPECT_EQ(crashed.at("end"), json({{"kind", "signal"}, {"signal", 11}}));
  EXPECT_EQ(crashed.at("faults").size(), 1U);

  GradedRun failed = good_run();
  failed.ending = Ending::kVerdict;
  failed.measures.score = -2.5;
  failed.measures.verdict = false;
  failed.measures.verdict_reason = "caught";
  const json run = json::parse(json_text(grade_of({failed}))).at("runs").at(0);
  EXPECT_EQ(run.at("end"), json({{"kind", "verdict"}}));
  EXPECT_EQ(run.at("score"), -2.5);
  EXPECT_EQ(run.at("verdict"), "failed");
  EXPECT_EQ(run.at("verdict_reason"), "caught");
  for (const char* key : {"reached", "coverage", "path_ratio", "collisions", "sim_time"}) {
    EXPECT_TRUE(crashed.at(key).is_null()) << key;
  }
}

TEST(JsonText, Summary_CoversRunsWithMeasure) {
  GradedRun other = good_run();
  other.measures.coverage = 0.5;
  GradedRun none = crashed_run();
  const json whole = json::parse(json_text(grade_of({good_run(), none, other})));
  const json& coverage = whole.at("summary").at("coverage");
  EXPECT_DOUBLE_EQ(coverage.at("min").get<double>(), 0.5);
  EXPECT_DOUBLE_EQ(coverage.at("max").get<double>(), 0.9876);
  EXPECT_DOUBLE_EQ(coverage.at("mean").get<double>(), (0.5 + 0.9876) / 2.0);
  const json failed = json::parse(json_text(grade_of({none})));
  EXPECT_TRUE(failed.at("summary").at("coverage").is_null());
}

TEST(JsonText, InvalidUtf8Arguments_Accepted) {
  Grade grade = grade_of({good_run()});
  grade.program = {"./robot", "\xff"};
  EXPECT_EQ(json::parse(json_text(grade)).at("program").at(1), "\xef\xbf\xbd");  // U+FFFD
}

TEST(ShellWord, QuotedOnlyIfNeeded) {
  EXPECT_EQ(shell_word("/a/b-c_1.json"), "/a/b-c_1.json");
  EXPECT_EQ(shell_word("my robot"), "'my robot'");
  EXPECT_EQ(shell_word("it's"), "'it'\\''s'");
  EXPECT_EQ(shell_word(""), "''");
}

TEST(CsvValue, QuotedAndNoFormula) {
  EXPECT_EQ(csv_value("plain"), "plain");
  EXPECT_EQ(csv_value("a,\"b\""), "\"a,\"\"b\"\"\"");
  EXPECT_EQ(csv_value("=1+1"), "'=1+1");
  EXPECT_EQ(csv_value("a\nb"), "a?b");
}

TEST(NumberText, NearLimit_HasEnoughDigits) {
  EXPECT_EQ(telling_number(0.5, 0.98, 3), "0.500");
  EXPECT_EQ(telling_number(0.97996, 0.98, 3), "0.97996");
  EXPECT_EQ(telling_number(0.98, 0.98, 3), "0.980");
}

TEST(ChooseWorlds, TaskSettings_Kept) {
  const TemporaryFolder folder;
  const std::string a = folder.write("a.json", "{}");
  const std::string b = folder.write("b.json", "{}");
  Task task;
  task.worlds = {{a, {"--for-a"}, Goal{{1, 2}, std::nullopt}}, {folder / "c.json", {}, {}}};
  choose_worlds(task, {b, folder / "./a.json", ""});
  ASSERT_EQ(task.worlds.size(), 3U);
  EXPECT_EQ(task.worlds[0].file, b);
  EXPECT_TRUE(task.worlds[0].arguments.empty());
  EXPECT_FALSE(task.worlds[0].goal);
  EXPECT_THAT(task.worlds[1].arguments, testing::ElementsAre("--for-a"));
  EXPECT_TRUE(task.worlds[1].goal);
  EXPECT_EQ(task.worlds[2].file, "");
}

TEST(ChooseWorlds, DuplicateNames_Refused) {
  Task task;
  try {
    choose_worlds(task, {"x/room.json", "y/room.json"});
    FAIL() << "accepted";
  } catch (const sim::ConfigError& error) {
    EXPECT_EQ(error.issues().front().id, "task/duplicate-world");
  }
}

}  // namespace
}  // namespace playpen::grade
