// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <exception>

namespace playerlike {

/// Flushes the standard streams and ends the process with status 0, at once: no destructors run,
/// since other threads may still use what they would destroy.
[[noreturn]] void end_program_quietly() noexcept;

/// From now on an exception that says the run is over, and that nobody catches, ends the
/// process with status 0 instead of aborting it. Other uncaught exceptions abort as before.
void end_program_quietly_if_uncaught() noexcept;

/// From now on the first SIGINT or SIGTERM only sets a flag, so that the run can be ended in good
/// order; a second one ends the process. Signals that the program handles itself are left to it.
void note_interrupts() noexcept;
/// Whether such a signal has come.
[[nodiscard]] bool interrupted() noexcept;

/// Adds a test of whether an exception says that the run is over (SessionError kFinished is
/// known). The layer above registers the exception type that it turns that into.
using EndOfRunTest = bool (*)(const std::exception_ptr&);
void add_end_of_run_test(EndOfRunTest test) noexcept;

}  // namespace playerlike
