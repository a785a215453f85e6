// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include "playerlike/session/session.h"
#include "session/player_values/poses.h"
#include "sim/core/pose.h"

namespace playerlike {

/// State of the drive to a goal.
enum class GoalState {
  kIdle,     ///< there is no goal
  kMoving,   ///< on the way
  kReached,  ///< arrived: the robot has stopped within the tolerances
  kBlocked,  ///< given up: the robot has stopped, having made no progress for a while
};

/// Drives a robot to goals in its own thread; it implements Position2dProxy::GoTo() for the index
/// of a driver. Proxies use drivers through this interface only.
///
/// All members may be called from any thread. In lockstep, a call at simulated time t by a thread
/// that takes part affects the driver's first round after t.
class GoalDriver {
 public:
  /// A goal, in the frame of the driver's position device.
  struct Goal {
    sim::Vec2 position = sim::Vec2::Zero();  ///< [m]
    std::optional<double> yaw_rad;           ///< final heading; none: any heading
    std::optional<double> max_speed_mps;     ///< lowers the driver's own limit; none: keeps it
    std::optional<double> max_turn_rate_radps;
  };

  GoalDriver() = default;
  GoalDriver(const GoalDriver&) = delete;
  GoalDriver& operator=(const GoalDriver&) = delete;
  /// Ends the driver's thread. If the robot is moving to a goal, it is stopped.
  virtual ~GoalDriver() = default;

  /// Starts to drive to the goal, which replaces an earlier one.
  virtual void go_to(const Goal& goal) = 0;
  /// Drops the goal and sends no further commands; does not stop the robot.
  virtual void cancel() = 0;
  /// State of the newest goal, as of the driver's last round before now.
  [[nodiscard]] virtual GoalState state() const = 0;
};

/// The goal in the words of Player's position2d. @param speeds  the greatest ones; 0: the robot's.
template <typename Pose2d>
[[nodiscard]] GoalDriver::Goal driver_goal(const Pose2d& goal, const Pose2d& speeds,
                                           double robot_speed_mps, double robot_turn_rate_radps) {
  const auto limited = [](double wish, double limit) {
    return wish == 0.0 ? limit : std::min(std::abs(wish), limit);
  };
  const sim::Pose pose = normalized_pose(goal);
  return {pose.position(), pose.yaw_rad, limited(speeds.px, robot_speed_mps),
          limited(speeds.pa, robot_turn_rate_radps)};
}

/// The driver for a binding of find_interface(). All callers share one driver as long as one of
/// them holds it.
///
/// @param session  the caller's; a new driver opens a follower of it.
/// @throws SessionError, PlayerCc::PlayerError if the session is closed.
[[nodiscard]] std::shared_ptr<GoalDriver> share_driver(Session& session,
                                                       const InterfaceBinding& binding);

}  // namespace playerlike
