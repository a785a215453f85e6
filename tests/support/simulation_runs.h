// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "sim/core/number_text.h"
#include "sim/simulation/simulation.h"

/// Running simulations whose steps take 0.01 s.
namespace sim::test {

/// Commands a robot to drive straight ahead.
inline void drive(Simulation& simulation, double speed_mps, int robot = 0) {
  const int motion = simulation.find_device(robot, "motion").value();
  ASSERT_FALSE(simulation.apply({robot, motion}, TwistCommand{{.v_mps = speed_mps}}));
}

inline void run(Simulation& simulation, double duration_s) {
  const auto steps = static_cast<int>(std::lround(duration_s / 0.01));
  for (int i = 0; i < steps; ++i) simulation.step();
}

/// Each recorded event as "TIME DESCRIPTION".
[[nodiscard]] inline std::vector<std::string> events_of(const Simulation& simulation) {
  std::vector<std::string> lines;
  for (const ArenaEvent& event : simulation.arena_events().newest) {
    lines.push_back(fixed_text(to_seconds(event.time_ns), 2) + ' ' + description(event));
  }
  return lines;
}

/// Commands robots before step `i`, equally in each run.
using Interfere = void (*)(Simulation& simulation, int i);

/// Runs two simulations of the same world and expects equal states and events.
inline void expect_equal_runs(Simulation& a, Simulation& b, Interfere interfere, int steps) {
  for (int i = 0; i < steps; ++i) {
    interfere(a, i);
    a.step();
    interfere(b, i);
    b.step();
    if (i % 50 != 0) continue;
    ASSERT_EQ(a.state_hash(), b.state_hash()) << i;
  }
  EXPECT_EQ(events_of(a), events_of(b));
}

/// Runs a world without a break, and a second time with a new simulation from a snapshot every
/// `period` steps. Expects equal states, events and scores.
/// @param look  is called with the second simulation before each snapshot.
inline void expect_equal_after_snapshots(const WorldDescription& world, Interfere interfere,
                                         int steps, int period,
                                         const std::function<void(const Simulation&)>& look = {}) {
  Simulation whole(world);
  Simulation restored(world);
  for (int i = 0; i < steps; ++i) {
    interfere(whole, i);
    whole.step();
    interfere(restored, i);
    restored.step();
    if (i % period == 0) {
      if (look) look(restored);
      const Snapshot snapshot = restored.save();
      Simulation other(world);
      other.restore(snapshot);
      ASSERT_EQ(other.save(), snapshot) << i;
      restored = std::move(other);
    }
    ASSERT_EQ(restored.state_hash(), whole.state_hash()) << i;
  }
  EXPECT_EQ(events_of(restored), events_of(whole));
  EXPECT_EQ(restored.scores(), whole.scores());
}

}  // namespace sim::test
