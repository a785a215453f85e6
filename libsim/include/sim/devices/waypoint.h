// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "sim/devices/device.h"

namespace sim {

/// What a robot does about its goal.
enum class WaypointStatus {
  kArrived,  ///< it has reached the last goal, or none was given yet
  kTransit,  ///< it is on its way
  kStop,     ///< it was stopped on its way, or another took the motors; the goal is kept
};

/// MORSE's words for it: "Arrived", "Transit", "Stop".
[[nodiscard]] std::string_view to_string(WaypointStatus status) noexcept;

/// Settings of the waypoint driver.
struct WaypointParams {
  double frequency_hz = 10.0;        ///< of the readings; steering is done each step. (0, 1000]
  double tolerance_m = 0.5;          ///< what clients take when none is named [m], > 0
  double speed_mps = 1.0;            ///< the same for the speed [m/s], > 0
  double turn_gain = 4.0;            ///< turn rate a bearing, see waypoint_twist() [1/s], > 0
  double approach_gain = 2.0;        ///< speed a distance, see waypoint_twist() [1/s], > 0
  double max_turn_rate_radps = 2.0;  ///< [rad/s], > 0
};

/// The twist by which a differential drive heads for a point.
///
/// Frames: W world, B body. With the distance d of the goal and its bearing a in B, in (-pi, pi]:
///
///     v     = min(speed, approach_gain d) max(0, cos a)
///     omega = turn_gain a, at most max_turn_rate either way
///
/// So the robot turns where it stands towards a goal abeam or behind it, drives as it comes to look
/// that way, and slows down before it. A simplified form (free final heading, bounded speeds) of
/// the law of Aicardi, Casalino, Bicchi, Balestrino, "Closed loop steering of unicycle-like
/// vehicles via Lyapunov techniques", IEEE Robotics and Automation Magazine 2(1), 1995. d never
/// grows; a falls if turn_gain > approach_gain.
///
/// @return v >= 0 [m/s] and omega [rad/s]; zero at the goal itself.
/// @pre all numbers finite, goal.speed_mps > 0.
[[nodiscard]] Twist waypoint_twist(const Pose& X_WB, const GotoCommand& goal,
                                   const WaypointParams& params);

/// How a robot is getting on with its goal.
struct WaypointReading final : Reading {
  WaypointStatus status = WaypointStatus::kArrived;
  std::uint64_t goal_number = 0;   ///< see Waypoint::goal_number()
  Vec2 goal_m = Vec2::Zero();      ///< in W [m]; before the first goal: where the robot started
  Vec2 position_m = Vec2::Zero();  ///< of the robot, in W [m]
  double distance_m = 0.0;         ///< from the robot to the goal [m]
};

/// Drives its robot to a point of the world through the robot's motors: an actuator that can be
/// read as well.
///
/// Takes GotoCommand, StopCommand and ResumeCommand. Each step in transit the motors get
/// waypoint_twist(); at the end of the step in which the robot has come as near as the tolerance it
/// has arrived, and stands from then on (motors with an acceleration limit take their time). It
/// knows nothing of obstacles: before a wall the robot stalls, still in transit.
///
/// Who spoke last steers: a TwistCommand for the motors, a PlaceCommand or the like, or a goal for
/// another waypoint device end the transit with kStop. Motors that are switched off make it wait;
/// a motion device that is not active does not, as the motors themselves still work.
class Waypoint final : public SensorOf<WaypointReading> {
 public:
  /// @param X_WB_start  where the robot stands before the first step.
  Waypoint(std::string name, const WaypointParams& params, const Pose& X_WB_start);

  /// Refuses a goal with numbers that are not finite, a tolerance or speed that is not positive, a
  /// robot without motors, and to resume before the first goal.
  std::optional<std::string> carry_out(const Command& command, RobotControl& robot) override;
  void act(RobotControl& robot) override;
  void integrate(const StepContext& context) override;
  void motors_taken() override;
  void placed(const Pose& X_WB) override;
  void succeed(const Device& before, SimTime later_ns) override;

  [[nodiscard]] const WaypointParams& params() const noexcept { return params_; }
  /// After any step: how things stand at its end.
  [[nodiscard]] WaypointStatus status() const noexcept { return status_; }
  /// How many GotoCommands were accepted: while it stays what it was just after one, that goal is
  /// the current one. A reset or restore that changes the goal
  /// counts as well.
  [[nodiscard]] std::uint64_t goal_number() const noexcept { return goal_number_; }
  /// The goal that was accepted last, in W [m]; before the first: where the robot started.
  [[nodiscard]] const Vec2& goal() const noexcept { return goal_.goal_m; }
  /// Of that goal: so near to it the robot has arrived [m].
  [[nodiscard]] double tolerance_m() const noexcept { return goal_.tolerance_m; }
  /// From the robot to the goal [m].
  [[nodiscard]] double distance_m() const;

  void archive(StateArchive& archive) override;

 protected:
  void measure(const StepContext& context) override;
  void deactivated(RobotControl& robot) override;

 private:
  WaypointParams params_;
  GotoCommand goal_;
  std::uint64_t goal_number_ = 0;
  bool has_goal_ = false;  ///< since the start or the last reset
  WaypointStatus status_ = WaypointStatus::kArrived;
  bool steers_ = false;  ///< the motors are this device's: they must stand where it does not drive
  Pose X_WB_;            ///< at the last step
};

}  // namespace sim
