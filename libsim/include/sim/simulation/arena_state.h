// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace sim {

/// State of a timer or trap of the arena controller.
struct ArenaTrigger {
  std::string name;                   ///< unique among timers and traps
  bool enabled = false;               ///< whether it is on
  std::uint64_t count = 0;            ///< how often it has acted since the start or the last reset
  std::optional<double> time_left_s;  ///< of a timer: until it acts next [s]; none: it does not, or
                                      ///< the simulation has not begun to step
};

/// State of the arena controller, besides what it has done: see Simulation::arena_events(),
/// scores() and verdict().
struct ArenaState {
  std::string configuration;         ///< the last one since the start or the last reset; "": none
  std::vector<ArenaTrigger> timers;  ///< in the world's order
  std::vector<ArenaTrigger> traps;   ///< in the world's order
};

}  // namespace sim
