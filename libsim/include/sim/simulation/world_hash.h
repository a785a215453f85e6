// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "sim/world/description.h"

namespace sim {

/// Tells worlds apart: a hash of what a run depends on, except what RunSettings of a host may
/// change (seed, duration, time mode and factor, view mode).
///
/// Arena, obstacles, walls, models, robots, their devices with all numeric settings, the canvas
/// and the step count; the names of files do not. Equal descriptions give equal hashes on every
/// machine of one byte order; two different worlds give the same one only by chance (2^-64).
[[nodiscard]] std::uint64_t world_hash(const WorldDescription& world);

}  // namespace sim
