// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "grade/evaluation.h"
#include "grade/task.h"

namespace playpen::grade {

/// The grade of a program: its runs, in the order of worlds and seeds.
struct Grade {
  Task task;
  std::vector<std::string> program;  ///< with the arguments that the user gave
  std::vector<GradedRun> runs;

  [[nodiscard]] std::size_t passed() const noexcept;
};

/// How a table is laid out.
struct TableStyle {
  std::size_t columns = 80;  ///< characters that a line of the table may have
  bool colour = false;       ///< whether verdicts are coloured, for terminals (ECMA-48)
};

/// The grade for people: a line a run, the faults of those that do not pass, and a summary.
/// "-" stands for what was not measured; a measure that no run has gets no column. Where the table
/// has less room than it needs, it loses blanks first, then the worlds' names, which become
/// headings, and at last the rightmost columns (the JSON has them all). Sentences below the table
/// are not broken: they may be longer than a line.
[[nodiscard]] std::string table(const Grade& grade, const TableStyle& style = {});

/// The grade for programs, as JSON (docs/grading.md). Equal grades give equal text but for the
/// members called wall_time.
[[nodiscard]] std::string json_text(const Grade& grade);

}  // namespace playpen::grade
