// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>

namespace playpen {

/// Adds the command `serve` and its options.
/// @param status  gets the exit status when the command has run.
void add_serve(CLI::App& app, int& status);

}  // namespace playpen
