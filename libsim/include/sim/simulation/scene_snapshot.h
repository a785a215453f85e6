// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim/canvas/canvas.h"
#include "sim/canvas/layers.h"
#include "sim/devices/robot_snapshot.h"
#include "sim/simulation/arena_event.h"
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

/// A text that the arena controller shows.
struct SceneText {
  Vec2 place = Vec2::Zero();          ///< of its middle, in W [m]
  std::string text;                   ///< UTF-8
  Colour colour;                      ///< of the letters
  std::optional<double> time_left_s;  ///< [s]; none: until the end of the run
};

/// A dynamic block that rises, sinks, or waits until it can rise.
struct MovingBlock {
  int obstacle = 0;                        ///< index in the arena
  BlockPhase phase = BlockPhase::kRising;  ///< kRetracted: it waits
  double height_m = 0.0;                   ///< present height [m]
};

/// The path along which an obstacle moves.
struct ObstacleTrack {
  int obstacle = 0;          ///< index in the arena
  std::vector<Vec2> points;  ///< where the path began, then its waypoints, in W [m]
  bool closed = false;       ///< whether the first point follows the last one
};

/// A trap of the arena controller.
struct TrapMark {
  std::string name;
  Polygon outline;             ///< in W [m]; empty: a circle
  Vec2 center = Vec2::Zero();  ///< of the circle, in W [m]
  double radius_m = 0.0;       ///< of the circle [m]
  bool enabled = true;
  std::vector<int> robots;  ///< indices of the robots inside
};

/// A timer of the arena controller, for countdowns.
struct TimerMark {
  std::string name;
  std::optional<double> time_left_s;  ///< until it acts next [s]; none: it does not
};

/// How long events are shown, simulated time [s].
inline constexpr double kShownEventTime_s = 1.0;

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
  std::vector<RobotSnapshot> ghosts;      ///< drawn half transparent; the caller adds them
  std::vector<CollisionMark> collisions;  ///< oldest first; the caller records them, like trails
  std::vector<GoalMark> goals;            ///< oldest first; the caller records them
  double time_s = 0.0;
  std::vector<SceneText> texts;            ///< of the arena controller, oldest first
  std::vector<MovingBlock> moving_blocks;  ///< by obstacle
  std::vector<ObstacleTrack> tracks;       ///< of the obstacles that follow a path, by obstacle
  std::vector<TrapMark> traps;             ///< in the world's order
  std::vector<TimerMark> timers;           ///< in the world's order
  std::vector<double> scores;              ///< points of the robots; empty: no arena controller
  std::optional<Verdict> verdict;          ///< how the arena controller ended the run
  std::vector<ArenaEvent> events;          ///< of the last kShownEventTime_s, oldest first
};

}  // namespace sim
