// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace playerlike {

/// Whether the program has, or has had, more threads than its first one.
enum class ProgramThreads {
  kNone,
  kSome,
  kUnknown,  ///< this library has started threads, and the program may have done so since
};

/// Must be called before this library starts a thread of its own in a program.
void note_own_threads() noexcept;

/// What is known of the program's threads. The C library knows whether a process ever had a second
/// thread, but not whose it was.
[[nodiscard]] ProgramThreads program_threads() noexcept;

}  // namespace playerlike
