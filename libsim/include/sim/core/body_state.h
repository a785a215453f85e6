// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sim/core/pose.h"

namespace sim {

/// What a robot's body does at the end of a step: the truth that its sensors measure.
struct BodyState {
  Pose X_WB;              ///< pose of the axle's centre in the world
  Twist twist;            ///< achieved velocity in B over the last step
  Twist commanded;        ///< velocity that the motors were told to reach, after all limits
  double travel_m = 0.0;  ///< signed forward motion of the wheels' midpoint in the last step [m]
  double turn_rad = 0.0;  ///< turn in the last step, counter-clockwise [rad]
  bool stalled = false;   ///< the commanded twist has not been achieved for 0.2 s
  double side_m = 0.0;    ///< motion to the left in the last step: driven, if the robot can, or
                          ///< shoved [m]
};

}  // namespace sim
