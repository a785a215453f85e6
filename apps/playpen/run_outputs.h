// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "playerlike/host/run_settings.h"
#include "sim/world/description.h"

/// Time mode and results of a run, shared by `run` and `serve`.
namespace playpen {

/// Sets the output folder if the settings have none: out/NAME OF THE WORLD.
/// @param world_file  "": the default world.
void choose_output_folder(playerlike::RunSettings& settings, const std::string& world_file);

/// Chooses the output folder, creates it, and removes the results of earlier
/// runs from it, so that later content belongs to this run.
/// @param world_file  "": the default world.
/// @throws std::runtime_error that names the folder or file that can't be prepared.
void prepare_outputs(playerlike::RunSettings& settings, const std::string& world_file);

/// Whether the run has written its report.
[[nodiscard]] bool has_report(const playerlike::RunSettings& settings);

/// Whether the run has written its pictures, too.
[[nodiscard]] bool has_pictures(const playerlike::RunSettings& settings);

/// Duration of the run according to its report: simulated time [s].
[[nodiscard]] double simulated_time(const playerlike::RunSettings& settings);

/// Prints the main figures of the report, and where the pictures are.
void print_results(const playerlike::RunSettings& settings);

/// Makes time follow the wall clock, because people watch the run, unless the settings choose a
/// time mode. In lockstep, the host delays steps for the viewers, and programs do not notice.
void pace_for_view(playerlike::RunSettings& settings, const sim::WorldDescription& world);

}  // namespace playpen
