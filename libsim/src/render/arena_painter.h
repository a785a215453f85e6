// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "render/layout.h"
#include "render/painter.h"
#include "sim/world/description.h"

/// Painting of the static parts of an arena.
namespace sim::render {

/// Draws floor, grid and docks.
void draw_ground(const ArenaDescription& arena, const Layout& layout, Painter& painter);

/// Draws outlines of retracted obstacles above floor and canvas.
void draw_retracted(const ArenaDescription& arena, const Layout& layout, Overlay::Canvas& overlay);

/// Draws borders, separators, blocks and walls, with their shadows. Blocks that rise or sink, and
/// obstacles that move or can be pushed, are left out.
void draw_solids(const ArenaDescription& arena, const Layout& layout, Overlay::Canvas& overlay);

}  // namespace sim::render
