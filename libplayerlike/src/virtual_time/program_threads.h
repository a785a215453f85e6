// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

namespace playerlike {

/// Must exist in a program while this library starts a thread of its own.
///
/// The thread, and all threads that it starts, get a name by which program_has_threads() knows
/// them: in Linux a thread inherits the name of the one that starts it.
class StartsOwnThreads {
 public:
  StartsOwnThreads() noexcept;
  StartsOwnThreads(const StartsOwnThreads&) = delete;
  StartsOwnThreads& operator=(const StartsOwnThreads&) = delete;
  ~StartsOwnThreads();

 private:
  std::array<char, 16> name_{};  ///< of the calling thread
};

/// Whether the program has had more threads than its first one, apart from those of this library.
/// The C library knows whether a process ever had a second thread. Once this library has started
/// threads, only threads that live during a call are found.
[[nodiscard]] bool program_has_threads() noexcept;

}  // namespace playerlike
