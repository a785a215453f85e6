// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace playpen {

/// Adds the command `grade` and its options.
/// @param program  the client program and its arguments, what stands behind "--".
/// @param status   gets the exit status when the command has run.
void add_grade(CLI::App& app, const std::vector<std::string>& program, int& status);

}  // namespace playpen
