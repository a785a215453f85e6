// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "playerlike/messages/messages.h"
#include "sim/simulation/scene_snapshot.h"
#include "sim/simulation/simulation.h"

namespace playerlike {

/// Writes report.json, scene.png and canvas.png into `folder`.
/// @throws std::runtime_error naming the file that could not be written.
void write_outputs(const std::string& folder, const sim::Simulation& simulation,
                   const sim::SceneSnapshot& scene, const TimeStatistics& time);

}  // namespace playerlike
