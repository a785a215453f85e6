// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sys/types.h>

#include <map>
#include <string>
#include <vector>

#include "playerlike/host/program.h"

namespace playerlike {

/// State of a process in the system's table.
struct ProcessState {
  pid_t parent = 0;
  char letter = '?';  ///< R: runs, S: sleeps, D: waits for a disk, T: stopped
  std::string text;   ///< its line, whose numbers change when it does something
};

/// All living processes, without zombies.
[[nodiscard]] std::map<pid_t, ProcessState> living_processes();

/// How a program ended, by its wait status.
[[nodiscard]] ProgramEnd program_end(int wait_state);

/// @name For exec
/// @{

/// The environment of this process with changes, as "NAME=value".
[[nodiscard]] std::vector<std::string> changed_environment(const EnvironmentChanges& changes);
/// Pointers to the texts, which must outlive them, with a null pointer at the end.
[[nodiscard]] std::vector<char*> pointers(std::vector<std::string>& texts);
/// @}

}  // namespace playerlike
