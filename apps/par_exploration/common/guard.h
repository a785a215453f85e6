// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef PAR_EXPLORATION_GUARD_H
#define PAR_EXPLORATION_GUARD_H

#include <vector>

#include "par_common/grid.h"
#include "par_common/path_follower.h"

// The last word on every command: whatever the planner wants, the robot shall not touch anything.
//
// The idea is that of the dynamic window approach (D. Fox, W. Burgard, S. Thrun, "The dynamic
// window approach to collision avoidance", IEEE Robotics and Automation Magazine 4(1), 1997): of
// many commands, roll each one out over the next moments, drop those that come too near to
// something, and take the one most like what was wanted.

// What is round the robot, as points in its own frame: x ahead, y to the left [m].
struct Surroundings {
  std::vector<par::Point> solid;   // must not be touched
  std::vector<par::Point> unseen;  // nobody knows what is there: better not touched either
};

// How near the S1R's outline is to the nearest of these points [m]: negative if one lies inside.
// Off the corners it is a little less than the true distance, never more. Infinite without points.
double clearance(const std::vector<par::Point>& points);

class CGuard {
 public:
  // The command to give instead of the wanted one. Call it with each new scan.
  //
  // A robot that is to stand, stands. One that has room gets the command most like the wanted one
  // that keeps the room; the less room there is, the slower it drives. One in a tight place, at the
  // start or when a block came up beside it, gets out of there first. Zero if whatever it could do
  // would touch something.
  par::Velocity check(const par::Velocity& wanted, const Surroundings& around);

 private:
  bool gettingOut = false;  // once begun, until there is room enough
};

#endif
