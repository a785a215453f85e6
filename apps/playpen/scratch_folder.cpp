// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "scratch_folder.h"

#include <stdlib.h>

#include <stdexcept>
#include <system_error>

namespace playpen {

ScratchFolder::ScratchFolder() {
  std::error_code error;
  std::string pattern = (std::filesystem::temp_directory_path(error) / "playpen-XXXXXX").string();
  if (error || mkdtemp(pattern.data()) == nullptr) {
    throw std::runtime_error("no folder can be made in the folder for temporary files");
  }
  folder_ = pattern;
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(folder_, ignored);
}

}  // namespace playpen
