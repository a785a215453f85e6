// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

/// What `playpen doctor` looks at.
namespace playpen {

/// How something is.
enum class Health {
  kGood,
  kNote,    ///< worth knowing
  kAmiss,   ///< something is missing that a run does not need
  kBroken,  ///< something is missing that each run needs
};

/// What was found out about one thing.
struct Finding {
  Health health = Health::kGood;
  std::string text;          ///< what was looked at, and how it is
  std::string cure;          ///< what to do; "": nothing
  std::string command = {};  ///< that does it, to be copied from the terminal; "": none
};

using Findings = std::vector<Finding>;

/// The installation: worlds, templates and the libraries and programs beside the command.
[[nodiscard]] Findings check_installation();
/// Runs a program in the default world and looks at its results.
[[nodiscard]] Findings check_run();
/// Looks for what builds programs, and builds one.
[[nodiscard]] Findings check_building();
/// Whether --view can open a window.
[[nodiscard]] Findings check_display();
/// Whether films can be written, and how.
[[nodiscard]] Findings check_films();
/// What becomes of a program that crashes.
[[nodiscard]] Findings check_core_dumps();
/// The variables of the environment that change what programs do.
[[nodiscard]] Findings check_variables();

/// What a check does in a process of its own, since it may fail there in any way: "run" is a client
/// program, "film" writes a film.
/// @param file  the film's name.
/// @return the process's exit status.
[[nodiscard]] int probe(const std::string& what, const std::string& file);

}  // namespace playpen
