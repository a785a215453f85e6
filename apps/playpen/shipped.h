// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "grade/task.h"
#include "sim/world/description.h"

/// What comes with Playpen and has a name, and how names that users write are resolved. All
/// commands use this one resolver.
namespace playpen {

/// What a file describes.
enum class FileKind { kWorld, kTask, kModel };

/// "world", "task" or "model".
[[nodiscard]] const char* to_string(FileKind kind);

/// The folder of the worlds, tasks and models that belong to this program:
/// PREFIX/share/playpen/worlds of PREFIX/bin/playpen when it is installed, worlds/ of the source
/// tree that the build folder lies in. Nothing is compiled in, so that an installed tree can be
/// moved. nullopt: there is none.
[[nodiscard]] std::optional<std::filesystem::path> worlds_folder();

/// One of these files.
struct ShippedFile {
  FileKind kind = FileKind::kWorld;
  std::string name;    ///< what users call it: "cave", "par_intro"; unique for each kind
  std::string folder;  ///< within worlds_folder(): "", "tasks", "examples", "devices" or "models"
  std::filesystem::path file;
  std::string description;  ///< what it is for, from the file; "": it does not say, or is unsound
};

/// All of them, by folder and name.
[[nodiscard]] std::vector<ShippedFile> shipped_files();

/// What kind of file this is, by its contents; by its name if it cannot be read.
[[nodiscard]] FileKind kind_of(const std::string& file);

/// A file that a name means.
struct NamedFile {
  FileKind kind = FileKind::kWorld;
  std::string file;  ///< "" for the default world
};

/// Finds what a name means: a file; a file without its ending; "default", the world of programs
/// that name none; or a shipped world, task or model, with or without folder and ending
/// ("par_intro", "tasks/par_intro", "tasks/par_intro.json").
/// @return one file, or one of each kind if several shipped ones have the name.
/// @throws sim::ConfigError file/missing, with the nearest names.
[[nodiscard]] std::vector<NamedFile> find_files(const std::string& name);

/// Finds the world that a name means. A name that means only a task of that name means its world.
/// @return a path; "" for "default" and "": the default world.
/// @throws sim::ConfigError file/missing, with the nearest names.
[[nodiscard]] std::string find_world(const std::string& name);

/// Reads the world that find_world() has found.
/// @throws sim::ConfigError as sim::load_world(); file/other-kind for a task or a model.
[[nodiscard]] sim::WorldDescription load_found_world(const std::string& file);

/// Finds and reads the task that a name means; a world's name means the task of the same name.
/// @throws sim::ConfigError as find_world() and grade::read_task(); file/other-kind for a world or
///         a model.
[[nodiscard]] grade::Task load_task(const std::string& name);

}  // namespace playpen
