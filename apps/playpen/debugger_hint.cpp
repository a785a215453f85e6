// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "debugger_hint.h"

#include <algorithm>
#include <array>
#include <csignal>

#include "terminal.h"

namespace playpen {

bool is_crash(int signal) noexcept {
  constexpr std::array kCrashes = {SIGSEGV, SIGABRT, SIGBUS, SIGFPE, SIGILL, SIGTRAP, SIGSYS};
  return std::find(kCrashes.begin(), kCrashes.end(), signal) != kCrashes.end();
}

std::string debugger_command(const std::vector<std::string>& call,
                             const std::vector<std::string>& program) {
  std::string command;
  for (const std::string& word : call) command += shell_word(word) + ' ';
  command += "-- gdb -ex run --args";
  for (const std::string& word : program) command += ' ' + shell_word(word);
  return command;
}

}  // namespace playpen
