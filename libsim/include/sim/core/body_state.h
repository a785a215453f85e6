// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sim/core/elevation.h"
#include "sim/core/pose.h"

namespace sim {

/// What a robot's body does at the end of a step: the truth that its sensors measure.
struct BodyState {
  Pose X_WB;              ///< pose of the axle's centre in the world
  Twist twist;            ///< achieved velocity in B over the last step
  Twist commanded;        ///< target velocity of the motors, after all limits
  double travel_m = 0.0;  ///< signed forward motion of the wheels' midpoint in the last step [m]
  double turn_rad = 0.0;  ///< turn in the last step, counter-clockwise [rad]
  bool stalled = false;   ///< the commanded twist has not been achieved for 0.2 s
  double side_m = 0.0;    ///< motion to the left in the last step [m]: driven by an omnidirectional
                          ///< robot, or caused by a push
  Elevation elevation;    ///< height and inclination, which the physics ignores
};

}  // namespace sim
