// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace playerlike {

/// While one lives, SimulationProxy throws in its thread what it otherwise only warns of: for who
/// has a way of telling it, such as the C library.
class StrictSimulation {
 public:
  StrictSimulation() noexcept;
  StrictSimulation(const StrictSimulation&) = delete;
  StrictSimulation& operator=(const StrictSimulation&) = delete;
  ~StrictSimulation();

  /// Whether one lives in the calling thread.
  [[nodiscard]] static bool holds() noexcept;
};

}  // namespace playerlike
