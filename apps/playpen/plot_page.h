// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "plot_data.h"
#include "sim/render/drawing.h"

namespace playpen {

/// Draws the page of `playpen plot`. The left side shows speed, turn rate, clearance and path
/// length over time; crosses mark collisions, diamonds reached goals. The right side shows the
/// trajectories, on one scene for each world. The first run has solid curves, the other runs have
/// dashed curves.
/// @pre !runs.empty()
[[nodiscard]] sim::render::Drawing plot_page(const std::vector<RunData>& runs);

}  // namespace playpen
