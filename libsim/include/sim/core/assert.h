// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdlib>

namespace sim::detail {
/// Writes where and which condition failed to stderr, then aborts.
[[noreturn]] void assertion_failed(const char* condition, const char* file, int line) noexcept;
}  // namespace sim::detail

/// Checks a condition whose failure is a bug of ours, never of the user's input.
/// On in Debug and RelWithDebInfo builds; not evaluated in Release.
#ifdef SIM_ENABLE_ASSERTS
#define SIM_ASSERT(condition)         \
  ((condition) ? static_cast<void>(0) \
               : ::sim::detail::assertion_failed(#condition, __FILE__, __LINE__))
#else
#define SIM_ASSERT(condition) static_cast<void>(sizeof((condition) ? 1 : 0))
#endif
