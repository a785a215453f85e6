// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstdint>
#include <optional>

namespace playerlike {

/// Id of the calling thread in the system (gettid).
[[nodiscard]] pid_t this_thread() noexcept;
/// Processor time of all threads of a process so far; nullopt if there is no such process.
[[nodiscard]] std::optional<std::chrono::nanoseconds> processor_time(pid_t process) noexcept;
/// Number of voluntary context switches of a thread of this process; nullopt unless it sleeps now.
[[nodiscard]] std::optional<std::uint64_t> sleeps_since(pid_t thread);

/// Blocks all signals in the calling thread, one of this library's own: they are left to the
/// program's threads.
void leave_signals_to_program() noexcept;

}  // namespace playerlike
