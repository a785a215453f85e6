// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "playerlike/host/run_settings.h"
#include "sim/core/log.h"
#include "sim/simulation/simulation.h"

namespace playerlike {

/// The simulation of a run at its beginning: in the state that the settings name, if they do.
/// @throws sim::ConfigError if the world or the settings are invalid; run/start if the state cannot
///     be read or belongs to another world.
[[nodiscard]] sim::Simulation simulation_at_start(sim::WorldDescription world,
                                                  const RunSettings& settings,
                                                  const sim::LogHook& log);

}  // namespace playerlike
