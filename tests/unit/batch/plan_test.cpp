// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "batch/plan.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "sim/core/error.h"

namespace playpen::batch {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

Plan read(const std::string& members) {
  return read_plan_text(R"({"programs": ["robot"], "worlds": ["cave"], )" + members + "}",
                        "plan.json");
}

std::string error_of(const std::string& text) {
  try {
    static_cast<void>(read_plan_text(text, "plan.json"));
  } catch (const sim::ConfigError& error) {
    return error.what();
  }
  return "no error";
}

std::string error_with(const std::string& members) {
  return error_of(R"({"programs": ["robot"], "worlds": ["cave"], )" + members + "}");
}

TEST(Plan, Whole_AllMembers) {
  const Plan plan = read_plan_text(
      R"({"task": "par_intro", "programs": ["build/robot", {"name": "slow",
          "command": ["robot", "--speed", "0.1"]}], "worlds": ["cave", "my/arena.json"],
          "seeds": [3, 18446744073709551615], "parameters": {"/robots/0/pose": [{"x": 1}, null],
          "/arena/a~1b": [0.1, "text"]}, "duration": 60, "timeout": 5, "realism": "real"})",
      "plan.json");
  EXPECT_EQ(plan.task, "par_intro");
  ASSERT_EQ(plan.programs.size(), 2U);
  EXPECT_EQ(plan.programs[0].name, "robot");
  EXPECT_THAT(plan.programs[0].command, ElementsAre("build/robot"));
  EXPECT_EQ(plan.programs[1].name, "slow");
  EXPECT_THAT(plan.programs[1].command, ElementsAre("robot", "--speed", "0.1"));
  EXPECT_THAT(plan.worlds, ElementsAre("cave", "my/arena.json"));
  EXPECT_THAT(plan.seeds, ElementsAre(3, 18446744073709551615U));
  ASSERT_EQ(plan.parameters.size(), 2U);
  EXPECT_EQ(plan.parameters[0].pointer, "/robots/0/pose");
  EXPECT_THAT(plan.parameters[0].values, ElementsAre(R"({"x":1})", "null"));
  EXPECT_THAT(plan.parameters[1].values, ElementsAre("0.1", "\"text\""));
  EXPECT_EQ(plan.duration_s, 60.0);
  EXPECT_EQ(plan.timeout_s, 5.0);
  EXPECT_EQ(plan.realism, sim::Realism::kReal);
}

TEST(Plan, Seeds_NumberOrNothing) {
  EXPECT_THAT(read(R"("seeds": 3)").seeds, ElementsAre(1, 2, 3));
  EXPECT_THAT(read(R"("duration": 1)").seeds, ElementsAre(1));
  EXPECT_THAT(read(R"("task": "par_intro")").seeds, IsEmpty()) << "those of the task";
}

TEST(Plan, Range_ValuesAreDecimal) {
  const auto values = [](const std::string& range) {
    return read(R"("parameters": {"/a": )" + range + "}").parameters.at(0).values;
  };
  EXPECT_THAT(values(R"({"from": 0, "to": 0.3, "step": 0.1})"),
              ElementsAre("0", "0.1", "0.2", "0.3"));
  EXPECT_THAT(values(R"({"from": -1, "to": 0.9, "step": 0.7})"), ElementsAre("-1", "-0.3", "0.4"));
  EXPECT_THAT(values(R"({"from": 1, "to": 2, "count": 3})"), ElementsAre("1", "1.5", "2"));
  EXPECT_THAT(values(R"({"from": 1, "to": 2, "count": 1})"), ElementsAre("1"));
  EXPECT_THAT(values(R"({"from": 1, "to": 1.7, "step": 0.1})"),
              ElementsAre("1", "1.1", "1.2", "1.3", "1.4", "1.5", "1.6", "1.7"));
}

TEST(Plan, BadInput_SaysWhereAndWhat) {
  EXPECT_THAT(error_of("[1]"), HasSubstr("plan.json"));
  EXPECT_THAT(error_of("{"), HasSubstr("plan.json:1"));
  EXPECT_THAT(error_of(R"({"worlds": ["cave"]})"), HasSubstr("a list of programs"));
  EXPECT_THAT(error_of(R"({"programs": ["robot"]})"), HasSubstr("a list of worlds"));
  EXPECT_THAT(error_of(R"({"programs": [], "worlds": []})"),
              AllOf(HasSubstr("/programs: expected at least one element"),
                    HasSubstr("/worlds: expected at least one element")));
  EXPECT_THAT(error_of(R"({"programs": [3, "", {"command": []}], "worlds": ["cave"]})"),
              AllOf(HasSubstr("/programs/0: expected the path of a program"),
                    HasSubstr("/programs/1"), HasSubstr("/programs/2")));
  EXPECT_THAT(error_of(R"({"programs": ["a/robot", "b/robot"], "worlds": ["cave"]})"),
              HasSubstr("\"robot\" a second time"));
  EXPECT_THAT(error_with(R"("sead": 3)"), HasSubstr("did you mean \"seeds\"?"));
  for (const char* seeds : {"0", "-1", "1.5", "[1, 1]", "[-1]", "[1.5]", "[\"1\"]", "[]", "{}"}) {
    EXPECT_THAT(error_with(R"("seeds": )" + std::string(seeds)), HasSubstr("/seeds")) << seeds;
  }
  EXPECT_THAT(error_with(R"("realism": "none")"), HasSubstr("/realism"));
  EXPECT_THAT(error_with(R"("duration": 0)"), HasSubstr("/duration"));
}

TEST(Plan, BadParameters_SayWhereAndWhat) {
  const auto error = [](const std::string& text) {
    return error_with(R"("parameters": {)" + text + "}");
  };
  for (const char* pointer : {"", "/", "a/b", "/a~", "/a~2"}) {
    EXPECT_THAT(error('"' + std::string(pointer) + R"(": [1])"), HasSubstr("[plan/pointer]"))
        << pointer;
  }
  EXPECT_THAT(error(R"("/a": [])"), HasSubstr("at least one element"));
  EXPECT_THAT(error(R"("/a": 3)"), HasSubstr("/parameters"));
  EXPECT_THAT(error(R"("/a": {"from": 1, "to": 2})"), HasSubstr("either \"step\" or \"count\""));
  EXPECT_THAT(error(R"("/a": {"from": 1, "to": 2, "step": 1, "count": 2})"), HasSubstr("both"));
  EXPECT_THAT(error(R"("/a": {"from": 2, "to": 1, "step": 1})"), HasSubstr("[plan/range]"));
  EXPECT_THAT(error(R"("/a": {"from": 0, "to": 1, "step": 0})"), HasSubstr("/step"));
  EXPECT_THAT(error(R"("/a": {"from": 0, "to": 1, "step": 1e-9})"), HasSubstr("at most 10000"));
  EXPECT_THAT(error(R"("/a": {"from": 0, "to": 1, "count": 1001}, "/b": {"from": 0, "to": 1,
                    "count": 1001})"),
              HasSubstr("at most 1000000 runs, found 1002001"));
}

TEST(PlanSchema, HasTheKeysOfTheReader) {
  std::ifstream stream(std::string(PLAYPEN_SOURCE_DIR) + "/worlds/schema/plan.schema.json");
  const nlohmann::json root = nlohmann::json::parse(stream);
  for (const auto& [key, property] : root.at("properties").items()) {
    EXPECT_THAT(error_of("{\"" + key + "\": null}"), Not(HasSubstr("unknown-key"))) << key;
    EXPECT_TRUE(property.contains("description")) << key;
  }
  EXPECT_EQ(root.at("properties").size(), 10U);
  EXPECT_THAT(error_of(R"({"sead": 1})"), HasSubstr("unknown-key"));
}

}  // namespace
}  // namespace playpen::batch
