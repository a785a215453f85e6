// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "playerlike/host/rerun.h"
#include "replay/replay_run.h"

namespace playpen::replay {

/// Makes a finished run again and records it for a page.
/// @param rerun  at its start; afterwards at its end.
/// @param name   of the run, for people.
/// @param goals  of robots, that no device has: those of a task.
/// @throws playerlike::RecordingError as Rerun::step().
[[nodiscard]] ReplayRun replay_of(playerlike::Rerun& rerun, const std::string& name,
                                  const std::vector<GoalNote>& goals = {});

}  // namespace playpen::replay
