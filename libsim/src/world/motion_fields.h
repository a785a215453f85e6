// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "sim/core/fields.h"
#include "sim/world/obstacle_motion.h"

namespace sim {

SIM_HAS_FIELDS(ObstacleMotion::Area)
SIM_HAS_FIELDS(SocialForce)
SIM_HAS_FIELDS(ObstacleMotion)

/// The motions of obstacles by their "type" in files. Their value is an ObstacleMotion.
[[nodiscard]] std::span<const Kind> motion_kinds();

/// What all motions have: speed, turn rate and whether the obstacle turns where it goes.
[[nodiscard]] const FieldTable& drive_fields();

/// What a path has that the arena controller begins, besides drive_fields().
[[nodiscard]] const FieldTable& path_fields();

/// All keys of a motion that the arena controller begins.
[[nodiscard]] const FieldTable& move_fields();

}  // namespace sim
