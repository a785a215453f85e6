// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "planner.h"

const char* const PLANNER_NAME = "Theta*";

// A way of any angle: it turns at corners only, so that smoothing leaves nearly all of it as it is.
par::Path plan(const par::Mask& blocked, const par::Cell& start, const par::Cell& goal) {
  return par::theta_star(blocked, start, goal);
}
