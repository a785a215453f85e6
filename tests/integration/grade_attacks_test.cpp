// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Programs that try to pass the course's tasks without doing what they ask for. None passes.
// Without the rules of the tasks they would: so it is the rules that stop them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <initializer_list>
#include <iterator>
#include <nlohmann/json.hpp>
#include <ostream>
#include <string>
#include <vector>

#include "playpen_process.h"
#include "run_files.h"
#include "temporary_folder.h"

namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test_support::playpen;
using test_support::ProcessResult;
using test_support::read_bytes;
using test_support::TemporaryFolder;
using testing::AllOf;
using testing::HasSubstr;

/// An attack on a task.
struct Attack {
  const char* task;
  const char* program;
  const char* fault;          ///< part of the reasons why it fails
  bool passes_without_rules;  ///< whether the task could be passed in this way
};

void PrintTo(const Attack& attack, std::ostream* out) {
  *out << attack.program << " on " << attack.task;
}

class GradeAttacks : public testing::TestWithParam<Attack> {
 protected:
  /// Grades the attack with one seed. @return all runs of grade.json.
  json grade(const std::string& task) {
    const ProcessResult run = playpen({"grade", task, "--seeds", "1,", "--timeout", "3000", "--out",
                                       out_, "--", ATTACK_PROGRAMS, GetParam().program});
    said_ = run.out;
    EXPECT_EQ(run.status == 0, run.out.find("FAIL") == std::string::npos) << run.out << run.err;
    const json whole = json::parse(read_bytes(fs::path(out_) / "grade.json"));
    EXPECT_EQ(whole.at("passed"), run.status == 0);
    return whole.at("runs");
  }

  /// The task as it would be without rules for programs, and with the length of the path instead of
  /// the distance.
  [[nodiscard]] std::string task_without_rules() const {
    const std::string name = GetParam().task;
    const std::string tasks = PLAYPEN_SOURCE_DIR "/worlds/tasks/";
    json task = json::parse(read_bytes(tasks + name + ".task.json"), nullptr, true, true);
    task.erase("$schema");
    task.erase("may_use");
    json& thresholds = task["thresholds"];
    if (thresholds.contains("min_distance")) {
      thresholds["min_path_length"] = thresholds["min_distance"];
      thresholds.erase("min_distance");
      thresholds.erase("min_visited_area");
    }
    for (json& world : task["worlds"]) {
      json& file = world.is_string() ? world : world["world"];
      file = tasks + file.get<std::string>();
    }
    return folder_.write(name + ".task.json", task.dump());
  }

  TemporaryFolder folder_;
  std::string out_ = folder_ / "out";
  std::string said_;
};

TEST_P(GradeAttacks, Fails) {
  const json runs = grade(GetParam().task);
  for (const json& run : runs) {
    EXPECT_EQ(run.at("passed"), false) << run;
    const std::string folder = run.at("folder");
    EXPECT_THAT(run.at("faults").dump() + read_bytes(fs::path(out_) / folder / "program.log"),
                HasSubstr(GetParam().fault))
        << run << said_;
  }
}

/// The other attacks are stopped by rules of the worlds, too.
class AttacksWithoutRules : public GradeAttacks {};

TEST_P(AttacksWithoutRules, Pass) {
  const json runs = grade(task_without_rules());
  for (const json& run : runs) EXPECT_EQ(run.at("passed"), true) << run << said_;
}

constexpr const char* kOnTheSpot = "distance driven (movements on the spot excluded) ";
constexpr const char* kSeen = "the robot's own sensors have seen only";
constexpr const char* kNoMap = "does not let a program use the map of the world";
constexpr const char* kNoObjects = "does not let a program use poses and properties of objects";
constexpr const char* kNoFox = "does not let a program use the device ";

const Attack kAttacks[] = {
    Attack{"par_exploration", "draw_map_of_the_server", kNoMap, false},
    Attack{"par_exploration", "know_the_map", kSeen, false},
    Attack{"par_exploration_changing", "wait_and_draw_map_of_the_server", kNoMap, false},
    Attack{"par_exploration_changing", "wait_and_know_the_map", kSeen, false},
    Attack{"par_intro", "wiggle", kOnTheSpot, true},
    Attack{"par_intro", "wiggle_by_another_client", kOnTheSpot, true},
    Attack{"par_intro", "spin", kOnTheSpot, true},
    Attack{"par_intro", "circle", "visited floor", true},
    Attack{"par_intro", "shuttle", "visited floor", true},
    Attack{"par_planning", "teleport", "does not let a program use", false},
    Attack{"par_planning", "ask_the_planner", "planner", false},
    Attack{"par_traps", "teleport", "does not let a program use", false},
    Attack{"par_traps", "ask_the_planner", "planner", false},
    Attack{"par_localization", "ask_for_the_pose", kNoObjects, true},
    Attack{"par_localization", "teleport", "does not let a program use", false},
    Attack{"par_chase", "drive_the_fox_by_its_port", kNoFox, true},
    Attack{"par_chase", "drive_the_fox_by_the_port_of_all", kNoFox, true},
    Attack{"par_chase", "read_the_sensors_of_the_fox", kNoFox, true},
    Attack{"par_chase", "ask_where_the_fox_is", kNoObjects, true}};

std::vector<Attack> attacks_that_would_pass() {
  std::vector<Attack> all;
  std::copy_if(std::begin(kAttacks), std::end(kAttacks), std::back_inserter(all),
               [](const Attack& attack) { return attack.passes_without_rules; });
  return all;
}

std::string attack_name(const testing::TestParamInfo<Attack>& attack) {
  return std::string(attack.param.program) + "_on_" + attack.param.task;
}

INSTANTIATE_TEST_SUITE_P(, GradeAttacks, testing::ValuesIn(kAttacks), attack_name);
INSTANTIATE_TEST_SUITE_P(, AttacksWithoutRules, testing::ValuesIn(attacks_that_would_pass()),
                         attack_name);

}  // namespace
