// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "planner.h"

const char* const PLANNER_NAME = "Theta*";

// An any-angle path. It turns only at corners of obstacles, so smoothing changes little.
par::Path plan(const par::Mask& blocked, const par::Cell& start, const par::Cell& goal) {
  return par::theta_star(blocked, start, goal);
}
