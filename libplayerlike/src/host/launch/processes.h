// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sys/types.h>

#include <map>
#include <string>

namespace playerlike {

/// State of a process in the system's table.
struct ProcessState {
  pid_t parent = 0;
  char letter = '?';  ///< R: runs, S: sleeps, D: waits for a disk, T: stopped
  std::string text;   ///< its line, whose numbers change when it does something
};

/// All living processes, without zombies.
[[nodiscard]] std::map<pid_t, ProcessState> living_processes();

}  // namespace playerlike
