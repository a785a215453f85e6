// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "grade/evaluation.h"

namespace playpen::grade {

/// A graded run as one line of JSON, without a line end, from which read_run() gets it back.
///
/// It contains what the JSON file of a grading contains of a run, and the goal's heading. It does
/// not contain `GradedRun::asked`, which only the judging needs. Numbers keep all their bits, as
/// long as they are finite. In texts, bytes that are not UTF-8 become U+FFFD.
[[nodiscard]] std::string run_text(const GradedRun& run);

/// Reads a run from the text that run_text() has made of it. Its member `asked` is empty.
/// @return nullopt if the text is anything else: cut short, edited so that it contradicts itself,
///         or written by a version with other members.
[[nodiscard]] std::optional<GradedRun> read_run(std::string_view text);

}  // namespace playpen::grade
