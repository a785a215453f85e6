// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "playerlike/host/program.h"

namespace playpen {

/// Folders that may contain Playpen's loadable libraries, relative to this program's folder, so
/// that an installed tree can be moved. The libraries that programs link are beside these folders.
[[nodiscard]] std::vector<std::filesystem::path> library_folders();

/// Passes the folder of the loadable libraries to a program in PLAYPEN_LIBRARIES; a statically
/// linked program cannot find it by itself. Keeps a folder that the user has set.
void add_libraries_folder(playerlike::EnvironmentChanges& environment);

/// The library that makes a program's time virtual (docs/virtual_time.md), ready to be preloaded.
/// Keep the object until the program has ended.
class PreloadedLibrary {
 public:
  /// Finds the library in lib/playpen beside the folder of this command, installed or built.
  /// @throws std::runtime_error that names the places where it should be.
  PreloadedLibrary();
  PreloadedLibrary(const PreloadedLibrary&) = delete;
  PreloadedLibrary& operator=(const PreloadedLibrary&) = delete;
  ~PreloadedLibrary();

  /// Path of the library.
  [[nodiscard]] const std::string& file() const noexcept { return file_; }

  /// Whether the library is preloaded by its own path. If not, by a name that ends with this
  /// object.
  [[nodiscard]] bool has_own_name() const noexcept { return link_folder_.empty(); }

  /// Makes a program load the library, after its other preloaded libraries.
  void add_to(playerlike::EnvironmentChanges& environment) const;

 private:
  std::string file_;
  std::string name_;         ///< name for preloading: without blanks
  std::string link_folder_;  ///< "": not needed
};

}  // namespace playpen
