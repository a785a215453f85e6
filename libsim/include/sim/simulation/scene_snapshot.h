// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "sim/canvas/canvas.h"
#include "sim/canvas/layers.h"
#include "sim/devices/robot_snapshot.h"
#include "sim/world/description.h"

namespace sim {

/// Everything that a picture of a simulation needs. Plain data, which may be drawn on another
/// thread.
struct SceneSnapshot {
  std::string world_name;
  ArenaDescription arena;  ///< obstacles with their current state
  CanvasDescription canvas_description;
  std::vector<std::uint8_t> canvas;  ///< RGBA like Canvas::data(), all visible layers composed;
                                     ///< empty: no canvas
  std::vector<LayerInfo> layers;     ///< all layers, including hidden ones and the base, lowest
                                     ///< first; for legends
  ViewMode view_mode = ViewMode::kGround;
  std::vector<RobotSnapshot> robots;
  double time_s = 0.0;
};

}  // namespace sim
