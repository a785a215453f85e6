// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdlib>

namespace sim::detail {
/// Writes the failed condition and its place to stderr, then aborts.
[[noreturn]] void assertion_failed(const char* condition, const char* file, int line) noexcept;
}  // namespace sim::detail

/// Checks a condition that can only fail because of a bug in Playpen, never because of user input.
/// Enabled unless CMake's option PLAYPEN_ASSERTS is off; not evaluated then.
#ifdef SIM_ENABLE_ASSERTS
#define SIM_ASSERT(condition)         \
  ((condition) ? static_cast<void>(0) \
               : ::sim::detail::assertion_failed(#condition, __FILE__, __LINE__))
#else
#define SIM_ASSERT(condition) static_cast<void>(sizeof((condition) ? 1 : 0))
#endif
