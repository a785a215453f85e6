// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace playerlike {

/// For programs that call nothing any more: writes a text to standard error, once, when this
/// process has used so much processor time from now on. Whether it does not depend on how busy the
/// machine is.
///
/// It is written by a signal handler. The signal is SIGURG, which does nothing where nobody handles
/// it; if the program handles it, nothing is done here. There is one alarm in a process: further
/// ones are left out until the first was dismissed.
/// @param cpu_s  of all threads [s], > 0.
void set_busy_alarm(double cpu_s, const std::string& text);
/// Takes the alarm back, if there is one.
void dismiss_busy_alarm() noexcept;
/// Whether an alarm was written.
[[nodiscard]] bool busy_alarm_rang() noexcept;

}  // namespace playerlike
