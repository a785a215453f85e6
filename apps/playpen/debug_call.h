// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "playerlike/host/program.h"

namespace playpen {

/// The file that gives gdb Playpen's commands: PREFIX/share/playpen/playpen_gdb.py for an installed
/// PREFIX/bin/playpen, or that of the source tree that contains the build folder. nullopt: there is
/// none.
[[nodiscard]] std::optional<std::filesystem::path> gdb_commands_file();

/// The path of gdb. @throws playerlike::ProgramError if there is none on the PATH; it names the
/// package.
[[nodiscard]] std::string find_gdb();

/// The command that starts gdb on a program, with Playpen's commands, at gdb's prompt.
/// @param gdb          its path.
/// @param program      the program and its arguments; not empty.
/// @param runs         whether gdb starts the program and shows the time when it stands.
/// @param environment  of the run. What must reach the program only, such as libraries to preload,
///                     moves from here into gdb's settings.
[[nodiscard]] std::vector<std::string> debug_call(const std::string& gdb,
                                                  const std::vector<std::string>& program,
                                                  playerlike::EnvironmentChanges& environment,
                                                  bool runs = false);

}  // namespace playpen
