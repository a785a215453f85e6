// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// World files of Stage, configuration files of Player beside them, and their bitmaps: any content
// is either read or refused with an error that has a place. Lines "@@@" separate the three.
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "sim/core/error.h"
#include "sim/simulation/simulation.h"

namespace {

/// A folder of its own, so that nothing else can be included or taken for a picture.
const std::filesystem::path& folder() {
  static const std::filesystem::path kFolder = [] {
    auto path = std::filesystem::temp_directory_path() /
                ("fuzz_stage_" + std::to_string(static_cast<long>(getpid())));
    std::filesystem::create_directories(path);
    return path;
  }();
  return kFolder;
}

void write(const char* name, std::string_view content) {
  std::ofstream file(folder() / name, std::ios::binary);
  file.write(content.data(), static_cast<std::streamsize>(content.size()));
}

/// Cuts the part before the next separator off.
std::string_view next_part(std::string_view& rest) {
  constexpr std::string_view kSeparator = "\n@@@\n";
  const std::size_t end = rest.find(kSeparator);
  const std::string_view part = rest.substr(0, end);
  rest = end == std::string_view::npos ? std::string_view() : rest.substr(end + kSeparator.size());
  return part;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::string_view rest(reinterpret_cast<const char*>(data), size);
  write("w.world", next_part(rest));
  const std::string_view config = next_part(rest);
  write("w.cfg", config);
  write("b.png", rest);
  try {
    const char* name = config.empty() ? "w.world" : "w.cfg";
    const sim::WorldDescription world = sim::load_world((folder() / name).string());
    for (const std::string& note : world.notes) {
      if (note.find(':') == std::string::npos) std::abort();
    }
  } catch (const sim::ConfigError& e) {
    if (e.issues().empty() || e.issues().front().id.empty()) std::abort();
  }
  return 0;
}
