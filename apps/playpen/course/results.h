// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "course/class_result.h"
#include "grade/text.h"

namespace playpen::course {

/// Why a submission has not passed everywhere, in one sentence: why there is no program, or the
/// reason that most of its runs have, and how many. "": all runs passed.
[[nodiscard]] std::string main_reason(const SubmissionResult& submission);

/// Why a run failed, in words for its student: its faults, where it first hit something (see
/// grade::contact_text()) unless a fault says that, and what to look for. Empty for a run that has
/// passed.
[[nodiscard]] std::vector<std::string> reasons_of(const grade::GradedRun& run);

using grade::plain_text;

/// The indices of the submissions, those with the most points first; equals in the order of ids.
[[nodiscard]] std::vector<std::size_t> ranking(const ClassResult& result);

/// The class as a table for a terminal: a line per submission, those with the most points first;
/// suspicious pairs; and a summary.
/// @param columns  the width of lines; longer reasons are cut.
[[nodiscard]] std::string class_table(const ClassResult& result, std::size_t columns);

/// The class as CSV (RFC 4180), a line per submission in the order of ids. Values that a
/// spreadsheet would take for a formula begin with a quote (').
[[nodiscard]] std::string csv_text(const ClassResult& result);

/// The class as JSON (docs/class.md). Equal classes give equal text, except for the members called
/// wall_time.
[[nodiscard]] std::string json_text(const ClassResult& result);

/// The class in the XML format that JUnit has introduced: a test suite per submission, a test case
/// per build and run. The element names and attributes are those of
/// https://github.com/testmoapp/junitxml
[[nodiscard]] std::string junit_text(const ClassResult& result);

/// A submission as results.json of Gradescope
/// (https://gradescope-autograders.readthedocs.io/en/latest/specs/#output-format).
[[nodiscard]] std::string gradescope_text(const SubmissionResult& submission);

/// Writes class.json, results.csv, junit.xml and, for each submission, its results.json into the
/// output folder.
/// @throws std::runtime_error that names the file that cannot be written.
void write_results(const ClassResult& result, const std::filesystem::path& folder);

}  // namespace playpen::course
