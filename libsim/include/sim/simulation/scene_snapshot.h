// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "sim/canvas/canvas.h"
#include "sim/canvas/layers.h"
#include "sim/devices/robot_snapshot.h"
#include "sim/world/description.h"

namespace sim {

/// All that a picture of a simulation needs. Plain data: may be drawn on another thread.
struct SceneSnapshot {
  std::string world_name;
  ArenaDescription arena;  ///< obstacles with their present state
  CanvasDescription canvas_description;
  std::vector<std::uint8_t> canvas;  ///< RGBA as Canvas::data(), all visible layers over one
                                     ///< another; empty: no canvas
  std::vector<LayerInfo> layers;     ///< all, hidden ones and the base too, lowest first; for
                                     ///< legends
  ViewMode view_mode = ViewMode::kGround;
  std::vector<RobotSnapshot> robots;
  double time_s = 0.0;
};

}  // namespace sim
