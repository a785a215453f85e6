// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "sim/simulation/arena_event.h"
#include "sim/simulation/simulation.h"

namespace playerlike::replay {

/// What a simulation adds to its lists, which keep only the newest elements. Not thread-safe.
class HappeningsWatch {
 public:
  /// New since the last look, oldest first. Valid until the next step.
  struct Happenings {
    std::span<const sim::Collision> collisions;
    std::vector<sim::ArenaEvent> events;
    std::span<const sim::SpokenText> spoken;
  };

  /// Call it after each step. What does not fit into a list between two calls is lost.
  [[nodiscard]] Happenings look(const sim::Simulation& simulation);

 private:
  std::uint64_t collisions_ = 0;  ///< number of all collisions so far
  std::uint64_t events_ = 0;      ///< number of the newest arena event so far
  std::size_t spoken_ = 0;        ///< length of the simulation's list at the last call
  sim::SpokenText newest_;        ///< spoken, if spoken_ > 0
};

}  // namespace playerlike::replay
