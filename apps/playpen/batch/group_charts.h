// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "batch/batch_results.h"
#include "batch/chart.h"

namespace playpen::batch {

/// The chart of a figure over groups of runs. If a parameter has several values that are numbers,
/// it is the horizontal axis (of several such parameters the one with the most values), and what
/// else differs makes the series; otherwise programs make the series, and each other difference a
/// row.
/// @param figure  name of a figure that some group has.
[[nodiscard]] Chart chart_of(const Batch& batch, const std::vector<GroupSummary>& groups,
                             const std::string& figure);

/// Draws a chart for each figure that differs between runs: FIGURE.png. Other charts of the folder
/// are removed.
/// @throws std::exception that names the file that can't be written.
void write_charts(const Batch& batch, const std::vector<GroupSummary>& groups,
                  const std::filesystem::path& folder);

}  // namespace playpen::batch
