// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "debug_call.h"

#include <system_error>

#include "own_folders.h"

namespace playpen {
namespace {

namespace fs = std::filesystem;

// Variables that would change gdb itself.
constexpr const char* kForProgramOnly[] = {"LD_PRELOAD", "ASAN_OPTIONS"};

}  // namespace

std::optional<fs::path> gdb_commands_file() {
  std::error_code error;
  for (const fs::path& folder : own_folders()) {
    for (const char* place : {"share/playpen", "apps/playpen"}) {
      fs::path file = folder / place / "playpen_gdb.py";
      if (fs::is_regular_file(file, error)) return file;
    }
  }
  return std::nullopt;
}

std::string find_gdb() {
  try {
    return playerlike::find_program("gdb");
  } catch (const playerlike::ProgramError&) {
    throw playerlike::ProgramError(
        "--debug needs the debugger gdb, which is not on the PATH; it is in the package gdb: sudo "
        "apt install gdb");
  }
}

std::vector<std::string> debug_call(const std::string& gdb, const std::vector<std::string>& program,
                                    playerlike::EnvironmentChanges& environment, bool runs) {
  std::vector<std::string> call = {gdb, "-q"};
  for (const char* name : kForProgramOnly) {
    const auto found = environment.find(name);
    if (found == environment.end()) continue;
    call.insert(call.end(), {"-iex", found->second ? std::string("set environment ") + name + '=' +
                                                         *found->second
                                                   : std::string("unset environment ") + name});
    environment.erase(found);
  }
  const auto file = gdb_commands_file();
  if (file) call.insert(call.end(), {"-x", file->string()});
  if (runs) call.insert(call.end(), {"-ex", "run"});
  if (runs && file) call.insert(call.end(), {"-ex", "playpen-time", "-ex", "playpen-frame"});
  call.emplace_back("--args");
  call.insert(call.end(), program.begin(), program.end());
  return call;
}

}  // namespace playpen
