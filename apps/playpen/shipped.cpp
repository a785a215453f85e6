// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "shipped.h"

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <initializer_list>
#include <iostream>
#include <iterator>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <utility>

#include "own_folders.h"
#include "sim/core/error.h"
#include "sim/core/file.h"
#include "sim/io/settings_file.h"
#include "sim/simulation/simulation.h"

namespace playpen {
namespace {

namespace fs = std::filesystem;
using sim::ConfigError;
using sim::ConfigIssue;
using sim::io::Reader;

constexpr std::string_view kWorldSuffix = ".json";
constexpr std::size_t kMostSuggestions = 3;
constexpr std::size_t kMostNeighbours = 1000;

std::string without(std::string text, std::string_view suffix) {
  if (text.size() > suffix.size() && text.ends_with(suffix)) {
    text.resize(text.size() - suffix.size());
  }
  return text;
}

/// A name without the extensions of all file kinds.
std::string stem_of(const std::string& name) {
  const std::string stem = without(name, grade::kTaskSuffix);
  return stem != name ? stem : without(name, kWorldSuffix);
}

std::string description_of(const fs::path& file) {
  std::string description;
  try {
    sim::io::read_settings(file.string(), "world", [&description](Reader& root) {
      if (root.is_object()) description = root.string("description", "");
    });
  } catch (const ConfigError&) {
    return "";  // 'playpen check' reports the reason
  }
  return description;
}

/// All files of the worlds folder, without their descriptions.
std::vector<ShippedFile> files_of_folder() {
  std::vector<ShippedFile> files;
  const std::optional<fs::path> root = worlds_folder();
  if (!root) return files;
  for (const char* folder : {"", "tasks", "examples", "devices", "models"}) {
    std::vector<ShippedFile> found;
    std::error_code error;
    for (const fs::directory_entry& entry : fs::directory_iterator(*root / folder, error)) {
      ShippedFile file;
      const std::string name = entry.path().filename().string();
      if (!name.ends_with(kWorldSuffix) || !entry.is_regular_file(error)) continue;
      file.name = stem_of(name);
      file.folder = folder;
      file.file = entry.path();
      if (name.ends_with(grade::kTaskSuffix)) file.kind = FileKind::kTask;
      if (file.folder == "models") file.kind = FileKind::kModel;
      found.push_back(std::move(file));
    }
    std::sort(found.begin(), found.end(), [](const ShippedFile& a, const ShippedFile& b) {
      return std::pair(a.name, a.kind) < std::pair(b.name, b.kind);
    });
    std::move(found.begin(), found.end(), std::back_inserter(files));
  }
  return files;
}

/// Whether a user's name refers to a shipped file: "par_intro", "tasks/par_intro", and both with an
/// extension.
bool is_called(const ShippedFile& file, const std::string& name) {
  const std::string stem = stem_of(name);
  return stem == file.name || stem == (fs::path(file.folder) / file.name).string();
}

/// The names most similar to an unknown one: of shipped files, and of files in the same folder.
std::vector<std::string> nearest_names(const std::string& name,
                                       const std::vector<ShippedFile>& files,
                                       std::optional<FileKind> kind) {
  std::vector<std::string> known;
  if (kind != FileKind::kTask) known.emplace_back("default");
  for (const ShippedFile& file : files) {
    if (kind && file.kind != *kind) continue;
    known.push_back(file.name);
    if (!file.folder.empty()) known.push_back((fs::path(file.folder) / file.name).string());
  }
  std::vector<std::string> beside;
  const fs::path path(name);
  std::error_code error;
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    const fs::path neighbour = entry.path().filename();
    if (beside.size() == kMostNeighbours) break;
    if (neighbour.extension() != kWorldSuffix) continue;
    beside.push_back(neighbour.string());
  }
  std::vector<std::string> nearest =
      sim::nearest_words(path.filename().string(), beside, kMostSuggestions);
  for (std::string& near : nearest) near = (path.parent_path() / near).string();
  const auto add = [&nearest](const std::string& near) {
    // "par_intro" and "tasks/par_intro" are the same file.
    const auto is_same = [&near](const std::string& other) {
      return fs::path(other).filename() == fs::path(near).filename();
    };
    if (std::none_of(nearest.begin(), nearest.end(), is_same)) nearest.push_back(near);
  };
  const std::string stem = stem_of(path.filename().string());
  for (const std::string& word : {name, stem_of(name), stem}) {
    for (const std::string& near : sim::nearest_words(word, known, kMostSuggestions)) add(near);
  }
  constexpr std::size_t kLeastPart = 3;
  if (nearest.empty() && stem.size() >= kLeastPart) {
    for (const std::string& candidate : known) {  // "intro" is part of "par_intro"
      if (candidate.find(stem) != std::string::npos) add(candidate);
    }
  }
  if (nearest.size() > kMostSuggestions) nearest.resize(kMostSuggestions);
  return nearest;
}

[[noreturn]] void throw_missing(const std::string& name, const std::vector<ShippedFile>& files,
                                std::optional<FileKind> kind) {
  const std::string what = kind ? to_string(*kind) : "world, task or model";
  std::string hint;
  for (const std::string& near : nearest_names(name, files, kind)) {
    hint += (hint.empty() ? "did you mean \"" : "\" or \"") + near;
  }
  if (!hint.empty()) hint += "\"? ";
  const std::string list =
      kind ? std::string("playpen list ") + to_string(*kind) + 's' : "playpen list";
  hint += '\'' + list + "' shows the names";
  throw ConfigError(ConfigIssue{"file/missing", name, "", "a " + what + " file, or the name of one",
                                "no file and no " + what + " of that name", hint});
}

bool is_file(const std::string& name) {
  std::error_code error;
  const fs::file_status status = fs::status(name, error);
  if (fs::exists(status)) return !fs::is_directory(status);
  // A broken or circular link; the code that reads it reports the error.
  return fs::is_symlink(fs::symlink_status(name, error));
}

/// A pipe can be read only once, but a world is read several times, the last time by the program.
/// @return a name from which this process and its child processes can read the same content: for a
///         regular file its own name; for a pipe, the name of a descriptor of memory.
/// @throws ConfigError if a pipe provides nothing, or too much.
std::string readable_again(const std::string& name) {
  std::error_code error;
  if (!fs::is_fifo(fs::status(name, error))) return name;
  std::string text;
  if (const auto problem = sim::read_whole_file(name, {.pipes = true}, text)) {
    const bool too_large = problem->fault == sim::FileFault::kTooLarge;
    throw ConfigError(
        ConfigIssue{too_large ? "file/too-large" : "file/unreadable", name, "",
                    "a pipe that gives a file of at most 16 MiB", problem->found,
                    too_large ? "" : "does the program that writes into it still run?"});
  }
  // Programs inherit it on purpose. If the shell created the pipe, it takes the pipe's number.
  int memory = memfd_create("playpen", 0);
  constexpr std::string_view kOfShell = "/dev/fd/";
  int number = 0;
  if (name.starts_with(kOfShell)) {
    std::from_chars(name.data() + kOfShell.size(), name.data() + name.size(), number);
  }
  if (memory >= 0 && number > STDERR_FILENO && dup2(memory, number) == number) {
    close(memory);
    memory = number;
  }
  std::string_view rest = text;
  while (memory >= 0 && !rest.empty()) {
    const ssize_t count = write(memory, rest.data(), rest.size());
    if (count <= 0) break;
    rest.remove_prefix(static_cast<std::size_t>(count));
  }
  if (memory < 0 || !rest.empty()) {
    throw std::runtime_error("what the pipe '" + name +
                             "' gives can't be kept: " + std::generic_category().message(errno));
  }
  return std::string(kOfShell) + std::to_string(memory);
}

/// The file that a name refers to directly, with or without an extension.
std::optional<std::string> own_file(const std::string& name,
                                    const std::vector<std::string_view>& suffixes) {
  if (is_file(name)) return readable_again(name);
  for (const std::string_view suffix : suffixes) {
    const std::string file = name + std::string(suffix);
    if (is_file(file)) return file;
  }
  return std::nullopt;
}

std::optional<std::string> find_shipped(const std::string& name, FileKind kind,
                                        const std::vector<ShippedFile>& files) {
  const auto found = std::find_if(files.begin(), files.end(), [&](const ShippedFile& file) {
    return file.kind == kind && is_called(file, name);
  });
  return found == files.end() ? std::nullopt : std::optional(found->file.string());
}

/// Throws if a file that could not be read as `wanted` is of another kind; otherwise returns.
void throw_if_other_kind(const std::string& file, FileKind wanted) {
  const FileKind kind = kind_of(file);
  if (kind == wanted) return;
  std::string hint;
  if (wanted == FileKind::kWorld && kind == FileKind::kTask) {
    hint = "'playpen grade' takes tasks; the key \"worlds\" names the task's worlds";
  } else if (wanted == FileKind::kWorld) {
    hint = "a robot of a world has it by \"model\": \"" + file + '"';
  } else if (const std::string task = stem_of(file) + std::string(grade::kTaskSuffix);
             is_file(task)) {
    hint = "did you mean \"" + task + "\"?";
  } else {
    hint = "'playpen list tasks' shows tasks; 'playpen doc grading' tells how to write one";
  }
  throw ConfigError(ConfigIssue{"file/other-kind", file, "",
                                std::string("a ") + to_string(wanted) + " file",
                                std::string("a ") + to_string(kind) + " file", hint});
}

}  // namespace

const char* to_string(FileKind kind) {
  switch (kind) {
    case FileKind::kWorld:
      return "world";
    case FileKind::kTask:
      return "task";
    case FileKind::kModel:
      return "model";
  }
  return "";
}

std::optional<fs::path> worlds_folder() {
  std::error_code error;
  for (const fs::path& folder : own_folders()) {
    for (const char* candidate : {"share/playpen/worlds", "worlds"}) {
      if (fs::is_directory(folder / candidate / "tasks", error)) return folder / candidate;
    }
  }
  return std::nullopt;
}

std::vector<ShippedFile> shipped_files() {
  std::vector<ShippedFile> files = files_of_folder();
  for (ShippedFile& file : files) file.description = description_of(file.file);
  return files;
}

FileKind kind_of(const std::string& file) {
  std::optional<FileKind> kind;
  const auto look = [&kind](Reader& root) {
    if (!root.is_object()) return;
    const std::string schema = root.string("$schema", "");
    const auto has_any = [&root](std::initializer_list<const char*> keys) {
      return std::any_of(keys.begin(), keys.end(), [&](const char* key) { return root.has(key); });
    };
    // Keys that the other file kinds do not have.
    if (schema.ends_with("task.schema.json") || has_any({"worlds", "thresholds", "seeds"})) {
      kind = FileKind::kTask;
    } else if (schema.ends_with("model.schema.json") ||
               has_any({"footprint", "drive", "mass", "max_speed", "max_turn_rate_deg"})) {
      kind = FileKind::kModel;
    } else if (schema.ends_with("world.schema.json") ||
               has_any({"arena", "robots", "simulation", "canvas"})) {
      kind = FileKind::kWorld;
    }
  };
  try {
    sim::io::read_settings(file, "world", look);
  } catch (const ConfigError&) {
    // The file is invalid JSON or missing, so decide by its name.
  }
  if (kind) return *kind;
  if (file.ends_with(grade::kTaskSuffix)) return FileKind::kTask;
  if (fs::path(file).parent_path().filename() == "models") return FileKind::kModel;
  return FileKind::kWorld;
}

std::vector<NamedFile> find_files(const std::string& name) {
  if (name == "default" && !is_file(name)) return {{FileKind::kWorld, ""}};
  if (const auto file = own_file(name, {kWorldSuffix, grade::kTaskSuffix})) {
    return {{kind_of(*file), *file}};
  }
  std::vector<NamedFile> found;
  const std::vector<ShippedFile> files = files_of_folder();
  for (const ShippedFile& file : files) {
    // An extension selects one of several files.
    if (is_called(file, name) && (name.ends_with(grade::kTaskSuffix) || name.ends_with(kWorldSuffix)
                                      ? file.file.filename() == fs::path(name).filename()
                                      : true)) {
      found.push_back({file.kind, file.file.string()});
    }
  }
  if (found.empty()) throw_missing(name, files, std::nullopt);
  return found;
}

std::string find_world(const std::string& name) {
  if (name.empty()) return name;
  if (name == "default" && !is_file(name)) return "";
  if (const auto file = own_file(name, {kWorldSuffix})) return *file;
  const std::vector<ShippedFile> files = files_of_folder();
  if (const auto file = find_shipped(name, FileKind::kWorld, files)) return *file;
  // load_world() gives a better error for a folder.
  std::error_code error;
  if (fs::exists(name, error)) return name;
  throw_missing(name, files, FileKind::kWorld);
}

void print_notes(const sim::WorldDescription& world) {
  for (const std::string& note : world.notes) std::cerr << "playpen: " << note << '\n';
}

sim::WorldDescription load_found_world(const std::string& file) {
  try {
    sim::WorldDescription world = sim::load_world(file);
    print_notes(world);
    return world;
  } catch (const ConfigError&) {
    throw_if_other_kind(file, FileKind::kWorld);
    throw;
  }
}

grade::Task load_task(const std::string& name) {
  std::optional<std::string> file = own_file(name, {grade::kTaskSuffix});
  if (!file) {
    const std::vector<ShippedFile> files = files_of_folder();
    file = find_shipped(name, FileKind::kTask, files);
    if (!file) throw_missing(name, files, FileKind::kTask);
  }
  try {
    return grade::read_task(*file);
  } catch (const ConfigError&) {
    throw_if_other_kind(*file, FileKind::kTask);
    throw;
  }
}

}  // namespace playpen
