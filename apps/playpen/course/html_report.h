// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "course/class_result.h"

namespace playpen::course {

/// The overview of a class as an HTML page: the ranking, sortable by its columns, and the
/// suspicious pairs with their pictures. Links are relative to the output folder.
[[nodiscard]] std::string overview_page(const ClassResult& result);

/// The name of a run's charts in its folder. The report shows them, but does not draw them.
inline constexpr const char* kPlotFile = "plot.png";
/// Name of the replay of a run in its folder.
inline constexpr const char* kReplayFile = "replay.html";

/// The runs of a grade whose pictures and charts a page shows: the best one and, if it is another
/// one, the worst one. Empty if there are no runs.
[[nodiscard]] std::vector<const grade::GradedRun*> shown_runs(const grade::Grade& grade);

/// The page of a submission: its runs, the pictures and charts of its best and worst run, the
/// reasons why runs failed, what the program printed then, how to repeat such a run, and what the
/// compiler printed. Links are relative to the folder of the submission. Pictures, charts and logs
/// that are missing are left out. The page shows nothing of other submissions, so that it can be
/// given to its student.
/// @param index   of the submission.
/// @param folder  the output folder, for pictures and logs.
[[nodiscard]] std::string submission_page(const ClassResult& result, std::size_t index,
                                          const std::filesystem::path& folder);

/// Writes the report of a class: index.html in the output folder, and an index.html in the folder
/// of each submission. The pages need no network and no other file but the pictures beside them.
/// Equal classes give equal pages, except for wall-clock times in the logs. Whatever submissions
/// contain is shown as text; pages of submissions run no scripts.
/// @throws std::runtime_error that names the file that cannot be written.
void write_html_report(const ClassResult& result, const std::filesystem::path& folder);

}  // namespace playpen::course
