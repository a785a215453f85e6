// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "grade/task.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <ostream>
#include <set>
#include <string>
#include <vector>

#include "known_keys.h"
#include "sim/core/error.h"
#include "sim/simulation/simulation.h"
#include "temporary_folder.h"

namespace playpen::grade {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test_support::TemporaryFolder;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

/// Tasks in a folder that has the worlds a.json and b.json.
class TaskTest : public testing::Test {
 protected:
  [[nodiscard]] Task read(const std::string& text) const {
    return read_task_text(text, folder_ / "test.task.json");
  }
  [[nodiscard]] std::vector<sim::ConfigIssue> issues_of(const std::string& text) const {
    try {
      static_cast<void>(read(text));
    } catch (const sim::ConfigError& error) {
      return error.issues();
    }
    return {};
  }

  TemporaryFolder folder_;
  std::string a_ = folder_.write("a.json", "{}");
  std::string b_ = folder_.write("b.json", "{}");
};

TEST_F(TaskTest, Minimal_HasDefaults) {
  const Task task = read(R"({"worlds": ["a.json"]})");
  EXPECT_EQ(task.name, "test");
  ASSERT_THAT(task.worlds, SizeIs(1));
  EXPECT_EQ(task.worlds[0].file, a_);
  EXPECT_THAT(task.worlds[0].arguments, IsEmpty());
  EXPECT_THAT(task.seeds, ElementsAre(1, 2, 3, 4, 5));
  EXPECT_FALSE(task.duration_s);
  EXPECT_EQ(task.timeout_s, 120.0);
  EXPECT_THAT(task.arguments, IsEmpty());
  EXPECT_FALSE(task.goal);
  EXPECT_EQ(task.robot, "");
  EXPECT_EQ(task.map_layer, "");
  const Thresholds& t = task.thresholds;
  for (const auto& limit :
       {t.min_coverage, t.min_correctness, t.min_clearance_m, t.min_path_length_m,
        t.max_path_length_m, t.max_path_ratio, t.max_sim_time_s, t.max_stalled_time_s}) {
    EXPECT_FALSE(limit);
  }
  EXPECT_FALSE(t.max_collisions);
  EXPECT_FALSE(t.must_reach);
  EXPECT_FALSE(t.must_end);
  EXPECT_FALSE(t.min_score);
  EXPECT_FALSE(t.must_pass);
}

TEST_F(TaskTest, AllSettings_Read) {
  const Task task = read(R"({
    "$schema": "../schema/task.schema.json",
    "description": "what to do",  // a comment
    "worlds": ["a.json", {"world": "b.json", "arguments": ["--b"], "goal": {"x": 5, "y": 6}}],
    "seeds": [7, 18446744073709551615],
    "duration": 30, "timeout": 2.5,
    "arguments": ["--all", "x y"],
    "goal": {"x": 1, "y": -2, "yaw_deg": 270, "tolerance": 0.2, "yaw_tolerance_deg": 90},
    "robot": "r7", "map": "my map",
    "thresholds": {
      "min_coverage": 0.9, "min_correctness": 0.8, "max_collisions": 3, "min_clearance": 0.01,
      "min_path_length": 1, "max_path_length": 2, "max_path_ratio": 1.5, "max_sim_time": 20,
      "max_stalled_time": 0, "must_reach": true, "must_end": true,
      "min_distance": 12, "min_visited_area": 1.5,
      "min_score": -2.5, "must_pass": true
    },
    "may_use": {"robots": ["r7", "r8"], "devices": ["laser"], "world": ["map", "arena"]}
  })");
  EXPECT_EQ(task.description, "what to do");
  ASSERT_THAT(task.worlds, SizeIs(2));
  EXPECT_EQ(task.worlds[1].file, b_);
  EXPECT_THAT(task.worlds[1].arguments, ElementsAre("--b"));
  ASSERT_TRUE(task.worlds[1].goal);
  EXPECT_EQ(task.worlds[1].goal->position, sim::Vec2(5, 6));
  EXPECT_FALSE(task.worlds[1].goal->yaw_rad);
  EXPECT_EQ(task.worlds[1].goal->tolerance_m, 0.1);
  EXPECT_FALSE(task.worlds[0].goal);
  EXPECT_THAT(task.seeds, ElementsAre(7, 18446744073709551615U));
  EXPECT_EQ(task.duration_s, 30.0);
  EXPECT_EQ(task.timeout_s, 2.5);
  EXPECT_THAT(task.arguments, ElementsAre("--all", "x y"));
  ASSERT_TRUE(task.goal);
  EXPECT_EQ(task.goal->position, sim::Vec2(1, -2));
  ASSERT_TRUE(task.goal->yaw_rad);
  EXPECT_DOUBLE_EQ(*task.goal->yaw_rad, -std::numbers::pi / 2.0);  // 270 degrees
  EXPECT_EQ(task.goal->tolerance_m, 0.2);
  EXPECT_DOUBLE_EQ(task.goal->yaw_tolerance_rad, std::numbers::pi / 2.0);
  EXPECT_EQ(task.robot, "r7");
  EXPECT_EQ(task.map_layer, "my map");
  const Thresholds& t = task.thresholds;
  EXPECT_EQ(t.min_coverage, 0.9);
  EXPECT_EQ(t.min_correctness, 0.8);
  EXPECT_EQ(t.max_collisions, 3);
  EXPECT_EQ(t.min_clearance_m, 0.01);
  EXPECT_EQ(t.min_path_length_m, 1.0);
  EXPECT_EQ(t.max_path_length_m, 2.0);
  EXPECT_EQ(t.max_path_ratio, 1.5);
  EXPECT_EQ(t.max_sim_time_s, 20.0);
  EXPECT_EQ(t.max_stalled_time_s, 0.0);
  EXPECT_TRUE(t.must_reach);
  EXPECT_TRUE(t.must_end);
  EXPECT_EQ(t.min_distance_m, 12.0);
  EXPECT_EQ(t.min_visited_area_m2, 1.5);
  EXPECT_EQ(t.min_score, -2.5);
  EXPECT_TRUE(t.must_pass);
  ASSERT_TRUE(task.may_use);
  EXPECT_THAT(task.may_use->robots, ElementsAre("r7", "r8"));
  EXPECT_EQ(task.may_use->devices, std::vector<std::string>{"laser"});
  EXPECT_THAT(task.may_use->world, ElementsAre("map", "arena"));
}

TEST_F(TaskTest, Seeds_MayBeCount) {
  EXPECT_THAT(read(R"({"worlds": ["a.json"], "seeds": 3})").seeds, ElementsAre(1, 2, 3));
}

TEST_F(TaskTest, File_ResolvesItsPaths) {
  const std::string file = folder_.write("sub/mine.task.json", R"({"worlds": ["../a.json"]})");
  const Task task = read_task(file);
  EXPECT_EQ(task.name, "mine");
  EXPECT_EQ(task.file, file);
  EXPECT_TRUE(fs::equivalent(task.worlds[0].file, a_));
  try {
    static_cast<void>(read_task(folder_ / "none.task.json"));
    FAIL() << "read";
  } catch (const sim::ConfigError& error) {
    EXPECT_EQ(error.issues().front().id, "file/missing");
    EXPECT_EQ(error.issues().front().expected, "a task file");
  }
}

/// An invalid task, and its expected message.
struct BadTask {
  const char* name;
  std::string text;  ///< text beside "worlds", or the whole text if it begins with {
  const char* id;
  const char* pointer;
  const char* expected;
  const char* found;  ///< a part of the whole message
};

void PrintTo(const BadTask& bad, std::ostream* out) { *out << bad.name; }

std::string many_strings(int count) {
  std::string text = "\"x\"";
  for (int i = 1; i < count; ++i) text += ",\"x\"";
  return text;
}

const BadTask kBadTasks[] = {
    {"root_not_object", "{}[]", "json/trailing-garbage", "", "end of the file", "more text"},
    {"root_list", "[]", "world/wrong-type", "", "an object", "an empty list"},
    {"unknown_key", R"("sedes": 3)", "world/unknown-key", "/sedes", "seeds",
     "did you mean \"seeds\"?"},
    {"worlds_missing", "{}", "world/missing-key", "", "\"worlds\"", "none"},
    {"worlds_empty", R"({"worlds": []})", "world/out-of-range", "/worlds", "at least one world",
     "an empty list"},
    {"worlds_no_list", R"({"worlds": "a.json"})", "world/wrong-type", "/worlds", "a list",
     "\"a.json\""},
    {"world_number", R"({"worlds": [3]})", "world/wrong-type", "/worlds/0", "name of a world file",
     "found 3"},
    {"world_not_there", R"({"worlds": ["c.json"]})", "task/unknown-world", "/worlds/0",
     "a world file", "\"c.json\", which is not there"},
    {"world_no_name", R"({"worlds": [""]})", "task/unknown-world", "/worlds/0", "a world file",
     "\"\""},
    {"world_without_world", R"({"worlds": [{}]})", "world/missing-key", "/worlds/0", "\"world\"",
     "none"},
    {"world_unknown_key", R"({"worlds": [{"world": "a.json", "gaol": 1}]})", "world/unknown-key",
     "/worlds/0/gaol", "goal", "did you mean \"goal\"?"},
    {"world_twice", R"({"worlds": ["a.json", "./a.json"]})", "task/duplicate-world", "/worlds/1",
     "names of their own", "\"a\" a second time"},
    {"world_arguments", R"({"worlds": [{"world": "a.json", "arguments": "-x"}]})",
     "world/wrong-type", "/worlds/0/arguments", "a list", "\"-x\""},
    {"world_goal", R"({"worlds": [{"world": "a.json", "goal": {"x": 1}}]})", "world/missing-key",
     "/worlds/0/goal", "\"y\"", "none"},
    {"seeds_text", R"("seeds": "3")", "world/wrong-type", "/seeds", "a list of seeds", "\"3\""},
    {"seeds_zero", R"("seeds": 0)", "world/out-of-range", "/seeds", "from 1 to 10000", "0"},
    {"seeds_fraction", R"("seeds": 1.5)", "world/wrong-type", "/seeds", "a whole number", "1.5"},
    {"seeds_empty", R"("seeds": [])", "world/out-of-range", "/seeds", "at least one seed", "none"},
    {"seed_negative", R"("seeds": [1, -1])", "world/out-of-range", "/seeds/1", "from 0 to",
     "found -1"},
    {"seed_text", R"("seeds": ["1"])", "world/wrong-type", "/seeds/0", "a whole number", "\"1\""},
    {"seed_twice", R"("seeds": [4, 4])", "task/duplicate-seed", "/seeds/1", "each seed once",
     "4 a second time"},
    {"duration_zero", R"("duration": 0)", "world/out-of-range", "/duration", "greater than 0", "0"},
    {"timeout_text", R"("timeout": "1")", "world/wrong-type", "/timeout", "a number", "\"1\""},
    {"arguments_number", R"("arguments": [1])", "world/wrong-type", "/arguments/0",
     "in double quotes", "found 1"},
    {"arguments_many", "\"arguments\": [" + many_strings(10'001) + "]", "world/too-many",
     "/arguments", "at most 10000", "10001"},
    {"goal_list", R"("goal": [1, 2])", "world/wrong-type", "/goal", "an object", "a list of 2"},
    {"goal_x_missing", R"("goal": {"y": 2})", "world/missing-key", "/goal", "\"x\"", "none"},
    {"goal_x_huge", R"("goal": {"x": 1e7, "y": 2})", "world/out-of-range", "/goal/x",
     "from -1000000 to 1000000 m", "1e7"},
    {"goal_tolerance", R"("goal": {"x": 1, "y": 2, "tolerance": 0})", "world/out-of-range",
     "/goal/tolerance", "greater than 0", "0"},
    {"goal_yaw", R"("goal": {"x": 1, "y": 2, "yaw_deg": "up"})", "world/wrong-type",
     "/goal/yaw_deg", "a number", "\"up\""},
    {"goal_yaw_tolerance", R"("goal": {"x": 1, "y": 2, "yaw_tolerance_deg": 181})",
     "world/out-of-range", "/goal/yaw_tolerance_deg", "at most 180 degrees", "181"},
    {"goal_unknown_key", R"("goal": {"x": 1, "y": 2, "yaw": 3})", "world/unknown-key", "/goal/yaw",
     "yaw_deg", "did you mean \"yaw_deg\"?"},
    {"robot_name", R"("robot": "my robot")", "world/bad-name", "/robot", "letters", "my robot"},
    {"map_number", R"("map": 1)", "world/wrong-type", "/map", "a text", "1"},
    {"description_number", R"("description": 1)", "world/wrong-type", "/description", "a text",
     "1"},
    {"thresholds_list", R"("thresholds": [])", "world/wrong-type", "/thresholds", "an object",
     "an empty list"},
    {"thresholds_unknown_key", R"("thresholds": {"max_colisions": 0})", "world/unknown-key",
     "/thresholds/max_colisions", "max_collisions", "did you mean \"max_collisions\"?"},
    {"coverage_percent", R"("map": "m", "thresholds": {"min_coverage": 98})", "world/out-of-range",
     "/thresholds/min_coverage", "from 0 to 1", "98"},
    {"correctness_text", R"("map": "m", "thresholds": {"min_correctness": "all"})",
     "world/wrong-type", "/thresholds/min_correctness", "from 0 to 1", "\"all\""},
    {"collisions_fraction", R"("thresholds": {"max_collisions": 0.5})", "world/wrong-type",
     "/thresholds/max_collisions", "a whole number", "0.5"},
    {"collisions_negative", R"("thresholds": {"max_collisions": -1})", "world/out-of-range",
     "/thresholds/max_collisions", "from 0", "-1"},
    {"clearance_negative", R"("thresholds": {"min_clearance": -1})", "world/out-of-range",
     "/thresholds/min_clearance", "from 0", "-1"},
    {"min_path_text", R"("thresholds": {"min_path_length": "1"})", "world/wrong-type",
     "/thresholds/min_path_length", "a number", "\"1\""},
    {"max_path_negative", R"("thresholds": {"max_path_length": -2})", "world/out-of-range",
     "/thresholds/max_path_length", "from 0", "-2"},
    {"ratio_below_one", R"("goal": {"x": 1, "y": 1}, "thresholds": {"max_path_ratio": 0.9})",
     "world/out-of-range", "/thresholds/max_path_ratio", "from 1", "0.9"},
    {"sim_time_zero", R"("thresholds": {"max_sim_time": 0})", "world/out-of-range",
     "/thresholds/max_sim_time", "greater than 0", "0"},
    {"stalled_negative", R"("thresholds": {"max_stalled_time": -0.1})", "world/out-of-range",
     "/thresholds/max_stalled_time", "at least 0 s", "-0.1"},
    {"must_end_number", R"("thresholds": {"must_end": 1})", "world/wrong-type",
     "/thresholds/must_end", "true or false", "1"},
    {"score_text", R"("thresholds": {"min_score": "5"})", "world/wrong-type",
     "/thresholds/min_score", "a number", "\"5\""},
    {"score_large", R"("thresholds": {"min_score": 1e10})", "world/out-of-range",
     "/thresholds/min_score", "from -1e9", "1e10"},
    {"must_pass_number", R"("thresholds": {"must_pass": 1})", "world/wrong-type",
     "/thresholds/must_pass", "true or false", "1"},
    {"must_reach_text", R"("thresholds": {"must_reach": "yes"})", "world/wrong-type",
     "/thresholds/must_reach", "true or false", "\"yes\""},
    {"coverage_without_map", R"("thresholds": {"min_coverage": 1})", "task/missing-map",
     "/thresholds/min_coverage", "the key \"map\"", "none"},
    {"correctness_without_map", R"("thresholds": {"min_correctness": 1})", "task/missing-map",
     "/thresholds/min_correctness", "the key \"map\"", "none"},
    {"reach_without_goal", R"("thresholds": {"must_reach": true})", "task/missing-goal",
     "/thresholds/must_reach", "a \"goal\"", "none for \"a\""},
    {"ratio_without_goal",
     R"({"worlds": [{"world": "b.json", "goal": {"x": 1, "y": 1}}, "a.json"],
         "thresholds": {"max_path_ratio": 2}})",
     "task/missing-goal", "/thresholds/max_path_ratio", "a \"goal\"", "none for \"a\""},
    {"fuzz_word", R"("fuzz": {"without": ["wals"]})", "world/unknown-value", "/fuzz/without/0",
     "\"maps\"", "\"wals\""},
    {"fuzz_key", R"("fuzz": {"doors": {"widht": [1, 2]}})", "world/unknown-key",
     "/fuzz/doors/widht", "width", "widht"},
    {"schema_number", R"("$schema": 1)", "world/wrong-type", "/$schema", "a text", "1"},
};

class BadTaskTest : public TaskTest, public testing::WithParamInterface<BadTask> {};

TEST_P(BadTaskTest, RefusedWithIdPlaceAndReason) {
  const BadTask& bad = GetParam();
  const bool whole = bad.text.starts_with('{') || bad.text.starts_with('[');
  const auto issues = issues_of(whole ? bad.text : "{\"worlds\": [\"a.json\"], " + bad.text + "}");
  ASSERT_THAT(issues, SizeIs(1));
  const sim::ConfigIssue& issue = issues.front();
  EXPECT_EQ(issue.id, bad.id);
  EXPECT_EQ(issue.pointer, bad.pointer);
  EXPECT_EQ(issue.file, folder_ / "test.task.json");
  EXPECT_EQ(issue.line > 0, true);
  EXPECT_THAT(issue.expected, HasSubstr(bad.expected));
  EXPECT_THAT(issue.message(), HasSubstr(bad.found));
}

INSTANTIATE_TEST_SUITE_P(Faults, BadTaskTest, testing::ValuesIn(kBadTasks),
                         [](const testing::TestParamInfo<BadTask>& bad) {
                           return std::string(bad.param.name);
                         });

TEST_F(TaskTest, SeveralFaults_ReportedTogether) {
  EXPECT_THAT(issues_of(R"({"worlds": ["c.json"], "seeds": -1, "thresholds": {"x": 1}})"),
              SizeIs(3));
}

TEST_F(TaskTest, Fuzz_ReplacesKeysOfWorld) {
  const std::string file = folder_ / "own.task.json";
  std::ofstream(file) << R"({"worlds": ["a.json"], "fuzz": {
    "without": ["moving"], "obstacles": {"most": 2}, "noise": {"latency": [0, 0.1]}}})";
  static_cast<void>(read_task(file));
  sim::FuzzDescription fuzz;
  fuzz.without = {"starts", "noise"};
  fuzz.obstacles.shapes = {"circle"};
  fuzz.noise.real = false;
  read_fuzz(file, fuzz);
  EXPECT_THAT(fuzz.without, ElementsAre("moving"));
  EXPECT_EQ(fuzz.obstacles.most, 2);
  EXPECT_THAT(fuzz.obstacles.shapes, ElementsAre("circle"));  // as before
  EXPECT_FALSE(fuzz.noise.real);
  EXPECT_EQ(fuzz.noise.latency_s, sim::Vec2(0.0, 0.1));
}

/// The keys that the reader knows in each object, from its messages about unknown keys.
std::map<std::string, std::set<std::string>> keys_of_reader() {
  return test_support::known_keys([] {
    static_cast<void>(read_task_text(
        R"({"zz": 0, "worlds": [{"zz": 0, "world": "x"}], "goal": {"zz": 0, "x": 0, "y": 0},
            "may_use": {"zz": 0}, "fuzz": {"zz": 0}, "thresholds": {"zz": 0}, "map": "m",
            "rubric": [{"zz": 0, "figure": "score", "points": 1, "best": 1, "worst": 0},
                       {"zz": 0, "figure": "score", "steps": [{"zz": 0, "at_most": 1, "points": 1}]},
                       {"figure": "score", "steps": [{"zz": 0, "at_least": 1, "points": 1}]}]})",
        "t.task.json"));
  });
}

TEST(TaskSchema, HasAllKeysWithDescriptions) {
  std::ifstream stream(std::string(PLAYPEN_SOURCE_DIR) + "/worlds/schema/task.schema.json");
  const json root = json::parse(stream);
  const std::map<std::string, std::string> definitions{{"", ""},
                                                       {"/worlds/0", "world"},
                                                       {"/goal", "goal"},
                                                       {"/may_use", "may_use"},
                                                       {"/fuzz", "fuzz"},
                                                       {"/thresholds", "thresholds"},
                                                       {"/rubric/0", "rubric_item"},
                                                       {"/rubric/1", "rubric_item"},
                                                       {"/rubric/1/steps/0", "rubric_step"},
                                                       {"/rubric/2/steps/0", "rubric_step"}};
  const auto known = keys_of_reader();
  ASSERT_EQ(known.size(), definitions.size());
  std::map<std::string, std::set<std::string>> known_of;  // by definition; its objects have kinds
  for (const auto& [pointer, keys] : known) {
    ASSERT_TRUE(definitions.contains(pointer)) << pointer;
    known_of[definitions.at(pointer)].insert(keys.begin(), keys.end());
  }
  for (const auto& [name, keys] : known_of) {
    const json& definition = name.empty() ? root : root.at("$defs").at(name);
    std::set<std::string> in_schema;
    for (const auto& [key, property] : definition.at("properties").items()) {
      in_schema.insert(key);
      const json& described =
          property.contains("description")
              ? property
              : root.at(json::json_pointer(property.at("$ref").get<std::string>().substr(1)));
      EXPECT_TRUE(described.contains("description")) << key;
    }
    EXPECT_EQ(keys, in_schema) << name;
    EXPECT_EQ(definition.at("additionalProperties"), false) << name;
  }
}

TEST(ShippedTasks, ReadWithTheirWorlds) {
  int tasks = 0;
  for (const fs::directory_entry& entry :
       fs::directory_iterator(std::string(PLAYPEN_SOURCE_DIR) + "/worlds/tasks")) {
    const std::string file = entry.path().string();
    if (!file.ends_with(kTaskSuffix)) continue;
    ++tasks;
    const Task task = read_task(file);
    EXPECT_FALSE(task.description.empty()) << file;
    for (const TaskWorld& world : task.worlds) {
      EXPECT_NO_THROW(static_cast<void>(sim::load_world(world.file))) << world.file;
    }
  }
  EXPECT_GE(tasks, 3);
}

TEST(WorldName, FileNameWithoutFolderAndExtension) {
  EXPECT_EQ(world_name("a/b/room.json"), "room");
  EXPECT_EQ(world_name(""), "default");
}

}  // namespace
}  // namespace playpen::grade
