// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "sim/devices/device.h"

namespace sim {

/// State of the robot relative to its goal.
enum class WaypointStatus {
  kArrived,  ///< it has reached the last goal, or has had no goal yet
  kTransit,  ///< it is on its way
  kStop,     ///< stopped on its way, or another device drives the robot; the goal is kept
};

/// MORSE's names: "Arrived", "Transit", "Stop".
[[nodiscard]] std::string_view to_string(WaypointStatus status) noexcept;

/// Settings of the waypoint driver.
struct WaypointParams {
  double frequency_hz = 10.0;           ///< of readings; each step updates the steering
  double tolerance_m = 0.5;             ///< default for clients that name no tolerance [m]
  double speed_mps = 1.0;               ///< default for clients that name no speed [m/s]
  double turn_gain = 4.0;               ///< turn rate per bearing, see waypoint_twist() [1/s]
  double approach_gain = 2.0;           ///< speed per distance, see waypoint_twist() [1/s]
  double max_turn_rate_radps = 2.0;     ///< [rad/s]
  double stop_deceleration_mps2 = 0.0;  ///< after StopCommand [m/s^2]; 0: at once
};

/// The twist with which a differential drive moves towards a point.
///
/// Frames: W world, B body. With the distance d of the goal and its bearing a in B, in (-pi, pi]:
///
///     v     = min(speed, approach_gain d) max(0, cos a)
///     omega = turn_gain a, at most max_turn_rate either way
///
/// So the robot turns on the spot if the goal is beside or behind it, drives as soon as it faces
/// the goal, and slows down near it. This is a simplified form (free final heading, bounded speeds)
/// of the law of Aicardi, Casalino, Bicchi, Balestrino, "Closed loop steering of unicycle-like
/// vehicles via Lyapunov techniques", IEEE Robotics and Automation Magazine 2(1), 1995. d never
/// increases; |a| decreases if turn_gain > approach_gain.
///
/// @return v >= 0 [m/s] and omega [rad/s]; zero at the goal itself.
/// @pre all numbers finite, goal.speed_mps > 0.
[[nodiscard]] Twist waypoint_twist(const Pose& X_WB, const GotoCommand& goal,
                                   const WaypointParams& params);

/// Progress of a robot towards its goal.
struct WaypointReading final : Reading {
  WaypointStatus status = WaypointStatus::kArrived;
  std::uint64_t goal_number = 0;   ///< see Waypoint::goal_number()
  Vec2 goal_m = Vec2::Zero();      ///< in W [m]; before the first goal: the robot's start position
  Vec2 position_m = Vec2::Zero();  ///< of the robot, in W [m]
  double distance_m = 0.0;         ///< from the robot to the goal [m]
};

/// Drives its robot to a point of the world through the robot's motors: an actuator that can also
/// be read.
///
/// Takes GotoCommand, StopCommand and ResumeCommand. In transit, the motors get waypoint_twist() in
/// each step. The robot has arrived at the end of the first step in which its distance is within
/// the tolerance. It then stops (with an acceleration limit, after a ramp). The device does not
/// avoid obstacles: in front of a wall the robot stalls and stays in transit.
///
/// The last command wins: a TwistCommand for the motors, a PlaceCommand or similar, or a goal for
/// another waypoint device ends the transit with kStop. While the motors are off, the device waits.
/// An inactive motion device does not matter, since the motors themselves still work.
class Waypoint final : public SensorOf<WaypointReading> {
 public:
  /// @param X_WB_start  pose of the robot before the first step.
  Waypoint(std::string name, const WaypointParams& params, const Pose& X_WB_start);

  /// Refuses a goal with numbers that are not finite or with a tolerance or speed that is not
  /// positive, a robot without motors, and a ResumeCommand before the first goal.
  std::optional<std::string> execute(const Command& command, RobotControl& robot) override;
  void act(RobotControl& robot) override;
  void integrate(const StepContext& context) override;
  void on_motors_taken() override;
  void placed(const Pose& X_WB) override;
  void take_over_from(const Device& before, SimTime later_ns) override;

  [[nodiscard]] const WaypointParams& params() const noexcept { return params_; }
  /// State at the end of the last step.
  [[nodiscard]] WaypointStatus status() const noexcept { return status_; }
  /// Number of accepted GotoCommands. A client's goal is still the current one while this number is
  /// unchanged since its command was accepted. A reset or restore that changes the goal increases
  /// the number too.
  [[nodiscard]] std::uint64_t goal_number() const noexcept { return goal_number_; }
  /// The last accepted goal, in W [m]; before the first: the robot's start position.
  [[nodiscard]] const Vec2& goal() const noexcept { return goal_.goal_m; }
  /// Distance within which the goal is reached [m].
  [[nodiscard]] double tolerance_m() const noexcept { return goal_.tolerance_m; }
  /// Distance from the robot to the goal [m].
  [[nodiscard]] double distance_m() const;

  void archive(StateArchive& archive) override;

 protected:
  void measure(const StepContext& context) override;
  void deactivated(RobotControl& robot) override;

 private:
  WaypointParams params_;
  GotoCommand goal_{.goal_m = Vec2::Zero()};
  std::uint64_t goal_number_ = 0;
  bool has_goal_ = false;  ///< since the start or the last reset
  WaypointStatus status_ = WaypointStatus::kArrived;
  double rolling_mps_ = 0.0;      ///< speed that is left after StopCommand
  bool controls_motors_ = false;  ///< drives the motors, and must stop them when not in transit
  Pose X_WB_;                     ///< pose at the last step
};

}  // namespace sim
