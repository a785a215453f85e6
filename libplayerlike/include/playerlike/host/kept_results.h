// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "playerlike/host/kept_run.h"
#include "playerlike/host/program.h"
#include "playerlike/host/run_settings.h"
#include "sim/world/description.h"

namespace playerlike {

/// Writes those results of a run that its program has not completed before it died: the report, and
/// then the pictures, from what its host has kept. Trails, scans and cells are those after the last
/// step; what else pictures show of devices is up to 50 ms of wall time older. The report has no
/// "state_hash" (null) unless it is known, and its "ended" tells of the program's end.
/// @param world   what was run, with all settings; it is only looked at.
/// @param settings  of the run: its output folder, what its pictures show, and the film that was to
///                be recorded; what is there of that is of no use, and removed.
/// @param end     the program's.
/// @return whether there was something to complete; false for a run that is done or never began.
/// @throws std::runtime_error saying what could not be written, or is not there; the rest is
/// written.
/// @pre The program has ended.
bool complete_results(const KeptRun& kept, const sim::WorldDescription& world,
                      const RunSettings& settings, const ProgramEnd& end);

}  // namespace playerlike
