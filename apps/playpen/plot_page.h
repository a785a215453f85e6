// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "plot_data.h"
#include "sim/render/drawing.h"

namespace playpen {

/// Numbers for the ticks of an axis: round, evenly spaced, within [least, most].
/// @param count  how many there may be, about.
[[nodiscard]] std::vector<double> ticks(double least, double most, int count);

/// The page of `playpen plot`: speed, turn rate, clearance and path over time on the left, the ways
/// over the scene on the right. The first run's lines are solid, those of the others dashed.
/// @pre !runs.empty()
[[nodiscard]] sim::render::Drawing plot_page(const std::vector<RunData>& runs);

}  // namespace playpen
