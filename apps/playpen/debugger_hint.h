// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace playpen {

/// Whether a signal is one of those by which programs crash, such as SIGSEGV or SIGABRT.
[[nodiscard]] bool is_crash(int signal) noexcept;

/// The command line, for a shell, that repeats a run with its program in gdb: the same run, so that
/// the program crashes at the same step.
/// @param call     the call of the run: playpen, "run", world and options, as the user wrote them.
/// @param program  the program and its arguments.
/// @pre both name something.
[[nodiscard]] std::string debugger_command(const std::vector<std::string>& call,
                                           const std::vector<std::string>& program);

}  // namespace playpen
