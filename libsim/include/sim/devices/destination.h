// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "sim/devices/device.h"

namespace sim {

/// Settings of the destination actuator. The defaults are those of MORSE.
struct DestinationParams {
  double tolerance_m = 0.5;  ///< distance from the goal at which the robot stops [m]
  double speed_mps = 5.0;    ///< on the way; the motors' limits apply too [m/s]
  bool remain = false;       ///< whether a robot that is pushed away from its goal returns
};

/// Moves its robot straight towards a point, without turning (MORSE's Destination). Only an
/// omnidirectional drive can do that.
///
/// Takes GotoCommand. The robot moves in a straight line in space: its height (Elevation) changes
/// with it, at the same rate. It stops when it is within the tolerance. The last command wins, as
/// for Waypoint.
class Destination final : public Actuator {
 public:
  /// @param can_move_sideways  whether the robot's drive is omnidirectional.
  Destination(std::string name, const DestinationParams& params, bool can_move_sideways);

  /// Refuses a goal with numbers that are not finite or with a tolerance or speed that is not
  /// positive, and a robot that has no motors or cannot move sideways.
  std::optional<std::string> execute(const Command& command, RobotControl& robot) override;
  void act(RobotControl& robot) override;
  void on_motors_taken() override { is_on_way_ = has_goal_ = false; }
  void placed(const Pose& X_WB) override;
  void archive(StateArchive& archive) override;

  [[nodiscard]] const DestinationParams& params() const noexcept { return params_; }

 protected:
  void deactivated(RobotControl& robot) override;

 private:
  DestinationParams params_;
  bool can_move_sideways_;
  bool has_goal_ = false;   // there is a goal that it drives to, or stays at
  bool is_on_way_ = false;  // it commands the motors
  GotoCommand goal_{.goal_m = Vec2::Zero()};
};

}  // namespace sim
