// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// World files of Stage: any content is either read or refused with an error that has a place.
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "sim/core/error.h"
#include "sim/simulation/simulation.h"

namespace {

/// A file in a folder of its own, so that nothing else can be included or taken for a picture.
const std::string& world_file() {
  static const std::string kFile = [] {
    const auto folder = std::filesystem::temp_directory_path() /
                        ("fuzz_stage_" + std::to_string(static_cast<long>(getpid())));
    std::filesystem::create_directories(folder);
    return (folder / "w.world").string();
  }();
  return kFile;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  {
    std::ofstream file(world_file(), std::ios::binary);
    file.write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  }
  try {
    const sim::WorldDescription world = sim::load_world(world_file());
    for (const std::string& note : world.notes) {
      if (note.find(':') == std::string::npos) std::abort();
    }
  } catch (const sim::ConfigError& e) {
    if (e.issues().empty() || e.issues().front().id.empty()) std::abort();
  }
  return 0;
}
