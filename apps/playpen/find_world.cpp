// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>
#include <system_error>
#include <vector>

#include "commands.h"
#include "grade/task.h"

namespace playpen {
namespace {

namespace fs = std::filesystem;

/// Folders that may hold the shipped worlds, beside this program: PREFIX/share/playpen/worlds of
/// PREFIX/bin/playpen when installed, worlds/ of the source tree that a build folder lies in.
/// Nothing is compiled in, so that an installed tree can be moved.
std::vector<fs::path> worlds_folders() {
  std::error_code error;
  fs::path folder = fs::read_symlink("/proc/self/exe", error).parent_path();
  std::vector<fs::path> folders;
  constexpr int kLevels = 4;  // bin, preset, build, source
  for (int level = 0; level < kLevels && !error && folder.has_relative_path(); ++level) {
    for (const char* candidate : {"share/playpen/worlds", "worlds"}) {
      if (fs::is_directory(folder / candidate / "tasks", error)) {
        folders.push_back(folder / candidate);
      }
    }
    error.clear();
    folder = folder.parent_path();
  }
  return folders;
}

/// The first of these files that a worlds folder has, or `name`.
std::string find_shipped(const std::string& name, const std::vector<std::string>& files) {
  std::error_code error;
  for (const fs::path& folder : worlds_folders()) {
    for (const std::string& file : files) {
      if (fs::is_regular_file(folder / file, error)) return (folder / file).string();
    }
  }
  return name;
}

}  // namespace

std::string find_world(const std::string& name) {
  std::error_code error;
  if (name.empty() || fs::exists(name, error)) return name;
  if (name == "default") return "";
  return find_shipped(name, {name, name + ".json"});
}

std::string find_task(const std::string& name) {
  std::error_code error;
  if (name.empty() || fs::is_regular_file(name, error)) return name;
  const std::string file = name + std::string(grade::kTaskSuffix);
  return find_shipped(name, {name, file, "tasks/" + file});
}

}  // namespace playpen
