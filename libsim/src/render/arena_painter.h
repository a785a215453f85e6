// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "render/layout.h"
#include "render/painter.h"
#include "sim/world/description.h"

/// What stands still in an arena.
namespace sim::render {

/// Floor, its grid, and docks.
void draw_ground(const ArenaDescription& arena, const Layout& layout, Painter& painter);

/// Outlines of retracted obstacles, for over floor and canvas.
void draw_retracted(const ArenaDescription& arena, const Layout& layout, Overlay::Canvas& overlay);

/// Borders, separators, blocks and walls, with their shadows.
void draw_solids(const ArenaDescription& arena, const Layout& layout, Overlay::Canvas& overlay);

}  // namespace sim::render
