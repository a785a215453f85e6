// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "sim/simulation/simulation.h"

namespace playpen::testing {

/// The solid that is nearest to a robot's body.
struct NearestSolid {
  double distance_m = 0.0;  ///< 0 if they overlap; infinite if there is no solid [m]
  int solid = -1;           ///< see solid_name(); -1: there is none
};

/// Distance of a robot's body, seen from above, to the nearest obstacle, wall or other robot.
/// Unlike RobotStatistics::least_clearance_m it is exact at any distance, and names the solid.
/// O(edges).
[[nodiscard]] NearestSolid nearest_solid(const sim::Simulation& simulation, int robot);

/// Name of a solid: of an obstacle or a robot, "border" or "wall".
[[nodiscard]] std::string solid_name(const sim::Simulation& simulation, int solid);

}  // namespace playpen::testing
