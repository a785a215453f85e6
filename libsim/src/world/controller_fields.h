// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "sim/core/fields.h"
#include "sim/world/controller.h"
#include "world/motion_fields.h"

namespace sim {

SIM_HAS_FIELDS(CanvasAction::Area)
SIM_HAS_FIELDS(ArenaPlace)
SIM_HAS_FIELDS(ArenaConfiguration)
SIM_HAS_FIELDS(TimerDescription)
SIM_HAS_FIELDS(TrapDescription)
SIM_HAS_FIELDS(ControllerDescription)

/// The regions of traps by their keys in files: those of the floor, and last the surroundings of an
/// object.
[[nodiscard]] std::span<const Kind> region_kinds();

namespace io {

/// @name Formats of fields in world files
/// @{
extern const CustomField kTrapRegionFormat;  ///< the keys "region" and "near" of a trap
extern const CustomField kTrapRobotsFormat;  ///< a list of names, or "any"
extern const CustomField kTrapStayFormat;    ///< only for traps that need it
extern const CustomField kFirstTimeFormat;   ///< by default the period
extern const CustomField kRandomTimeFormat;  ///< not with a first time
extern const CustomField kMoveFormat;        ///< the motion of a MoveAction
extern const CustomField kNearPlaceFormat;   ///< instead of an object
/// @}

}  // namespace io

}  // namespace sim
