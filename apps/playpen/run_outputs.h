// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "playerlike/host/run_settings.h"
#include "sim/world/description.h"

/// What `run` and `serve` do about a run's time and its results.
namespace playpen {

/// Gives the settings an output folder unless they have one, makes it, and takes results of earlier
/// runs out of it, so that what lies there afterwards is of this run.
/// @param world_file  "": the default world.
/// @throws std::runtime_error naming the folder or file that can't be prepared.
void prepare_outputs(playerlike::RunSettings& settings, const std::string& world_file);

/// Whether the run has written its report.
[[nodiscard]] bool has_report(const playerlike::RunSettings& settings);

/// Whether the run's pictures are there, too.
[[nodiscard]] bool has_pictures(const playerlike::RunSettings& settings);

/// How long the run was, as its report says: simulated time [s].
[[nodiscard]] double simulated_time(const playerlike::RunSettings& settings);

/// Prints the main figures of the report, and where the pictures are.
void print_results(const playerlike::RunSettings& settings);

/// Lets time follow the wall clock, as people need it who watch.
/// @throws std::runtime_error if lockstep was asked for.
void pace_for_view(playerlike::RunSettings& settings, const sim::WorldDescription& world);

}  // namespace playpen
