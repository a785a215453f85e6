// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// `playpen class` on a made-up class of 200, ten of which have handed in disguised copies
// (docs/decisions/likeness.md).
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "nightly.h"
#include "playpen_process.h"
#include "run_files.h"
#include "temporary_folder.h"

namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test_support::playpen;
using test_support::ProcessOptions;
using test_support::ProcessResult;
using test_support::read_bytes;
using test_support::TemporaryFolder;

using Words = std::vector<std::string>;
using Pair = std::pair<std::string, std::string>;

constexpr std::size_t kHonest = 190;
constexpr std::size_t kCopies = 10;
constexpr std::size_t kLeastFound = 9;
constexpr std::size_t kLeastPassed = 3;  // of five runs, by a program that works

/// Four worlds of the course and one of the teacher's own.
constexpr const char* kOwnWorld = R"({
  "arena": {"preset": "syrotek", "extended": ["d1", "d4"]},
  "simulation": {"duration": 120, "lock_objects": true},
  "robots": [{"name": "r1", "pose": {"x": 3.15, "y": 2.25, "yaw_deg": -90}, "devices": {"laser": {"noise": 0}}}]
})";

/// With the thresholds of the introduction.
json task() {
  json worlds = json::array();
  for (const char* name : {"par_intro", "par_exploration_2", "par_planning", "par_planning_2"}) {
    worlds.push_back(std::string(PLAYPEN_SOURCE_DIR) + "/worlds/tasks/" + name + ".json");
  }
  worlds.push_back("own.json");
  return {{"worlds", worlds},
          {"seeds", 1},
          {"duration", 120},
          {"thresholds",
           {{"max_collisions", 0},
            {"min_distance", 12},
            {"min_visited_area", 1.5},
            {"max_stalled_time", 0}}}};
}

class MadeUpClass : public testing::Test {
 protected:
  MadeUpClass() {
    folder_.write("task/own.json", kOwnWorld);
    folder_.write("task/drive.task.json", task().dump());
    for (const char* file : {"main.cc", "robot.cc", "robot.h"}) {
      folder_.write(std::string("filled/") + file,
                    read_bytes(std::string(FILLED_TEMPLATE "/") + file));
    }
  }

  void make(const Words& arguments) {
    Words words = {
        "/usr/bin/env", "python3",
        std::string(PLAYPEN_SOURCE_DIR) + "/tests/integration/made_up_class/made_up_class.py",
        arguments.front(), folder_ / "handed_in"};
    words.insert(words.end(), arguments.begin() + 1, arguments.end());
    const ProcessResult result = test_support::run_process(words);
    ASSERT_EQ(result.status, 0) << result.err;
  }
  json grade() {
    Words words = {"class",           folder_ / "task/drive.task.json",
                   "--submissions",   folder_ / "handed_in",
                   "--out",           folder_ / "out",
                   "--isolated",      "best",
                   "--timeout",       "9999",
                   "--build-timeout", "9999"};
    for (const char* baseline : {"/apps/par_intro/template", "/apps/par_intro/solution_avoid",
                                 "/apps/par_intro/solution_wall"}) {
      words.insert(words.end(), {"--baseline", std::string(PLAYPEN_SOURCE_DIR) + baseline});
    }
    words.insert(words.end(), {"--baseline", folder_ / "filled"});
    ProcessOptions options;
    options.timeout = std::chrono::hours(2);  // minutes on a machine that does nothing else
    const ProcessResult result = playpen(words, options);
    EXPECT_EQ(result.status, 0) << result.err;
    return json::parse(read_bytes(folder_ / "out/class.json"));
  }

  TemporaryFolder folder_;
};

/// The submissions whose program passes most of its runs.
Words working(const json& whole) {
  Words ids;
  for (const json& one : whole.at("submissions")) {
    EXPECT_EQ(one.at("build").at("built"), true) << one.at("id");
    if (one.at("passed") >= kLeastPassed) ids.push_back(one.at("id"));
  }
  std::sort(ids.begin(), ids.end());
  return ids;
}

TEST_F(MadeUpClass, CopiesAreNamed_NeitherHonestProgramsNorTemplates) {
  if (!test_support::nightly()) GTEST_SKIP() << test_support::kOnlyNightly;
  make({"honest", std::to_string(kHonest)});
  const Words originals = working(grade());
  ASSERT_GE(originals.size(), 3 * kCopies);

  std::set<Pair> copies;
  for (std::size_t i = 0; i < kCopies; ++i) {
    const std::string& original = originals[i * originals.size() / kCopies];
    const std::string copy = "student_" + std::to_string(kHonest + i);
    make({"copy", original, copy});
    copies.insert({original, copy});
  }
  // Two have handed in the template as it is, and two have done what its comments say.
  for (const char* name : {"template_1", "template_2"}) {
    fs::copy(std::string(PLAYPEN_SOURCE_DIR) + "/apps/par_intro/template",
             folder_ / "handed_in/" + name, fs::copy_options::recursive);
  }
  for (const char* name : {"template_3", "template_4"}) {
    fs::copy(folder_ / "filled", folder_ / "handed_in/" + name, fs::copy_options::recursive);
  }

  const json whole = grade();
  ASSERT_EQ(whole.at("submissions").size(), kHonest + kCopies + 4);
  std::size_t found = 0;
  std::ostringstream figures;
  for (const json& pair : whole.at("alike")) {
    Pair names{pair.at("first"), pair.at("second")};
    if (names.second < names.first) std::swap(names.first, names.second);
    figures << names.first << " and " << names.second << ": " << pair.at("likeness") << " of "
            << pair.at("threshold") << '\n';
    if (copies.contains(names)) {
      ++found;
    } else {
      ADD_FAILURE() << "named, but not copied: " << names.first << " and " << names.second;
    }
  }
  EXPECT_GE(found, kLeastFound) << figures.str();
}

}  // namespace
