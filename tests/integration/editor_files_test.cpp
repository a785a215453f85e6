// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// The files for VS Code that `playpen new` writes. Their members are checked against lists that
// follow the schemas of VS Code, of its C/C++ extension and of its CMake extension; the schemas
// themselves have more than a million characters each. The test executes the tasks as VS Code does.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "playpen_process.h"
#include "run_files.h"
#include "run_process.h"
#include "temporary_folder.h"

namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test_support::playpen;
using test_support::ProcessOptions;
using test_support::ProcessResult;
using test_support::read_bytes;
using test_support::read_report;
using test_support::run_process;
using test_support::TemporaryFolder;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsSubsetOf;
using testing::StartsWith;

std::vector<std::string> keys(const json& object) {
  std::vector<std::string> names;
  for (const auto& [name, value] : object.items()) names.push_back(name);
  return names;
}

/// A project with a blank in its path, so that quoting is tested.
class EditorFiles : public testing::Test {
 protected:
  void make(const std::string& kind) {
    project_ = folder_ / (kind + " project");
    const ProcessResult made = playpen({"new", kind, project_});
    ASSERT_EQ(made.status, 0) << made.err;
  }
  /// A file of .vscode, which must be JSON without comments.
  [[nodiscard]] json file(const std::string& name) const {
    return json::parse(read_bytes(project_ + "/.vscode/" + name));
  }
  [[nodiscard]] json task(const std::string& label) const {
    const json all = file("tasks.json");
    for (const json& one : all.at("tasks")) {
      if (one.at("label") == label) return one;
    }
    ADD_FAILURE() << "there is no task " << label;
    return {};
  }
  /// A text with VS Code's variable replaced.
  [[nodiscard]] std::string text(std::string value) const {
    const std::string variable = "${workspaceFolder}";
    const std::size_t at = value.find(variable);
    return at == std::string::npos ? value : value.replace(at, variable.size(), project_);
  }
  /// Executes a task after those that it depends on, in the project's folder.
  /// @param more  arguments inserted after the second one.
  ProcessResult execute(const std::string& label, const std::vector<std::string>& more = {}) {
    const json one = task(label);
    if (one.contains("dependsOn")) {
      const std::string before = one.at("dependsOn");
      const ProcessResult done = execute(before);
      EXPECT_EQ(done.status, 0) << before << '\n' << done.out << done.err;
    }
    std::vector<std::string> call = one.at("args");
    if (!more.empty()) call.insert(call.begin() + 2, more.begin(), more.end());
    call.insert(call.begin(), one.at("command").get<std::string>());
    ProcessOptions options;
    options.folder = project_;
    options.timeout = std::chrono::minutes(20);  // a compiler on a busy machine
    options.environment["CXX"] = CXX_COMPILER;
    return run_process(call, options);
  }

  void check_tasks(bool graded) const {
    const json all = file("tasks.json");
    EXPECT_EQ(all.at("version"), "2.0.0");
    std::set<std::string> labels;
    int default_builds = 0;
    for (const json& one : all.at("tasks")) {
      EXPECT_THAT(keys(one), IsSubsetOf({"label", "type", "command", "args", "dependsOn", "group",
                                         "problemMatcher"}));
      EXPECT_TRUE(labels.insert(one.at("label")).second) << one;
      EXPECT_EQ(one.at("type"), "process");
      if (one.contains("dependsOn")) {
        EXPECT_TRUE(labels.contains(one.at("dependsOn"))) << one;
      }
      default_builds += one.value("group", json()) == json{{"kind", "build"}, {"isDefault", true}};
    }
    EXPECT_EQ(default_builds, 1);
    EXPECT_EQ(task("build").at("problemMatcher"), json::array({"$gcc"}));
    EXPECT_EQ(labels.contains("grade"), graded);
  }

  void check_launch() const {
    const json all = file("launch.json");
    EXPECT_EQ(all.at("version"), "0.2.0");
    const json& debug = all.at("configurations").at(0);
    EXPECT_THAT(keys(debug),
                IsSubsetOf({"name", "type", "request", "program", "args", "cwd", "environment",
                            "MIMode", "setupCommands", "preLaunchTask"}));
    EXPECT_EQ(debug.at("type"), "cppdbg");
    EXPECT_EQ(debug.at("request"), "launch");
    EXPECT_EQ(debug.at("MIMode"), "gdb");
    EXPECT_FALSE(task(debug.at("preLaunchTask")).empty());
    const std::string source = debug.at("setupCommands").back().at("text");
    EXPECT_THAT(source, StartsWith("source "));
    EXPECT_TRUE(fs::is_regular_file(source.substr(source.find(' ') + 1))) << source;
    std::string world;
    for (const json& variable : debug.at("environment")) {
      EXPECT_THAT(keys(variable), ElementsAre("name", "value"));
      if (variable.at("name") == "PLAYPEN_WORLD") world = variable.at("value");
    }
    EXPECT_TRUE(fs::is_regular_file(world)) << world;
  }

  void check_settings() const {
    const json all = file("settings.json");
    EXPECT_THAT(keys(all), ElementsAre("C_Cpp.default.compileCommands", "cmake.buildDirectory",
                                       "files.associations", "json.schemas"));
    EXPECT_EQ(all.at("json.schemas").size(), 4U);
    for (const json& one : all.at("json.schemas")) {
      EXPECT_THAT(keys(one), ElementsAre("fileMatch", "url"));
      const std::string pattern = one.at("fileMatch").at(0);
      EXPECT_EQ(all.at("files.associations").at(pattern), "jsonc");
      const std::string url = one.at("url");
      EXPECT_TRUE(url.starts_with("file:///")) << url;
      // "*.world.json" has "world.schema.json"
      EXPECT_TRUE(url.ends_with('/' + pattern.substr(2, pattern.size() - 7) + ".schema.json"))
          << url;
    }
    EXPECT_EQ(file("extensions.json"),
              (json{{"recommendations", {"ms-vscode.cpptools", "ms-vscode.cmake-tools"}}}));
  }

  TemporaryFolder folder_;
  std::string project_;
};

TEST_F(EditorFiles, EachKindOfProject_DocumentedMembersOnly) {
  for (const std::string kind : {"intro", "planning", "exploration", "traps",
                                 "exploration_changing", "chase", "localization", "client"}) {
    SCOPED_TRACE(kind);
    ASSERT_NO_FATAL_FAILURE(make(kind));
    check_tasks(kind != "client");
    check_launch();
    check_settings();
  }
}

TEST_F(EditorFiles, TasksOfIntro_BuildRunAndGrade) {
  ASSERT_NO_FATAL_FAILURE(make("intro"));
  const ProcessResult ran = execute("run", {"--duration", "2"});
  EXPECT_EQ(ran.status, 0) << ran.out << ran.err;
  EXPECT_DOUBLE_EQ(read_report(project_ + "/out/par_intro").at("run").at("sim_time"), 2.0);
  const std::string list = text(file("settings.json").at("C_Cpp.default.compileCommands"));
  EXPECT_THAT(read_bytes(list), HasSubstr("robot.cc"));
  // The template does nothing, so it fails.
  const ProcessResult graded = execute("grade");
  EXPECT_EQ(graded.status, 1) << graded.err;
  EXPECT_THAT(graded.out, HasSubstr("par_intro: 0 of 5 runs passed"));
}

// gdb does not change a run (PlaypenAdvice.Debugger_SameStepCrashesAndGettersWork), so the program
// is started without it, in the environment of launch.json.
TEST_F(EditorFiles, DebuggedClient_SameRunAsByPlaypenRun) {
  ASSERT_NO_FATAL_FAILURE(make("client"));
  const json debug = file("launch.json").at("configurations").at(0);
  const ProcessResult built = execute(debug.at("preLaunchTask"));
  ASSERT_EQ(built.status, 0) << built.out << built.err;
  ProcessOptions options;
  options.folder = text(debug.at("cwd"));
  for (const json& variable : debug.at("environment")) {
    options.environment[variable.at("name")] = text(variable.at("value"));
  }
  const std::string program = text(debug.at("program"));
  const ProcessResult debugged = run_process({program}, options);
  EXPECT_EQ(debugged.status, 0) << debugged.err;
  const json run = read_report(options.environment.at("PLAYPEN_OUT")).at("run");
  EXPECT_DOUBLE_EQ(run.at("sim_time"), 60.0);

  const std::string out = folder_ / "by playpen run";
  const ProcessResult other =
      playpen({"run", "cave", "--duration", "60", "--out", out, "--", program});
  ASSERT_EQ(other.status, 0) << other.err;
  EXPECT_EQ(read_report(out).at("run").at("state_hash"), run.at("state_hash"));
}

}  // namespace
