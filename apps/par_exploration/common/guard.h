// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef PAR_EXPLORATION_GUARD_H
#define PAR_EXPLORATION_GUARD_H

#include <vector>

#include "par_common/grid.h"
#include "par_common/path_follower.h"

// The last check of every command: the robot must not touch anything, whatever the planner wants.
//
// The idea is from the dynamic window approach (D. Fox, W. Burgard, S. Thrun, "The dynamic window
// approach to collision avoidance", IEEE Robotics and Automation Magazine 4(1), 1997): simulate
// many commands over the next moments, discard those that come too near to an obstacle, and take
// the one closest to the wanted command.

// Points around the robot in its own frame: x ahead, y to the left [m].
struct Surroundings {
  std::vector<par::Point> solid;   // must not be touched
  std::vector<par::Point> unseen;  // unknown space, avoided where possible
};

// Distance from the S1R's outline to the nearest of these points [m]; negative if one lies inside.
// Beyond the outline's corners it is slightly less than the true distance, never more. Infinite
// without points.
double clearance(const std::vector<par::Point>& points);

class CGuard {
 public:
  // Returns the command to use instead of the wanted one. Call it with each new scan.
  //
  // If the wanted command is to stand still, the robot stands still. With enough room, the result
  // is the command closest to the wanted one that keeps the clearance; the robot drives slower
  // where there is less room. In a tight place (at the start, or after a block has come close), the
  // robot first drives out of it. The result is zero if every command would touch something.
  par::Velocity check(const par::Velocity& wanted, const Surroundings& around);

 private:
  bool gettingOut = false;  // stays true until there is room enough
};

#endif
