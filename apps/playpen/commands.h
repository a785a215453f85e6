// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "playerlike/host/run_settings.h"

/// The commands of `playpen`, behind their arguments. Each prints to the standard streams and
/// returns an exit status; what goes wrong beyond that is thrown.
namespace playpen {

inline constexpr int kOk = 0;             ///< all went well
inline constexpr int kProgramFailed = 1;  ///< the client program failed
inline constexpr int kBadInput = 2;       ///< arguments or a world that can't be used

/// What `playpen run` was asked for.
struct RunRequest {
  std::string world;  ///< as the user wrote it, see find_world()
  playerlike::RunSettings settings;
  bool quiet = false;
  std::vector<std::string> command;  ///< program and arguments
};

/// Finds the world that a user means: a file, or the name of a shipped world such as
/// "tasks/par_intro", looked for in the worlds folder that belongs to this program.
/// @return a path, "" for "default" and "" (the default world), or `name` if nothing was found.
[[nodiscard]] std::string find_world(const std::string& name);

/// Runs a client program on a world; prints how it went unless told to be quiet.
/// @throws sim::ConfigError for a bad world, playerlike::ProgramError for a program that can't be
///         started, std::exception if the output folder can't be prepared.
[[nodiscard]] int run(RunRequest request);

/// Validates worlds; prints a line for each sound one and every issue of the others.
[[nodiscard]] int check(const std::vector<std::string>& worlds);

/// Draws a world as it is at its start into a PNG of `size_px` pixels on its longer side.
/// @throws sim::ConfigError for a bad world, std::runtime_error if the file can't be written.
[[nodiscard]] int render(const std::string& world, const std::string& file, int size_px);

}  // namespace playpen
