// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "sim/core/time.h"

namespace playerlike {

/// For programs that no longer call the library: writes a text to standard error, once, when this
/// process has used a given processor time from now on. Processor time makes this independent of
/// the machine's load.
///
/// A handler of SIGURG writes the text; by default that signal is ignored. If the program handles
/// it, no alarm is set. A process has one alarm: calls before it is dismissed are ignored.
/// @param cpu_s  of all threads [s], > 0.
void set_busy_alarm(double cpu_s, const std::string& text);
/// For the thread that makes the steps of a simulation, the caller, from now on: sets an alarm that
/// rings once, when this thread has used the processor time since the last step, and at most half
/// of it more. Only the processor time of this thread counts, so the signal never ends a sleep.
/// @param text, end  of the message; between them it has the simulated time of the last step [s].
void set_standstill_alarm(double cpu_s, const std::string& text, const std::string& end);
/// A step was made, for set_standstill_alarm().
void note_step_for_alarm(sim::SimTime now_ns) noexcept;
/// Cancels the alarm, if there is one.
void dismiss_busy_alarm() noexcept;
/// Whether the alarm's text was written.
[[nodiscard]] bool busy_alarm_rang() noexcept;

}  // namespace playerlike
