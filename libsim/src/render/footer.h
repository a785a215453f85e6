// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "render/layout.h"
#include "render/painter.h"
#include "sim/simulation/scene_snapshot.h"

namespace sim::render {

/// Draws what stands below a picture: scale bar, the world's name and the time in one line, and
/// under it, if there are visible layers but the base, their legend.
/// @param place         where; its left and right edge are those of the texts.
/// @param pixels_per_m  of what is above, for the scale bar.
void draw_footer(const SceneSnapshot& scene, const Layout& layout, const Rectangle& place,
                 double pixels_per_m, Painter& painter);

}  // namespace sim::render
