// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "project.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <system_error>

#include "own_folders.h"

namespace playpen {
namespace {

namespace fs = std::filesystem;

std::string read_text(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

void write_text(const fs::path& file, const std::string& text) {
  std::ofstream stream(file, std::ios::binary | std::ios::trunc);
  stream << text;
  stream.close();
  if (!stream) throw std::runtime_error("the file '" + file.string() + "' cannot be written");
}

void replace_all(std::string& text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos;
       at = text.find(from, at + to.size())) {
    text.replace(at, from.size(), to);
  }
}

/// A path in the syntax of a double-quoted CMake string.
std::string cmake_text(const fs::path& path) {
  std::string result;
  for (const char c : path.string()) {
    if (c == '"' || c == '\\' || c == '$' || c == ';') result += '\\';
    result += c;
  }
  return result;
}

/// Makes the copied build files find this Playpen. A prefix named by the user takes precedence.
void name_the_package(const fs::path& folder, const fs::path& prefix) {
  const fs::path cmake_file = folder / "CMakeLists.txt";
  std::string text = read_text(cmake_file);
  replace_all(text, "find_package(playpen 0.1 REQUIRED",
              "find_package(playpen 0.1 REQUIRED HINTS \"" + cmake_text(prefix) + "\"");
  write_text(cmake_file, text);
  const fs::path makefile = folder / "Makefile";
  if (!fs::exists(makefile)) return;
  text = read_text(makefile);
  std::string make_prefix = prefix.string();
  replace_all(make_prefix, "$", "$$");
  replace_all(text, "PLAYPEN ?= /usr/local\n", "PLAYPEN ?= " + make_prefix + "\n");
  write_text(makefile, text);
}

/// The file's folder, relative to the folder of the libraries: in the layout of the install rules,
/// of Debian's package, or of a build folder, which has lib/ beside bin/.
std::optional<fs::path> folder_by_libraries(const char* folder, const char* file) {
  const std::vector<fs::path> own = own_folders();
  if (own.empty()) return std::nullopt;
  std::error_code error;
  for (const char* libraries : {PLAYPEN_LIBRARY_PLACES}) {
    fs::path found = (own.front() / libraries / folder).lexically_normal();
    if (fs::is_regular_file(found / file, error)) return found;
  }
  return std::nullopt;
}

}  // namespace

const ProjectTemplate& project_template(const std::string& name) {
  const auto* const found =
      std::find_if(kProjectTemplates.begin(), kProjectTemplates.end(),
                   [&name](const ProjectTemplate& kind) { return kind.name == name; });
  if (found == kProjectTemplates.end()) throw std::logic_error("there is no template " + name);
  return *found;
}

std::optional<fs::path> template_folder(const ProjectTemplate& kind) {
  std::error_code error;
  for (const fs::path& folder : own_folders()) {
    for (const fs::path& candidate :
         {folder / "share/playpen/templates" / kind.name, folder / kind.source_folder}) {
      if (fs::is_regular_file(candidate / "CMakeLists.txt", error)) return candidate;
    }
  }
  return std::nullopt;
}

std::optional<fs::path> package_prefix() {
  if (!folder_by_libraries("cmake/playpen", "playpenConfig.cmake")) return std::nullopt;
  return own_folders().front().parent_path();
}

std::optional<fs::path> pkgconfig_folder() {
  return folder_by_libraries("pkgconfig", "playerc++.pc");
}

void copy_template(const ProjectTemplate& kind, const fs::path& folder) {
  const std::optional<fs::path> source = template_folder(kind);
  if (!source) {
    throw std::runtime_error(std::string("the template '") + kind.name +
                             "', share/playpen/templates/" + kind.name +
                             " of Playpen's prefix, is missing; install Playpen again");
  }
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(*source)) {
    const fs::path name = entry.path().filename();
    if (name == "build" || name == "out") continue;
    fs::copy(entry.path(), folder / name, fs::copy_options::recursive, error);
    if (error) {
      throw std::runtime_error("the file '" + (folder / name).string() +
                               "' cannot be written: " + error.message());
    }
  }
  const std::optional<fs::path> prefix = package_prefix();
  // CMake and pkg-config search /usr anyway, and the project stays valid on other computers.
  if (prefix && *prefix != "/usr") name_the_package(folder, *prefix);
}

}  // namespace playpen
