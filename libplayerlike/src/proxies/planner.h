// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "playerlike/session/session.h"
#include "sim/core/pose.h"

namespace playerlike {

/// State of a planner. All poses are in the world's frame.
struct PlannerState {
  bool valid = false;  ///< there is a path to the goal
  bool done = false;   ///< the goal is reached
  sim::Pose pose;      ///< of the robot
  sim::Pose goal;
  sim::Pose waypoint;                ///< the current one
  int waypoint_index = -1;           ///< of the current one in `waypoints`; negative: none
  std::vector<sim::Pose> waypoints;  ///< from the start to the goal
  double length_m = 0.0;             ///< of the path along the waypoints
};

/// Plans paths and drives a robot along them in its own thread; it implements PlannerProxy. Proxies
/// use planners through this interface only.
///
/// All members may be called from any thread. In lockstep, a call at simulated time t by a thread
/// that takes part affects the planner's first round after t.
class Planner {
 public:
  Planner() = default;
  Planner(const Planner&) = delete;
  Planner& operator=(const Planner&) = delete;
  /// Ends the planner's thread. If the robot is on its way, it is stopped.
  virtual ~Planner() = default;

  /// Plans a path to a goal and drives along it, in place of an earlier goal.
  virtual void set_goal(const sim::Pose& goal) = 0;
  /// Plans from this pose instead of the robot's, without driving, until enable(true).
  virtual void set_start(const sim::Pose& start) = 0;
  /// Stops driving, or continues; with `on`, paths start at the robot again.
  virtual void enable(bool on) = 0;
  /// The state as of the planner's last round before now.
  [[nodiscard]] virtual PlannerState state() const = 0;
};

/// The planner for a binding of find_interface(). All callers share one planner as long as one of
/// them holds it.
///
/// @param session  the caller's; a new planner opens a follower of it.
/// @throws SessionError, PlayerCc::PlayerError if the session is closed, or may not read the map.
[[nodiscard]] std::shared_ptr<Planner> share_planner(Session& session,
                                                     const InterfaceBinding& binding);

}  // namespace playerlike
