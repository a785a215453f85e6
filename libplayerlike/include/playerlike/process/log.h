// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sim/core/log.h"

namespace playerlike {

/// Returns a log hook that writes each message as a line to stderr, with spdlog. Bytes that are no
/// valid UTF-8 appear as "\xNN". Thread-safe.
/// @param least  lowest level that is logged.
[[nodiscard]] sim::LogHook log_to_stderr(sim::LogLevel least = sim::LogLevel::kInfo);

}  // namespace playerlike
