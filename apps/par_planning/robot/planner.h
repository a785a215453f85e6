// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef PAR_PLANNING_PLANNER_H
#define PAR_PLANNING_PLANNER_H

#include "par_common/planners.h"

// What the solutions differ in; each has it in its own planner.cc.

// For messages.
extern const char* const PLANNER_NAME;

// A way from start to goal over cells that are not blocked.
par::Path plan(const par::Mask& blocked, const par::Cell& start, const par::Cell& goal);

#endif
