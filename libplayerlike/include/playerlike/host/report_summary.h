// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace playerlike {

/// The main figures of a run's report.json as a short table for a terminal: simulated and wall
/// time, real-time factor, seed; path, collisions, least clearance and stalled time of each robot.
/// @param file  the report.
/// @return lines of at most 100 columns (but for long names), each ended by '\n'.
/// @throws std::runtime_error naming the file if it can't be read or is no such report.
[[nodiscard]] std::string summarize_report(const std::string& file);

/// How long a run was, as its report.json says: simulated time [s].
/// @throws std::runtime_error as summarize_report().
[[nodiscard]] double simulated_time_of_report(const std::string& file);

}  // namespace playerlike
