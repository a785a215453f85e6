// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "simulation/simulation_impl.h"

namespace sim {

/// The dynamic blocks of a running world: extends and retracts them, at once or with a speed.
class Simulation::Impl::Blocks {
 public:
  explicit Blocks(Impl& owner) : impl_(owner) {}

  /// The index of a dynamic obstacle that is not carried, or the reason why there is none.
  std::optional<std::string> find_free(const std::string& name, int& index) const;
  /// @return why it cannot; nullopt if it does or waits.
  std::optional<std::string> set(int index, bool extend);
  [[nodiscard]] BlockPhase phase_of(int index) const;
  /// Must be called after each step of the physics.
  void after_step(double dt_s) {
    if (!motions_.empty()) move(dt_s);
  }
  [[nodiscard]] std::vector<MovingBlock> moving() const;
  /// All blocks are at rest.
  void reset() { motions_.clear(); }
  void archive(StateArchive& archive);

 private:
  // A block that rises, sinks or waits until it can rise.
  struct BlockMotion {
    int obstacle;
    BlockPhase phase;  // kRetracted: it waits
  };

  void move(double dt_s);
  void begin_motion(int index, BlockPhase phase);
  void end_motion(int index);
  void set_enabled(int index, bool extended);
  void record(ArenaEventKind kind, const std::string& block) { impl_.record(kind, block); }

  Impl& impl_;
  std::vector<BlockMotion> motions_;  // sorted by obstacle
};

}  // namespace sim
