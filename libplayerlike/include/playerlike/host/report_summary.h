// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace playerlike {

/// Returns the main results in a run's report.json as a short table for a terminal: simulated time,
/// wall time, real-time factor and seed; for each robot its path length, collisions, minimum
/// clearance and stalled time.
/// @param file  path of the report.
/// @return lines of at most 100 columns (unless names are long), each ended by '\n'.
/// @throws std::runtime_error naming the file, if it cannot be read or is not a report.
[[nodiscard]] std::string summarize_report(const std::string& file);

/// Returns the simulated duration of a run from its report.json [s].
/// @throws std::runtime_error for the same errors as summarize_report().
[[nodiscard]] double simulated_time_of_report(const std::string& file);

}  // namespace playerlike
