// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>

#include "playerlike/session/session.h"
#include "sim/core/pose.h"

namespace playerlike {

/// Something that drives a robot to goals by itself, in a thread of its own: what stands behind
/// Position2dProxy::GoTo() of a driver's index. Proxies know drivers by this alone.
///
/// All members may be called from any thread. In lockstep, calls made at simulated time t by a
/// thread that takes part have their effect on the driver's first round after t.
class GoalDriver {
 public:
  /// A place to drive to, in the frame of the driver's position device.
  struct Goal {
    sim::Vec2 position = sim::Vec2::Zero();  ///< [m]
    std::optional<double> yaw_rad;           ///< heading at the end; none: any will do
    std::optional<double> max_speed_mps;     ///< none: as set; never above what is set
    std::optional<double> max_turn_rate_radps;
  };

  GoalDriver() = default;
  GoalDriver(const GoalDriver&) = delete;
  GoalDriver& operator=(const GoalDriver&) = delete;
  /// Ends its thread; a robot on the way to a goal is stopped.
  virtual ~GoalDriver() = default;

  /// Drives there from now on, whatever it did before.
  virtual void go_to(const Goal& goal) = 0;
  /// Drops the goal and commands nothing more; does not stop the robot.
  virtual void cancel() = 0;
};

/// The driver behind a binding of find_interface(), shared by all who ask for it while somebody
/// holds it.
/// @param session  of the one who asks; the driver opens a follower of it, if it is not there yet.
/// @throws SessionError, PlayerCc::PlayerError if the session is closed.
[[nodiscard]] std::shared_ptr<GoalDriver> share_driver(Session& session,
                                                       const InterfaceBinding& binding);

}  // namespace playerlike
