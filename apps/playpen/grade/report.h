// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

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

/// The grade for people: a line a run, the faults of those that do not pass, and a summary.
/// "-" stands for what was not measured.
[[nodiscard]] std::string table(const Grade& grade);

/// The grade for programs, as JSON (docs/grading.md). Equal grades give equal text but for the
/// members called wall_time.
[[nodiscard]] std::string json_text(const Grade& grade);

}  // namespace playpen::grade
