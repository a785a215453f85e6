// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "host/mirror/scan_difference.h"
#include "sim/canvas/layers.h"
#include "sim/core/pose.h"

namespace playerlike {

/// The layers that show how a real robot differs from its simulation. Not thread-safe.
class MirrorLayers {
 public:
  /// Creates the layers "NAME scan difference" and, with a ghost, "NAME ghost distance".
  /// @param stack  must outlive this object.
  /// @param owner  number that orders layers, see sim::LayerInfo.
  MirrorLayers(sim::LayerStack& stack, const std::string& name, int owner, bool has_ghost);

  /// Shows the places of a difference instead of those of the last one: red where the real scan met
  /// something that the world lacks, blue where only the world has something.
  void show_scan(const ScanDifference& difference, const sim::Pose& X_WL);
  /// Adds a line from the robot to its ghost: green at 0 m, red from 0.2 m on.
  void add_distance(const sim::Vec2& p_WB, const sim::Vec2& p_WG);

 private:
  /// A point of W [m] as column and row.
  struct Cell {
    int column;
    int row;
  };
  [[nodiscard]] Cell cell_at(const sim::Vec2& p_W) const;

  sim::LayerStack& stack_;
  sim::LayerId scan_;
  std::optional<sim::LayerId> distance_;
};

}  // namespace playerlike
