// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sim/io/reader.h"
#include "sim/world/controller.h"
#include "sim/world/description.h"

/// Reads how obstacles move (docs/moving_obstacles.md).
namespace sim::io {

/// Reads the keys "motion", "mass" and "friction" of an obstacle. Its other keys must have been
/// read before.
void read_motion(Reader& obstacle, ObstacleDescription& into);

/// Reads the object of an action "move".
[[nodiscard]] MoveAction read_move(Reader& reader);

}  // namespace sim::io
