// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "render/layout.h"
#include "render/painter.h"
#include "sim/simulation/scene_snapshot.h"

namespace sim::render {

/// Draws the footer of a picture: scale bar, the world's name and the time in one line, and a
/// legend below if there are visible layers other than the base. The verdict of an arena controller
/// is in the second line; if the legend is there, it replaces the world's name.
/// @param place         area of the footer; its left and right edges align the texts.
/// @param pixels_per_m  of the picture above, for the scale bar.
void draw_footer(const SceneSnapshot& scene, const Layout& layout, const Rectangle& place,
                 double pixels_per_m, Painter& painter);

}  // namespace sim::render
