// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "sim/canvas/canvas.h"
#include "sim/canvas/layers.h"
#include "sim/devices/robot_snapshot.h"
#include "sim/world/description.h"

namespace sim {

/// The place of a collision.
struct CollisionMark {
  int robot = 0;              ///< index
  Vec2 place = Vec2::Zero();  ///< in W [m]
  double time_s = 0.0;
};

/// The goal of a robot.
struct GoalMark {
  int robot = 0;              ///< index
  Vec2 place = Vec2::Zero();  ///< in W [m]
  bool reached = false;
  bool newest = true;  ///< whether it is the robot's newest goal
};

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
  std::vector<CollisionMark> collisions;  ///< oldest first; the caller records them, like trails
  std::vector<GoalMark> goals;            ///< oldest first; the caller records them
  double time_s = 0.0;
};

}  // namespace sim
