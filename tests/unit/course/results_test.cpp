// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "course/results.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace playpen;
using namespace playpen::course;
using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

grade::GradedRun run_with(std::uint64_t seed, std::vector<std::string> faults) {
  grade::GradedRun run;
  run.world = "maze";
  run.seed = seed;
  run.folder = "maze_seed" + std::to_string(seed);
  run.ending = grade::Ending::kTimeOver;
  run.faults = std::move(faults);
  run.wall_time_s = 0.5;
  return run;
}

/// A class of three: one has passed once, one does not compile, one has handed in nothing.
ClassResult small_class() {
  ClassResult result;
  grade::Task task;
  task.name = "maze";
  result.tasks = {task};
  SubmissionResult ada;
  ada.id = "ada";
  ada.name = "Byron, \"Ada\"";
  ada.folder = "submissions/ada";
  ada.build = {true, "", "build/source/robot", "build.log", 2.0};
  ada.grades = {{task, {"robot"}, {}, true}};
  ada.grades.front().runs = {run_with(1, {}), run_with(2, {"3 collisions & <more>", "late"}),
                             run_with(3, {"3 collisions & <more>"})};
  ada.grades.front().runs[1].measures.first_collision =
      grade::Contact{31.42, "block_3", {1.2, 2.049}};
  ada.points = 33.5;
  ada.most_points = 100.0;
  SubmissionResult bob;
  bob.id = "=1+1\x1b[2J";
  bob.name = "B\xff";
  bob.folder = "submissions/bob";
  bob.build.reason = "does not compile";
  SubmissionResult carl;
  carl.id = "carl";
  carl.folder = "submissions/carl";
  carl.handed_in = false;
  carl.build.reason = "nothing was handed in";
  carl.points = 40.0;
  result.submissions = {bob, ada, carl};
  result.pairs = {{0, 1, 3, 2, 0.004, "pairs/0_1.png"}};
  return result;
}

TEST(ClassTable, Rows_BestFirstWithReasons) {
  const std::string table = class_table(small_class(), 64);
  EXPECT_EQ(table,
            "id        name          points  passed  reason\n"
            "carl                      40.0  -       nothing was handed in\n"
            "ada       Byron, \"Ada\"    33.5  1 of 3  3 collisions & <more>...\n"
            "=1+1?[2J  B\\xff            0.0  -       does not compile\n"
            "alike: =1+1?[2J and ada in 2 of 3 runs\n"
            "3 submissions, 1 compiled, 0 passed all runs\n");
}

TEST(ClassTable, ManyPairs_Counted) {
  ClassResult result = small_class();
  result.pairs.assign(25, result.pairs.front());
  EXPECT_THAT(class_table(result, 80), HasSubstr("\nalike: 5 more pairs\n3 submissions"));
}

TEST(ClassCsv, Values_QuotedAndNoFormulas) {
  const std::string csv = csv_text(small_class());
  EXPECT_THAT(csv, HasSubstr("'=1+1?[2J,"));
  EXPECT_THAT(csv, HasSubstr("ada,\"Byron, \"\"Ada\"\"\",33.5,100,1,3,yes,yes,"
                             "3 collisions & <more> (2 of 3 runs),1\r\n"));
  EXPECT_THAT(csv, HasSubstr("carl,,40,0,0,0,no,no,nothing was handed in,0\r\n"));
}

TEST(ClassJson, Members_AsInClass) {
  const json whole = json::parse(json_text(small_class()));
  EXPECT_EQ(whole.at("tasks"), json::array({"maze"}));
  const json& ada = whole.at("submissions").at(1);
  EXPECT_EQ(ada.at("points"), 33.5);
  EXPECT_EQ(ada.at("tasks").at(0).at("runs").at(1).at("faults").at(1), "late");
  EXPECT_EQ(ada.at("build").at("built"), true);
  EXPECT_EQ(whole.at("submissions").at(0).at("build").at("reason"), "does not compile");
  EXPECT_EQ(whole.at("alike").at(0).at("second"), "ada");
}

TEST(ClassJunit, Suites_EscapedAndCounted) {
  const std::string xml = junit_text(small_class());
  EXPECT_THAT(xml, HasSubstr("<testsuites name=\"playpen class\" tests=\"6\" failures=\"2\" "
                             "errors=\"2\" time=\"3.500\">"));
  EXPECT_THAT(xml, HasSubstr("<testsuite name=\"ada\" tests=\"4\" failures=\"2\" errors=\"0\""));
  EXPECT_THAT(xml, HasSubstr("<failure message=\"3 collisions &amp; &lt;more&gt;\">"
                             "3 collisions &amp; &lt;more&gt;; late; "
                             "first hit block_3 at (1.20, 2.05) after 31.4 s</failure>"));
  EXPECT_THAT(xml, HasSubstr("<error message=\"does not compile\">"));
  EXPECT_THAT(xml, Not(HasSubstr("\x1b")));
}

TEST(ReasonsOfRun, FirstContact_ToldOnce) {
  grade::GradedRun run = run_with(1, {"goal not reached"});
  run.measures.first_collision = grade::Contact{31.42, "block_3", {1.2, 2.049}};
  run.measures.first_collision->sight =
      grade::Sight{grade::Sight::State::kShown, "laser", 1.2, {}, 0.31, 0.0, 4.7};
  const std::string told =
      "first hit block_3 at (1.20, 2.05) after 31.4 s; the laser had shown it for 1.2 s, at first "
      "0.31 m ahead";
  EXPECT_THAT(reasons_of(run), ElementsAre("goal not reached", told));
  const std::string fault = "collisions 1, at most 0 allowed: " + told;
  run.faults = {fault, "goal not reached"};
  EXPECT_THAT(reasons_of(run), ElementsAre(fault, "goal not reached"));
}

TEST(Gradescope, Members_Documented) {
  const json result = json::parse(gradescope_text(small_class().submissions[1]));
  EXPECT_EQ(result.at("score"), 33.5);
  EXPECT_EQ(result.at("execution_time"), 3.5);
  EXPECT_EQ(result.at("output"), "3 collisions & <more> (2 of 3 runs)");
  std::vector<std::string> statuses;
  for (const json& test : result.at("tests")) statuses.push_back(test.at("status"));
  EXPECT_THAT(statuses, ElementsAre("passed", "passed", "failed", "failed"));
  EXPECT_DOUBLE_EQ(result.at("tests").at(1).at("score"), 100.0 / 3);
  EXPECT_DOUBLE_EQ(result.at("tests").at(2).at("max_score"), 100.0 / 3);
  EXPECT_EQ(result.at("tests").at(2).at("score"), 0.0);
  EXPECT_EQ(result.at("tests").at(2).at("output"),
            "3 collisions & <more>; late; first hit block_3 at (1.20, 2.05) after 31.4 s");
}

}  // namespace
