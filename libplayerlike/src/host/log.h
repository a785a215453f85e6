// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sim/core/log.h"

namespace playerlike {

/// A log hook that writes warnings and errors to stderr, one line each, by spdlog. Thread-safe.
[[nodiscard]] sim::LogHook log_to_stderr();

}  // namespace playerlike
