// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sim/core/log.h"

namespace playerlike {

/// A log hook that writes to stderr, one line each, by spdlog. Thread-safe.
/// @param least  what matters less is left out.
[[nodiscard]] sim::LogHook log_to_stderr(sim::LogLevel least = sim::LogLevel::kInfo);

}  // namespace playerlike
