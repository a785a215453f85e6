// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace sim {

/// Severity of a message.
enum class LogLevel { kDebug, kInfo, kWarning, kError };

/// Receives libsim's log messages; libsim itself prints nothing. The owner of a Simulation passes
/// it in. Called from the thread that steps the simulation.
using LogHook = std::function<void(LogLevel level, std::string_view message)>;

}  // namespace sim
