// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "playerlike/host/program.h"

namespace playpen {

/// Tells a program, by PLAYPEN_LIBRARIES, the folder of the libraries that it may load: a program
/// that is linked statically cannot know. A folder that the user has set stays.
void add_libraries_folder(playerlike::EnvironmentChanges& environment);

/// The library that makes a program's time virtual (docs/virtual_time.md), made ready to be
/// preloaded. To be kept until the program has ended.
class PreloadedLibrary {
 public:
  /// Finds it: in lib/playpen beside the folder of this command, installed or built.
  /// @throws std::runtime_error naming the places where it should be.
  PreloadedLibrary();
  PreloadedLibrary(const PreloadedLibrary&) = delete;
  PreloadedLibrary& operator=(const PreloadedLibrary&) = delete;
  ~PreloadedLibrary();

  /// Where the library lies.
  [[nodiscard]] const std::string& file() const noexcept { return file_; }

  /// Lets a program load it, after what it is to preload anyway.
  void add_to(playerlike::EnvironmentChanges& environment) const;

 private:
  std::string file_;
  std::string name_;         ///< by which it is preloaded: without blanks
  std::string link_folder_;  ///< "": not needed
};

}  // namespace playpen
