// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim/core/fields.h"
#include "sim/core/pose.h"
#include "sim/world/obstacle_motion.h"

namespace sim {

/// What `playpen fuzz` may change in a world: its section "fuzz" (docs/fuzz.md). The simulation
/// ignores it. Pairs are [least, greatest].
struct FuzzDescription {
  /// Things on the floor.
  struct Obstacles {
    int most = 8;               ///< of a scenario, without the walls of generated maps
    Vec2 size_m = {0.03, 0.6};  ///< of a side or a diameter [m]
    std::vector<std::string> shapes = {"box", "circle", "triangle", "door", "corridor"};  ///< words
  };
  /// Doors and corridors.
  struct Passages {
    std::optional<Vec2> width_m = {};  ///< of the free space [m]; none: it follows from the robot
  };
  /// Obstacles that move.
  struct Moving {
    Vec2 speed_mps = {0.05, 0.4};  ///< [m/s]
  };
  /// Generated maps.
  struct Maps {
    std::vector<std::string> kinds = {"maze", "rooms"};  ///< of maps
  };
  /// Errors of devices during the whole run.
  struct Noise {
    bool real = true;              ///< the level of realism `real` may be set
    Vec2 latency_s = {0.05, 0.3};  ///< of the laser [s]
    Vec2 dropouts = {0.01, 0.2};   ///< share of the laser's beams that measure nothing
  };

  /// Faults of the robot's devices, which begin during a run.
  struct Faults {
    int most = 2;                                                                ///< of a scenario
    std::vector<std::string> kinds = {"dead", "gap", "blind", "jump", "drift"};  ///< what is wrong
    Vec2 at_s = {1.0, 20.0};  ///< when they begin [s]
  };

  std::vector<std::string> without;          ///< what is not changed
  std::vector<std::string> with;             ///< what is changed only if asked for
  std::optional<ObstacleMotion::Area> area;  ///< of starts and added things; none: the floor
  Obstacles obstacles;                       ///< things on the floor
  Passages doors;                            ///< in walls
  Passages corridors;                        ///< between walls
  Moving moving;                             ///< of obstacles
  Maps maps;                                 ///< generated ones
  Noise noise;                               ///< during the whole run
  Faults faults;                             ///< from a time on
};

SIM_HAS_FIELDS(FuzzDescription::Obstacles)
SIM_HAS_FIELDS(FuzzDescription::Passages)
SIM_HAS_FIELDS(FuzzDescription::Moving)
SIM_HAS_FIELDS(FuzzDescription::Maps)
SIM_HAS_FIELDS(FuzzDescription::Noise)
SIM_HAS_FIELDS(FuzzDescription::Faults)
SIM_HAS_FIELDS(FuzzDescription)

}  // namespace sim
