// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "planner.h"

const char* const PLANNER_NAME = "Dijkstra";

// The shortest path over the grid's 8 neighbours. It turns in steps of 45 degrees; the smoothing by
// line of sight that follows straightens it.
par::Path plan(const par::Mask& blocked, const par::Cell& start, const par::Cell& goal) {
  return par::dijkstra(blocked, start, goal);
}
