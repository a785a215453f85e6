// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cstdint>
#include <exception>

namespace playerlike {

/// Flushes the standard streams and ends the process at once with status 0. No destructor runs,
/// since other threads may still use the objects.
[[noreturn]] void end_program_quietly() noexcept;

/// Installs a terminate handler: an uncaught exception that says that the run is over ends the
/// process with status 0. Other uncaught exceptions abort as before.
void end_program_quietly_if_uncaught() noexcept;

/// The value (si_value) of a signal that `playpen run` forwards. It tells a forwarded signal from
/// one that the program got from elsewhere.
inline constexpr int kForwarded = 0x706c6179;

/// Installs handlers for SIGINT, SIGTERM and SIGHUP. The first of these signals only sets a flag,
/// so that the run can end in an orderly way. A later one ends the process, except if it comes
/// within half a second of the first, is forwarded by `playpen run` (which ends the program
/// itself), or is a SIGHUP after a SIGHUP. Signals that the program handles or ignores keep their
/// disposition.
/// @param noted  also receives the number of the first signal; must live as long as the process.
///               May be null.
void note_interrupts(std::atomic<std::uint32_t>* noted) noexcept;
/// The number of the first such signal that arrived; 0: none.
[[nodiscard]] int interrupted() noexcept;

/// Adds a test that says whether an exception means that the run is over. SessionError kFinished
/// needs no test. A layer above registers the exception type into which it converts that error.
using EndOfRunTest = bool (*)(const std::exception_ptr&);
void add_end_of_run_test(EndOfRunTest test) noexcept;

}  // namespace playerlike
