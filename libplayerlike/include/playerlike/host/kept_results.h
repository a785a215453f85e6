// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "playerlike/host/kept_run.h"
#include "playerlike/host/program.h"
#include "playerlike/host/run_settings.h"
#include "sim/world/description.h"

namespace playerlike {

/// Completes the results of a run whose program has died: writes the missing report and pictures
/// from the data that the host has kept. Trails, scans and cells are those after the last step;
/// other device data in pictures is up to 50 ms of wall time older. "state_hash" in the report is
/// null, and "ended" describes the end of the program.
/// @param world  the simulated world, with all settings applied.
/// @param settings  settings of the run: output folder, contents of pictures, and the film that was
///     being recorded; the incomplete film is removed.
/// @param end  end of the program.
/// @return whether results were missing; false for a run that is complete or never began.
/// @throws std::runtime_error naming the data that is missing or could not be written; all other
///         results are written.
/// @pre The program has ended.
bool complete_results(const KeptRun& kept, const sim::WorldDescription& world,
                      const RunSettings& settings, const ProgramEnd& end);

}  // namespace playerlike
