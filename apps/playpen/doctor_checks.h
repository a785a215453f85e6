// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

/// The checks of `playpen doctor`.
namespace playpen {

/// The result of a check.
enum class Health {
  kGood,
  kNote,     ///< worth knowing
  kWarning,  ///< something is missing, but a run does not need it
  kBroken,   ///< something is missing that every run needs
};

/// The result of one check.
struct Finding {
  Health health = Health::kGood;
  std::string text;          ///< what was checked, and the result
  std::string cure;          ///< what to do about it; "": nothing
  std::string command = {};  ///< command that fixes it, to be copied from the terminal; "": none
};

using Findings = std::vector<Finding>;

/// The installation: worlds, templates and the libraries and programs beside the command.
[[nodiscard]] Findings check_installation();
/// Runs a program in the default world and checks its results.
[[nodiscard]] Findings check_run();
/// Checks the programs that a build needs, and builds a program.
[[nodiscard]] Findings check_building();
/// Whether programs can be isolated from this machine.
[[nodiscard]] Findings check_isolation();
/// Checks the programs that `playpen class` needs to unpack and compile submissions.
[[nodiscard]] Findings check_class();
/// Whether --view can open a window.
[[nodiscard]] Findings check_display();
/// Whether films can be written, and how.
[[nodiscard]] Findings check_films();
/// What happens to a program that crashes.
[[nodiscard]] Findings check_core_dumps();
/// Whether this machine computes what others compute.
[[nodiscard]] Findings check_mathematics();
/// The environment variables that change what programs do.
[[nodiscard]] Findings check_variables();

/// Runs the part of a check that needs its own process, because it may fail there in any way: "run"
/// is a client program, "film" writes a film.
/// @param file  name of the film.
/// @return exit status of the process.
[[nodiscard]] int probe(const std::string& what, const std::string& file);

}  // namespace playpen
