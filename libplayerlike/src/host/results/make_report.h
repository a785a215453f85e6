// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "playerlike/host/report.h"
#include "playerlike/messages/messages.h"
#include "sim/simulation/simulation.h"

namespace playerlike {

class Recorder;

/// The report of a run. It lacks the hash of the state, which takes long for a large canvas.
/// @param end  nullopt: the run goes on.
[[nodiscard]] Report make_report(const sim::Simulation& simulation, const Recorder& recorder,
                                 const TimeStatistics& time, std::optional<RunEnd> end);

}  // namespace playerlike
