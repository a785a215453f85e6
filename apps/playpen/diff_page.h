// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "diff/run_difference.h"
#include "plot_data.h"
#include "sim/render/drawing.h"

namespace playpen {

/// Draws the page of `playpen diff`. The left side shows the distance between the robots of both
/// runs and the difference of their headings over time, on logarithmic axes; dots mark the first
/// times at which limits are exceeded. The right side shows both trajectories in the arena of the
/// first run, with labels at the places where they part.
/// @param runs  the first and the second run.
[[nodiscard]] sim::render::Drawing diff_page(const std::vector<RunData>& runs,
                                             const diff::RunDifference& difference);

}  // namespace playpen
