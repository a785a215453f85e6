// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "grade/evaluation.h"
#include "grade/task.h"

namespace playpen::grade {

/// The grade of a program: its runs, ordered by world and seed.
struct Grade {
  Task task;
  std::vector<std::string> program;  ///< including the arguments that the user gave
  std::vector<GradedRun> runs;
  bool isolated = false;  ///< whether the programs ran in a sandbox

  [[nodiscard]] std::size_t passed() const noexcept;
};

/// Layout and content of a table.
struct TableStyle {
  std::size_t columns = 80;  ///< maximum width of a table line [characters]
  bool colour = false;       ///< whether verdicts are coloured, for terminals (ECMA-48)
  /// Lines that help to find out why a run has failed; empty: none.
  std::function<std::vector<std::string>(const GradedRun&)> advice = {};
};

/// The grade as text: one line per run, the faults of the failed runs, and a summary. A fault that
/// several runs of a world have in common is one line. After the faults of a world follows the
/// advice for the first run of each kind of end. "-" marks a measure without a value; a measure
/// without any values has no column. If the table is too wide, it first loses blanks; then the
/// worlds' names become headings; at last the rightmost columns are dropped (the JSON has them
/// all). Sentences below the table are not wrapped: they may be longer than a line.
[[nodiscard]] std::string table(const Grade& grade, const TableStyle& style = {});

/// The cells of the table for other layouts: the headings, then a row per run. Measures without any
/// values have no column, and neither has the wall-clock time.
[[nodiscard]] std::vector<std::vector<std::string>> table_cells(const Grade& grade);

/// The grade as JSON (docs/grading.md), for programs. Equal grades give equal text, except for the
/// members called wall_time.
[[nodiscard]] std::string json_text(const Grade& grade);

}  // namespace playpen::grade
