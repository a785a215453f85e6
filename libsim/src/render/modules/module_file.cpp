// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "render/modules/module_file.h"

#include <dlfcn.h>

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <vector>

#include "core/library_functions.h"
#include "sim/render/render.h"

namespace sim::render::modules {
namespace {

namespace fs = std::filesystem;

/// The folder of the shared library or program that this code is part of; empty if unknown.
fs::path own_folder() {
  Dl_info info{};
  std::error_code error;
  if (dladdr(reinterpret_cast<const void*>(&load_module), &info) != 0 &&
      info.dli_fname != nullptr && fs::path(info.dli_fname).is_absolute()) {
    const fs::path file = fs::canonical(info.dli_fname, error);
    if (!error) return file.parent_path();
  }
  // argv[0] may be relative to a folder that the program has left.
  return fs::read_symlink("/proc/self/exe", error).parent_path();
}

std::vector<fs::path> own_folders() {
  std::vector<fs::path> folders;
  const fs::path folder = own_folder();
  if (folder.empty()) return folders;
  for (const char* place : {".", PLAYPEN_LIBRARY_PLACES}) {
    const fs::path candidate = (folder / place / "playpen").lexically_normal();
    if (std::find(folders.begin(), folders.end(), candidate) == folders.end()) {
      folders.push_back(candidate);
    }
  }
  return folders;
}

/// The last error of the dynamic loader.
std::string loader_problem() {
  const char* const problem = dlerror();
  return problem == nullptr ? "unknown reason" : problem;
}

void* open(const std::string& name) {
  const HiddenProgramNames hidden;
  return dlopen(name.c_str(), RTLD_NOW | RTLD_LOCAL);
}

/// @return null if no place has such a file; `places` receives the searched places.
void* open_somewhere(const std::string& file, std::string& places) {
  const std::vector<fs::path> folders = own_folders();
  const char* const named = std::getenv("PLAYPEN_LIBRARIES");
  std::error_code error;
  const auto try_folder = [&](const fs::path& folder) -> void* {
    places += (places.empty() ? "" : ", ") + folder.string();
    if (!fs::is_regular_file(folder / file, error)) return nullptr;
    if (void* const module = open((folder / file).string())) return module;
    throw std::runtime_error("the library " + (folder / file).string() +
                             ", which draws pictures, cannot be loaded: " + loader_problem());
  };
  for (const fs::path& folder : folders) {
    if (void* const module = try_folder(folder)) return module;
  }
  if (void* const module = open(file)) return module;
  // A module that exists but lacks one of its own libraries must not be reported as missing.
  const std::string problem = loader_problem();
  if (!problem.starts_with(file + ": ")) {
    throw std::runtime_error("the library " + file +
                             ", which draws pictures, cannot be loaded: " + problem);
  }
  const fs::path last = named == nullptr ? "" : named;
  const bool tried = std::find(folders.begin(), folders.end(), last) != folders.end();
  return last.empty() || tried ? nullptr : try_folder(last);
}

template <typename Functions>
const Functions& functions(const char* file_name, const char* entry) {
  const std::string file = file_name;
  using Entry = const Functions* (*)();
  const auto* const table = reinterpret_cast<Entry>(load_module(file, entry))();
  if (std::string_view(table->version) != PLAYPEN_VERSION) {
    throw std::runtime_error("the library " + file + ", which draws pictures, is of Playpen " +
                             table->version +
                             ", this program is of Playpen " PLAYPEN_VERSION
                             "; build the program again, or install that version");
  }
  return *table;
}

}  // namespace

void* load_module(const std::string& file, const char* entry) {
  std::string places;
  void* const module = open_somewhere(file, places);
  if (module == nullptr) {
    throw std::runtime_error("the library " + file +
                             ", which draws pictures, is missing; looked for in " + places +
                             " and on the loader's path; install Playpen again, or set "
                             "PLAYPEN_LIBRARIES to the folder that holds it");
  }
  void* const function = dlsym(module, entry);
  if (function == nullptr) {
    throw std::runtime_error("the library " + file + " has no function " + entry +
                             "; install Playpen again");
  }
  return function;
}

const TextFunctions& text_functions() {
  static const TextFunctions& kFunctions =
      functions<TextFunctions>("libplaypen_text.so", kTextEntry);
  return kFunctions;
}

const FilmFunctions& film_functions() {
  static const FilmFunctions& kFunctions =
      functions<FilmFunctions>("libplaypen_film.so", kFilmEntry);
  return kFunctions;
}

}  // namespace sim::render::modules

namespace sim::render {

void prepare_pictures() noexcept {
  try {
    static_cast<void>(modules::text_functions());
  } catch (const std::exception&) {
    // Drawing a picture reports the error.
  }
}

void prepare_films() noexcept {
  try {
    static_cast<void>(modules::film_functions());
  } catch (const std::exception&) {
    // Starting a film reports the error.
  }
}

}  // namespace sim::render
