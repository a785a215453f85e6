// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "playerlike/session/device_planners.h"
#include "session/player_values/poses.h"

/// @file
/// Player's interface planner.
namespace playerlike {

/// Without the waypoints, of which messages have the number only.
template <typename Data, MaybeConst<PlannerState> State, typename Same>
void same_values(Data& data, State& state, Same same) {
  same(data.valid, state.valid);
  same(data.done, state.done);
  same(data.pos, state.pose);
  same(data.goal, state.goal);
  same(data.waypoint, state.waypoint);
  same(data.waypoint_idx, state.waypoint_index);
}

}  // namespace playerlike
