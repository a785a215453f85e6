// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "preload.h"

#include <stdlib.h>

#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <system_error>
#include <vector>

#include "own_folders.h"

namespace playpen {
namespace {

namespace fs = std::filesystem;

constexpr const char* kName = "libplaypen_virtual_time.so";
constexpr const char* kFolderVariable = "PLAYPEN_LIBRARIES";
// These characters are special to the loader, which has no way to escape them.
constexpr const char* kSpecial = " :;$\t\n";

fs::path find_library() {
  std::error_code error;
  std::string places;
  for (const fs::path& folder : library_folders()) {
    fs::path file = folder / kName;
    if (fs::is_regular_file(file, error)) return file;
    if (places.empty()) places = file.string();
  }
  throw std::runtime_error(
      "the library that makes sleeps of programs simulated time, " + places +
      ", is missing; install Playpen again (or do without: playpen run --real-sleep)");
}

std::string environment(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

}  // namespace

std::vector<fs::path> library_folders() {
  const std::vector<fs::path> own = own_folders();
  const fs::path folder = own.empty() ? fs::path() : own.front();
  std::vector<fs::path> folders;
  for (const char* place : {PLAYPEN_LIBRARY_PLACES}) {
    folders.push_back((folder / place / "playpen").lexically_normal());
  }
  return folders;
}

void add_libraries_folder(playerlike::EnvironmentChanges& environment_changes) {
  if (!environment(kFolderVariable).empty()) return;
  std::error_code error;
  for (const fs::path& folder : library_folders()) {
    if (fs::is_directory(folder, error)) {
      environment_changes[kFolderVariable] = folder.string();
      return;
    }
  }
}

PreloadedLibrary::PreloadedLibrary() : file_(find_library().string()), name_(file_) {
  if (file_.find_first_of(kSpecial) == std::string::npos) return;
  // Otherwise use another name, in /tmp, which contains none of these characters.
  std::string folder = "/tmp/playpen-XXXXXX";
  std::error_code error;
  if (mkdtemp(folder.data()) == nullptr) {
    error = std::error_code(errno, std::generic_category());
  } else {
    link_folder_ = folder;
    fs::create_symlink(file_, fs::path(folder) / kName, error);
  }
  if (error) {
    fs::remove_all(link_folder_, error);
    throw std::runtime_error("the library " + file_ +
                             " cannot be preloaded from a path with blanks, nor linked to from "
                             "/tmp (do without: playpen run --real-sleep)");
  }
  name_ = (fs::path(folder) / kName).string();
}

PreloadedLibrary::~PreloadedLibrary() {
  std::error_code ignored;
  if (!link_folder_.empty()) fs::remove_all(link_folder_, ignored);
}

void PreloadedLibrary::add_to(playerlike::EnvironmentChanges& environment_changes) const {
  const auto append = [&](const char* variable, const std::string& text) {
    const std::string present = environment(variable);
    environment_changes[variable] = present.empty() ? text : present + ':' + text;
  };
  append("LD_PRELOAD", name_);
  // AddressSanitizer requires to be the first library; this option allows another one before it.
  append("ASAN_OPTIONS", "verify_asan_link_order=0");
}

}  // namespace playpen
