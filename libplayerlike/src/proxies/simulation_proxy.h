// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace playerlike {

/// While an object exists, SimulationProxy throws errors in this thread that it otherwise only logs
/// as warnings. For callers that report errors in another way, such as the C library.
class StrictSimulation {
 public:
  StrictSimulation() noexcept;
  StrictSimulation(const StrictSimulation&) = delete;
  StrictSimulation& operator=(const StrictSimulation&) = delete;
  ~StrictSimulation();

  /// Whether an object exists in the calling thread.
  [[nodiscard]] static bool holds() noexcept;
};

}  // namespace playerlike
