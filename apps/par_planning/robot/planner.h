// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef PAR_PLANNING_PLANNER_H
#define PAR_PLANNING_PLANNER_H

#include "par_common/planners.h"

// The part in which the solutions differ. Each solution implements it in its own planner.cc.

// The planner's name, for messages.
extern const char* const PLANNER_NAME;

// A path from start to goal over cells that are not blocked.
par::Path plan(const par::Mask& blocked, const par::Cell& start, const par::Cell& goal);

#endif
