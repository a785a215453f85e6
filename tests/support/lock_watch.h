// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

/// A library that replaces pthread's functions for mutexes in a test's program, and measures how
/// long one mutex is held: in processor time of the thread that holds it, because a busy machine
/// may interrupt a thread for any time. It must be a shared library, see sim's library_functions.h.
namespace test_support {

/// Watches the mutex that the calling thread has locked last.
void watch_last_mutex();
void watch_no_mutex();
void forget_holds();
/// The longest time that the mutex was held since then [ns].
[[nodiscard]] std::int64_t longest_hold_ns();

}  // namespace test_support
