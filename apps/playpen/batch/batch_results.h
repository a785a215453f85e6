// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "batch/statistics.h"
#include "batch/units.h"
#include "grade/evaluation.h"

namespace playpen::batch {

/// A batch and the runs of its units that have ended, wherever they ran.
struct BatchResult {
  const Batch& batch;
  std::vector<std::optional<grade::GradedRun>> runs;  ///< by unit; nullopt: it has no results

  [[nodiscard]] std::size_t ended() const noexcept;
  [[nodiscard]] std::size_t passed() const noexcept;
};

/// Whether a run ended as the program wanted: not by a signal, a bad status or a limit of time or
/// output. Its figures may still not satisfy the task.
[[nodiscard]] bool ended_well(const grade::GradedRun& run);

/// Reads the results of all units.
/// @param batch  must outlive the result.
[[nodiscard]] BatchResult collect(const Batch& batch, const std::filesystem::path& out);

/// A figure of the runs of one program under one condition.
struct FigureSummary {
  std::string name;            ///< as in grade.json; "passed" for the verdict
  std::string unit;            ///< "": none
  bool is_yes_or_no = false;   ///< `summary` then has only count, mean (the share) and interval
  Summary summary;             ///< of the runs that have the figure
  std::vector<double> values;  ///< by seed
};

/// The runs of one program under one condition.
struct GroupSummary {
  std::size_t program = 0;
  std::size_t condition = 0;
  std::size_t units = 0;
  std::size_t ended = 0;
  std::vector<FigureSummary> figures;  ///< those with values, "passed" first
};

/// Summarises the runs over their seeds, in the order of the units.
[[nodiscard]] std::vector<GroupSummary> summarize(const BatchResult& result);

/// A line for each program and condition, for people.
/// @param columns  width of the terminal [characters].
[[nodiscard]] std::string batch_table(const BatchResult& result,
                                      const std::vector<GroupSummary>& groups, std::size_t columns);

/// Writes results.csv (a line for each unit), statistics.csv (a line for each figure of a group),
/// batch.json and a chart for each figure that differs between runs (docs/batch.md). Equal results
/// give equal files, except for the members and columns called wall_time.
/// @throws std::exception that names the file that can't be written.
void write_results(const BatchResult& result, const std::vector<GroupSummary>& groups,
                   const std::filesystem::path& out);

}  // namespace playpen::batch
