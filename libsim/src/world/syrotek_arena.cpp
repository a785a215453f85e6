// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <numbers>
#include <string>
#include <utility>

#include "sim/world/robot_model.h"

// The layout, designed for this simulator: # static blocks (s1...), : dynamic blocks (d1...,
// initially retracted), = dock separators, D1... docks, ^ the start pose.
//
//       +----------------------------------------------------------------------------+
//  3.68 |                                               ###                   #######|
//       |                                               s10                   ##s14##|
//       |                                               ###                   #######|
//       | D7                                                                  #######|
//       |                                                                            |
//       |                                                                            |
//  3.21 |======                                                                      |
//       |                  ###            #######s9########                          |
//       |                  ###            ::                                         |
//       |                  ###            ::                          ###            |
//       | D6               ###            ::                         ######          |
//       |                  ###            d4                       ###s13###         |
//  2.73 |                  ###            ::                         ######          |
//       |======            ###            ::                           ##            |
//       |                  ###            ::                                         |
//       |                  s2#            ########s8#######                          |
//       | D5               ###            ##            :::                          |
//       |                  ###            ##            :::                          |
//  2.26 |                  ###            ##            :::                          |
//       |                  ###            ##            d7:                          |
//       |======            ###            ##            :::                          |
//       |                  ###            ##            :::                          |
//       |                  ###            ##            :::                          |
//       | D4               #######s6######s5            ###            ##            |
//  1.78 |                  :::            ##            ###            ##            |
//       |                  :::            ##            ###            ##            |
//       |======            :::            ##            ###           s12            |
//       |                  d1:            ##            ###            ##            |
//       |                  :::            ##            ###            ##            |
//       |                  :::            ##            ###            ##            |
//  1.31 | D3               :::            ##            s7#            ##            |
//       |                  ###            ##:::::d5:::::#########s11#####:::::d6:::::|
//       |                  ###                          ###                          |
//       |======            ###                          ###                          |
//       |                  ###                          ###                          |
//       |                  s1#                          ###                          |
//  0.83 | D2               ###                          ###                          |
//       |                  ###                          ###                          |
//       |                  ###                          ###                          |
//       |                  #########s3######            #######s4########:::::d3:::::|
//       |======            :::                                                       |
//       |           ^      :::                                                       |
//  0.36 |                  :::                                                       |
//       | D1               d2:                                                       |
//       |                  :::                                                       |
//       |                  :::                                                       |
//  0.04 |                  :::                                                       |
//       +----------------------------------------------------------------------------+
//      0.0        0.5        1.0        1.5        2.0        2.5        3.0      3.4
//
// Blocks are 0.12 m thick and stand on a lattice of 0.65 x 0.64 m, so that corridors are 0.52 m
// wide; the narrowest, between s9 and s10, is 0.30 m. Parts: the road along the docks; the long
// corridor at the bottom; two rooms in the middle that d1 to d5 open or close; a bay at the upper
// left, a bay on the right (above s4), and the open area around s13 at the upper right.
namespace sim {
namespace {

/// A block given by its corners in the drawing above.
ObstacleDescription block(std::string name, ObstacleType type, double x_min, double y_min,
                          double x_max, double y_max) {
  ObstacleDescription obstacle;
  obstacle.name = std::move(name);
  obstacle.type = type;
  obstacle.center = {0.5 * (x_min + x_max), 0.5 * (y_min + y_max)};
  obstacle.size = {x_max - x_min, y_max - y_min};
  obstacle.state =
      type == ObstacleType::kStatic ? ObstacleState::kExtended : ObstacleState::kRetracted;
  return obstacle;
}

}  // namespace

Pose syrotek_start_pose() { return {0.5, 0.4, std::numbers::pi / 2.0}; }

ArenaDescription syrotek_arena() {
  ArenaDescription arena;
  arena.preset = "syrotek";

  constexpr ObstacleType kStatic = ObstacleType::kStatic;
  constexpr ObstacleType kDynamic = ObstacleType::kDynamic;
  arena.obstacles = {
      block("s1", kStatic, 0.82, 0.52, 0.94, 1.28),  block("s2", kStatic, 0.82, 1.80, 0.94, 3.20),
      block("s3", kStatic, 0.94, 0.52, 1.59, 0.64),  block("s4", kStatic, 2.12, 0.52, 2.89, 0.64),
      block("s5", kStatic, 1.47, 1.16, 1.59, 2.56),  block("s6", kStatic, 0.94, 1.80, 1.47, 1.92),
      block("s7", kStatic, 2.12, 0.64, 2.24, 1.92),  block("s8", kStatic, 1.59, 2.44, 2.24, 2.56),
      block("s9", kStatic, 1.47, 3.08, 2.24, 3.20),  block("s10", kStatic, 2.12, 3.50, 2.24, 3.72),
      block("s11", kStatic, 2.24, 1.16, 2.89, 1.28), block("s12", kStatic, 2.77, 1.28, 2.89, 1.92),
      block("s13", kStatic, 2.68, 2.67, 2.98, 2.97), block("s14", kStatic, 3.12, 3.42, 3.42, 3.72),
      block("d1", kDynamic, 0.82, 1.28, 0.94, 1.80), block("d2", kDynamic, 0.82, 0.00, 0.94, 0.52),
      block("d3", kDynamic, 2.89, 0.52, 3.42, 0.64), block("d4", kDynamic, 1.47, 2.56, 1.59, 3.08),
      block("d5", kDynamic, 1.59, 1.16, 2.12, 1.28), block("d6", kDynamic, 2.89, 1.16, 3.42, 1.28),
      block("d7", kDynamic, 2.12, 1.92, 2.24, 2.44),
  };
  for (ObstacleDescription& obstacle : arena.obstacles) {
    if (obstacle.name == "s13") obstacle.yaw_rad = std::numbers::pi / 4.0;
  }

  // Seven docks, 0.53 m apart, with a separator between neighbours. A docked robot faces outwards.
  constexpr int kDocks = 7;
  constexpr double kDockPitch_m = 0.53;
  for (int i = 0; i < kDocks; ++i) {
    const double y_m = 0.27 + kDockPitch_m * i;
    arena.docks.push_back({"dock" + std::to_string(i + 1), {0.15, y_m, 0.0}, {0.24, 0.24}});
    if (i > 0) {
      const double between_m = y_m - 0.5 * kDockPitch_m;
      arena.dock_separators.push_back(block("separator" + std::to_string(i), kStatic, 0.0,
                                            between_m - 0.015, 0.27, between_m + 0.015));
    }
  }
  return arena;
}

}  // namespace sim
