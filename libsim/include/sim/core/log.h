// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace sim {

/// How much a message matters: for developers, good to know, suspicious, gone wrong.
enum class LogLevel { kDebug, kInfo, kWarning, kError };

/// Receives what libsim has to say. Given to a Simulation by its owner; libsim itself prints
/// nothing. Called from the thread that steps the simulation.
using LogHook = std::function<void(LogLevel level, std::string_view message)>;

}  // namespace sim
