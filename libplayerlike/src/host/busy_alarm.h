// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace playerlike {

/// For programs that no longer call the library: writes a text to standard error, once, when this
/// process has used a given processor time from now on. Processor time makes this independent of
/// the machine's load.
///
/// A handler of SIGURG writes the text; by default that signal is ignored. If the program handles
/// it, no alarm is set. A process has one alarm: calls before it is dismissed are ignored.
/// @param cpu_s  of all threads [s], > 0.
void set_busy_alarm(double cpu_s, const std::string& text);
/// Cancels the alarm, if there is one.
void dismiss_busy_alarm() noexcept;
/// Whether the alarm's text was written.
[[nodiscard]] bool busy_alarm_rang() noexcept;

}  // namespace playerlike
