// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "project.h"

namespace playpen {

/// Writes the files of a project for VS Code into its folder `.vscode`: tasks.json (configure,
/// build, run, grade), launch.json (the program in gdb, with the environment of `playpen run`),
/// settings.json (build folder, schemas of Playpen's files) and extensions.json. They are plain
/// JSON.
/// @param folder  the project's folder, which exists and has none of these files.
/// @throws std::runtime_error that names what is missing or cannot be written.
void write_editor_files(const ProjectTemplate& kind, const std::filesystem::path& folder);

}  // namespace playpen
