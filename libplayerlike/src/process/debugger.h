// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sys/types.h>

namespace playerlike {

/// The process that traces another one: a debugger, or a tool such as strace.
/// @param process  its number; 0: this process.
/// @return the tracer's number; 0 if there is none, if it cannot be seen from here (it runs outside
///         of this container), or if there is no such process.
/// @note Reads one file of /proc, some ten microseconds. May be called by signal handlers.
[[nodiscard]] pid_t tracer_of(pid_t process) noexcept;

}  // namespace playerlike
