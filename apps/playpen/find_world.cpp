// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>
#include <system_error>
#include <vector>

#include "commands.h"

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

}  // namespace

std::string find_world(const std::string& name) {
  std::error_code error;
  if (name.empty() || fs::exists(name, error)) return name;
  if (name == "default") return "";
  for (const fs::path& folder : worlds_folders()) {
    for (const fs::path& candidate : {folder / name, folder / (name + ".json")}) {
      if (fs::is_regular_file(candidate, error)) return candidate.string();
    }
  }
  return name;
}

}  // namespace playpen
