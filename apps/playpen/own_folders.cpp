// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "own_folders.h"

#include <system_error>

namespace playpen {

std::vector<std::filesystem::path> own_folders() {
  std::error_code error;
  std::filesystem::path folder =
      std::filesystem::read_symlink("/proc/self/exe", error).parent_path();
  constexpr int kLevels = 4;  // bin, preset, build, source
  std::vector<std::filesystem::path> folders;
  for (int level = 0; level < kLevels && folder.has_relative_path(); ++level) {
    folders.push_back(folder);
    folder = folder.parent_path();
  }
  return folders;
}

}  // namespace playpen
