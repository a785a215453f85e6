// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "playerlike/session/device_planners.h"
#include "playerlike/session/session.h"
#include "sim/core/pose.h"

namespace playerlike {

/// Plans paths and drives a robot along them, in its own thread or on a server; it implements
/// PlannerProxy. Proxies use planners through this interface only.
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
  /// As state(), with the waypoints of the present path also if they must be requested.
  [[nodiscard]] virtual PlannerState state_with_waypoints() { return state(); }
  /// Takes a reading of the proxy's device, which may be the planner itself.
  virtual void on_reading(const sim::Reading& /*reading*/) {}
};

/// The planner for a binding of find_interface(). All callers share one planner as long as one of
/// them holds it; planners of a Player server have an object for each caller.
///
/// @param session  the caller's. A new planner opens a follower of it; one of a Player server uses
///                 it, so it must outlive that planner.
/// @throws SessionError, PlayerCc::PlayerError if the session is closed, or may not read the map.
[[nodiscard]] std::shared_ptr<Planner> share_planner(Session& session,
                                                     const InterfaceBinding& binding);

}  // namespace playerlike
