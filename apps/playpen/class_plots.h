// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>

#include "course/class_result.h"

namespace playpen {

/// Draws the charts of the runs that the pages of a class show (course::shown_runs()), as plot.png
/// in the folder of each run, by one process of `playpen plot` per run. `playpen replay`
/// writes their replays in the same way, as course::kReplayFile.
///
/// A plot that is newer than the report and the trajectory of its run is kept. Plots of other runs
/// that are older are removed. A plot that cannot be drawn, or takes more than 30 s, is left out:
/// the trajectory of a program that deceives may be anything.
///
/// @param out   the output folder of the class.
/// @param replays  whether replays are written, too.
/// @param jobs  number of processes that run concurrently, >= 1.
/// @param on_progress  if set, called with the numbers of ended and of all processes, at the start
///                     and whenever one has ended. Not called if there is nothing to draw.
/// @return false if this process was told to stop before the end. The next call goes on.
/// @throws playerlike::ProgramError if no process can be started.
/// @note Call it from a command's main thread, see playerlike::run_programs().
[[nodiscard]] bool draw_class_plots(
    const course::ClassResult& result, const std::filesystem::path& out, int jobs, bool replays,
    const std::function<void(std::size_t ended, std::size_t all)>& on_progress = {});

/// Removes the plots and replays of a class that are older than the results of their runs.
void remove_stale_plots(const course::ClassResult& result, const std::filesystem::path& out);

}  // namespace playpen
