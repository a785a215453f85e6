// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "grade/task.h"
#include "sim/world/description.h"

/// The named files that come with Playpen, and the resolution of names that users write. All
/// commands use this resolver.
namespace playpen {

/// What a file describes.
enum class FileKind { kWorld, kTask, kModel };

/// "world", "task" or "model".
[[nodiscard]] const char* to_string(FileKind kind);

/// The folder of the worlds, tasks and models that belong to this program:
/// PREFIX/share/playpen/worlds for an installed PREFIX/bin/playpen, or worlds/ of the source tree
/// that contains the build folder. No path is compiled in, so an installed tree can be moved.
/// nullopt: there is none.
[[nodiscard]] std::optional<std::filesystem::path> worlds_folder();

/// One of these files.
struct ShippedFile {
  FileKind kind = FileKind::kWorld;
  std::string name;    ///< name for users: "cave", "par_intro"; unique within each kind
  std::string folder;  ///< within worlds_folder(): "", "tasks", "examples", "devices" or "models"
  std::filesystem::path file;
  std::string description;  ///< purpose, from the file; "": none, or the file is invalid
};

/// All shipped files, ordered by folder and name.
[[nodiscard]] std::vector<ShippedFile> shipped_files();

/// The kind of a file, by its content; by its name if it cannot be read.
[[nodiscard]] FileKind kind_of(const std::string& file);

/// A file that a name refers to.
struct NamedFile {
  FileKind kind = FileKind::kWorld;
  std::string file;  ///< "" for the default world
};

/// Finds what a name refers to: a file; a file without its extension; "default", the world of
/// programs that name none; or a shipped world, task or model, with or without folder and extension
/// ("par_intro", "tasks/par_intro", "tasks/par_intro.json").
/// @return one file, or one of each kind if several shipped ones have the name.
/// @throws sim::ConfigError file/missing, with the most similar names.
[[nodiscard]] std::vector<NamedFile> find_files(const std::string& name);

/// Finds the world that a name refers to. If the name refers only to a task, the result is the
/// world of that name.
/// @return a path; "" for "default" and "": the default world.
/// @throws sim::ConfigError file/missing, with the most similar names.
[[nodiscard]] std::string find_world(const std::string& name);

/// Reads a world that find_world() has found, and prints its notes.
/// @throws sim::ConfigError as sim::load_world() does; file/other-kind for a task or a model.
[[nodiscard]] sim::WorldDescription load_found_world(const std::string& file);

/// Prints what of a Stage world was left out or means something else, once for each thing.
void print_notes(const sim::WorldDescription& world);

/// Finds and reads the task that a name refers to; the name of a world refers to the task of that
/// name.
/// @throws sim::ConfigError as find_world() and grade::read_task() do; file/other-kind for a world
///         or a model.
[[nodiscard]] grade::Task load_task(const std::string& name);

}  // namespace playpen
