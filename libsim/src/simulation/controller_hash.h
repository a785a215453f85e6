// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sim/core/hash.h"
#include "sim/world/controller.h"

namespace sim {

/// Adds the motion of an obstacle to a hash of the world.
void add_motion(StateHash& hash, const ObstacleMotion& motion);

/// Adds the arena controller of a world to a hash of the world.
void add_controller(StateHash& hash, const ControllerDescription& controller);

}  // namespace sim
