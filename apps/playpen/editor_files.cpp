// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// The formats: docs/reference/tasks-appendix, docs/cpp/launch-json-reference and
// docs/languages/json of https://code.visualstudio.com.
#include "editor_files.h"

#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "course/html_text.h"
#include "debug_call.h"
#include "grade/text.h"
#include "own_folders.h"
#include "playerlike/host/program.h"
#include "preload.h"
#include "shipped.h"

namespace playpen {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

constexpr const char* kWorldWithoutTask = "cave";
constexpr double kDurationWithoutTask_s = 60.0;
constexpr const char* kDebugBuild = "build for debugging";

bool has_task(const ProjectTemplate& kind) { return *kind.task != '\0'; }

const char* world_of(const ProjectTemplate& kind) {
  return has_task(kind) ? kind.task : kWorldWithoutTask;
}

/// This command, for a task. VS Code may be started without the PATH of the user's shell.
std::string own_command() {
  const fs::path command = own_folders().front() / "playpen";
  return command == "/usr/bin/playpen" ? "playpen" : command.string();
}

/// A task. It runs in the project's folder, and without a shell, so that nothing needs quotes.
ordered_json task(const char* label, const std::string& command,
                  const std::vector<std::string>& arguments, const char* after) {
  ordered_json result = {{"label", label}, {"type", "process"}, {"command", command}};
  result["args"] = arguments;
  if (*after != '\0') result["dependsOn"] = after;
  result["problemMatcher"] = ordered_json::array();
  return result;
}

ordered_json tasks_file(const ProjectTemplate& kind) {
  const std::string program = std::string("build/") + kind.program;
  ordered_json build = task("build", "cmake", {"--build", "build"}, "configure");
  build["problemMatcher"] = ordered_json::array({"$gcc"});
  build["group"] = {{"kind", "build"}, {"isDefault", true}};
  std::vector<std::string> run = {"run", world_of(kind)};
  if (!has_task(kind)) run.insert(run.end(), {"--duration", "60"});
  run.insert(run.end(), {"--", program});
  ordered_json list = {task("configure", "cmake", {"-S", ".", "-B", "build"}, ""), std::move(build),
                       task("run", own_command(), run, "build")};
  if (has_task(kind)) {
    ordered_json grade = task("grade", own_command(), {"grade", kind.task, "--", program}, "build");
    grade["group"] = {{"kind", "test"}, {"isDefault", true}};
    list.push_back(std::move(grade));
  }
  if (kind.has_tests) {
    ordered_json test =
        task("test", "ctest", {"--test-dir", "build", "--output-on-failure"}, "build");
    test["group"] = {{"kind", "test"}, {"isDefault", true}};
    list.push_back(std::move(test));
  }
  list.push_back(task("configure for debugging", "cmake",
                      {"-S", ".", "-B", "build/debug", "-DCMAKE_BUILD_TYPE=Debug"}, ""));
  ordered_json debug =
      task(kDebugBuild, "cmake", {"--build", "build/debug"}, "configure for debugging");
  debug["problemMatcher"] = ordered_json::array({"$gcc"});
  debug["group"] = "build";
  list.push_back(std::move(debug));
  return {{"version", "2.0.0"}, {"tasks", std::move(list)}};
}

/// The file of a world that comes with Playpen, whatever is in the current folder.
std::string shipped_world(const std::string& name) {
  for (const ShippedFile& file : shipped_files()) {
    if (file.kind == FileKind::kWorld && file.name == name) return file.file.string();
  }
  throw std::runtime_error("the world '" + name + "' of Playpen is missing; install Playpen again");
}

/// The environment that `playpen run` gives the program, as far as it does not need that command's
/// process. A library that cannot be preloaded by its path is left out: sleeps then take real time.
playerlike::EnvironmentChanges debug_environment(const ProjectTemplate& kind) {
  playerlike::RunSettings settings;
  settings.quiet_end = true;
  settings.virtual_time = true;
  if (!has_task(kind)) settings.duration_s = kDurationWithoutTask_s;
  playerlike::EnvironmentChanges environment =
      playerlike::run_environment(shipped_world(world_of(kind)), settings);
  environment["PLAYPEN_OUT"] = std::string("${workspaceFolder}/out/") + world_of(kind);
  add_libraries_folder(environment);
  const PreloadedLibrary library;
  if (library.has_own_name()) {
    // Not add_to(): the variables of the shell that makes the project are not those of the editor.
    environment["LD_PRELOAD"] = library.file();
    environment["ASAN_OPTIONS"] = "verify_asan_link_order=0";
  } else {
    environment["PLAYPEN_VIRTUAL_TIME"] = std::nullopt;
  }
  return environment;
}

ordered_json launch_file(const ProjectTemplate& kind) {
  ordered_json environment = ordered_json::array();
  for (const auto& [name, value] : debug_environment(kind)) {
    if (value) environment.push_back({{"name", name}, {"value", *value}});
  }
  const ordered_json pretty = {{"description", "Show containers by their elements"},
                               {"text", "-enable-pretty-printing"},
                               {"ignoreFailures", true}};
  ordered_json setup = ordered_json::array({pretty});
  if (const auto commands = gdb_commands_file()) {
    setup.push_back({{"description", "Playpen's commands, as -exec playpen-robots"},
                     {"text", "source " + commands->string()},
                     {"ignoreFailures", true}});
  }
  ordered_json debug = {{"name", std::string("debug in ") + world_of(kind)},
                        {"type", "cppdbg"},
                        {"request", "launch"},
                        {"program", std::string("${workspaceFolder}/build/debug/") + kind.program},
                        {"args", ordered_json::array()},
                        {"cwd", "${workspaceFolder}"},
                        {"environment", std::move(environment)},
                        {"MIMode", "gdb"},
                        {"setupCommands", std::move(setup)},
                        {"preLaunchTask", kDebugBuild}};
  return {{"version", "0.2.0"}, {"configurations", ordered_json::array({std::move(debug)})}};
}

ordered_json settings_file() {
  ordered_json schemas = ordered_json::array();
  ordered_json with_comments = ordered_json::object();
  std::error_code error;
  for (const std::string kind : {"world", "task", "model", "plan"}) {
    const std::string pattern = "*." + kind + ".json";
    with_comments[pattern] = "jsonc";
    const fs::path schema =
        worlds_folder().value_or(fs::path()) / "schema" / (kind + ".schema.json");
    if (!fs::is_regular_file(schema, error)) continue;
    schemas.push_back({{"fileMatch", ordered_json::array({pattern})},
                       {"url", "file://" + course::url_of(schema)}});
  }
  return {{"cmake.buildDirectory", "${workspaceFolder}/build"},
          {"C_Cpp.default.compileCommands", "${workspaceFolder}/build/compile_commands.json"},
          {"files.associations", std::move(with_comments)},
          {"json.schemas", std::move(schemas)}};
}

void write_json(const fs::path& file, const ordered_json& content) {
  grade::write_text_file(file, content.dump(2) + '\n');
}

}  // namespace

void write_editor_files(const ProjectTemplate& kind, const fs::path& folder) {
  const fs::path place = folder / ".vscode";
  write_json(place / "tasks.json", tasks_file(kind));
  write_json(place / "launch.json", launch_file(kind));
  write_json(place / "settings.json", settings_file());
  write_json(
      place / "extensions.json",
      {{"recommendations", ordered_json::array({"ms-vscode.cpptools", "ms-vscode.cmake-tools"})}});
}

}  // namespace playpen
