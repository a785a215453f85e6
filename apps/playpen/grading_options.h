// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <optional>
#include <vector>

namespace playpen {

/// Adds an option with a number of seconds above 0. The limit must outlive the command.
void add_time_limit(CLI::App& command, const char* name, const char* description,
                    std::optional<double>& limit_s);

/// Adds --jobs, with the number of processors as the default.
/// @param jobs  receives the number, >= 1; must outlive the command.
void add_jobs(CLI::App& command, int& jobs);

/// Adds the options of `playpen grade` and `playpen class`: --seeds, --jobs and --timeout. The
/// values must outlive the command.
void add_grading_options(CLI::App& command, std::vector<std::uint64_t>& seeds, int& jobs,
                         std::optional<double>& timeout_s);

}  // namespace playpen
