// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cstdint>
#include <exception>

namespace playerlike {

/// Flushes the standard streams and ends the process with status 0, at once: no destructors run,
/// since other threads may still use what they would destroy.
[[noreturn]] void end_program_quietly() noexcept;

/// From now on an exception that says the run is over, and that nobody catches, ends the
/// process with status 0 instead of aborting it. Other uncaught exceptions abort as before.
void end_program_quietly_if_uncaught() noexcept;

/// What comes with a signal that `playpen run` passes on, as its value: the program may have got
/// the same signal from somebody else.
inline constexpr int kPassedOn = 0x706c6179;

/// From now on the first SIGINT, SIGTERM or SIGHUP only sets a flag, so that the run can be ended
/// in good order. A second one ends the process, if it comes more than half a second after the
/// first, was not passed on by `playpen run` (which sees to the end itself), and is no further
/// SIGHUP after a first one. Signals that the program handles itself, or ignores, are left to it.
/// @param noted  gets the first signal's number as well; must live as long as the process. May be
///               null.
void note_interrupts(std::atomic<std::uint32_t>* noted) noexcept;
/// The first of these signals that has come; 0: none.
[[nodiscard]] int interrupted() noexcept;

/// Adds a test of whether an exception says that the run is over (SessionError kFinished is
/// known). The layer above registers the exception type that it turns that into.
using EndOfRunTest = bool (*)(const std::exception_ptr&);
void add_end_of_run_test(EndOfRunTest test) noexcept;

}  // namespace playerlike
