// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "playerlike/host/rerun.h"
#include "playerlike/replay/replay_run.h"

namespace playpen::replay {

/// Makes a finished run again and records it for a page.
/// @param rerun  at its start; afterwards at its end.
/// @param folder  of its results: if it is not known when the program printed its lines, but they
/// are
///                in program.log there, they come at the end.
/// @param name   of the run, for people.
/// @param goals  of robots, that no device has: those of a task.
/// @throws playerlike::RecordingError as Rerun::step().
[[nodiscard]] playerlike::replay::ReplayRun replay_of(
    playerlike::Rerun& rerun, const std::string& folder, const std::string& name,
    const std::vector<playerlike::replay::GoalNote>& goals = {});

}  // namespace playpen::replay
