// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sim/devices/device.h"
#include "sim/world/robot_model.h"

namespace sim {

/// Settings of the motors and of their position control. Acceleration limits of 0 mean: none.
struct MotionParams {
  double max_speed_mps = 0.5;                 ///< > 0
  double max_turn_rate_radps = 3.0;           ///< > 0
  double max_acceleration_mps2 = 0.0;         ///< >= 0; 0: no limit, speed changes at once
  double max_turn_acceleration_radps2 = 0.0;  ///< >= 0; 0: no limit
  bool enabled_at_start = true;               ///< whether the motors are on before a client says so
  double approach_gain = 2.0;                 ///< speed for each metre that is missing [1/s], > 0
  double turn_gain = 2.0;                     ///< turn rate for each radian missing [1/s], > 0
  double tolerance_m = 0.01;                  ///< so near to its goal a robot is there [m], > 0
  double heading_tolerance_rad = 0.01;        ///< the same for its heading [rad], > 0
};

/// Position control: how a robot gets to a pose, step by step.
///
/// Frames: all poses of B in one frame that does not move. With the distance d of the goal, its
/// bearing a in B, in (-pi, pi], and the heading e that is missing, and gains k and h
/// (approach_gain, turn_gain):
///
/// - A differential drive that is away from the goal by more than the tolerance turns with
///   omega = h a, on the spot while |a| > 0.5, else driving v = k d cos a; then it turns on the
///   spot with omega = h e. Pushed away by more than three tolerances, it drives again.
/// - An omnidirectional one does both at once: v = k d towards the goal, omega = h e.
/// - A car steers along the arc through the goal, of curvature 2 sin a / d (pure pursuit with the
///   goal as the point that is looked at: R. C. Coulter, "Implementation of the pure pursuit path
///   tracking algorithm", CMU-RI-TR-92-01, 1992), backwards towards a goal behind it. A goal
///   within its turning circle is left first, steering the other way. The heading at the goal is
///   that of the arc, unless it is sought: where the way to the goal lies within 78 degrees of it
///   and the car's steering allows, the point looked at is half the distance before the goal, along
///   the goal's heading. What the way is off from that heading then falls with d, and with it what
///   the car is. If the goal comes within the turning circle meanwhile, the heading is given up.
///
/// Speeds are bounded by the command's limits, and by sqrt(a d) (sqrt(alpha e)) where an
/// acceleration limit a (alpha) is set, so that the robot can brake before the goal.
/// Proportional control of position with bounded speeds, as Siegwart, Nourbakhsh, Scaramuzza,
/// Introduction to Autonomous Mobile Robots, 2nd ed., sec. 3.6.2, though theirs goes by curves.
class PositionControl {
 public:
  /// What to do in the next step.
  struct Step {
    Twist twist;                ///< [m/s], [rad/s]
    double steering_rad = 0.0;  ///< of a car, which has no turn rate of its own
    bool arrived = false;       ///< there is nothing left to do; the twist is zero
  };

  PositionControl() = default;
  /// @pre speeds of the command > 0: limits already applied.
  PositionControl(const DriveDescription& drive, const MotionParams& params,
                  const PositionCommand& command)
      : drive_(drive), params_(params), command_(command) {}

  /// @param X_FB  where the robot is, in the goal's frame.
  [[nodiscard]] Step step(const Pose& X_FB);

  [[nodiscard]] const PositionCommand& command() const noexcept { return command_; }
  /// Writes or reads the state; `drive` and `params` are those it was made with.
  void archive(StateArchive& archive, const DriveDescription& drive, const MotionParams& params);

 private:
  [[nodiscard]] double speed_for(double distance_m) const;
  [[nodiscard]] double turn_rate_for(double error_rad) const;
  [[nodiscard]] Step differential_step(const Pose& X_FB, double distance_m);
  [[nodiscard]] Step omnidirectional_step(const Pose& X_FB, double distance_m) const;
  [[nodiscard]] Step car_step(const Pose& X_FB, double distance_m);

  DriveDescription drive_;
  MotionParams params_;
  PositionCommand command_;
  bool aligning_ = false;   ///< differential: arrived, turning to the goal's heading
  bool backwards_ = false;  ///< car: the direction it drives in
  bool leaving_ = false;    ///< car: getting away from a goal within its turning circle
  bool sought_ = false;     ///< car: has sought the goal's heading
  bool given_up_ = false;   ///< car: and could not have it
};

/// Motors of a robot, commanded by twist, by heading, by position, or as a car.
///
/// Each command ends the one before. What a drive cannot do is left out: a differential drive and a
/// car ignore speeds to the left; a car, whose front wheels are turned at the rate of its model,
/// stands when told to turn on the spot; any other robot told to drive as a car turns at
/// v tan(steering) / wheelbase, the wheelbase its own length.
class Motion final : public Actuator {
 public:
  /// @param drive  of the robot; its wheelbase is also what CarCommand pretends for other drives.
  Motion(std::string name, const MotionParams& params, const DriveDescription& drive = {});

  /// Takes TwistCommand (components clamped to the limits), HeadingCommand, PositionCommand,
  /// CarCommand and MotorEnableCommand.
  std::optional<std::string> apply(const Command& command) override;
  /// As apply(); what drives also takes the motors from whatever else steers, unless they are off.
  std::optional<std::string> carry_out(const Command& command, RobotControl& robot) override;
  /// Holds the heading, or goes on to the position, if that was commanded.
  void act(RobotControl& robot) override;
  void motors_taken() override;
  void placed(const Pose& X_WB) override;

  [[nodiscard]] Motion* motion() noexcept override { return this; }

  /// The twist to strive for during the next step of dt_s, limits applied; advances the ramp.
  [[nodiscard]] Twist next_target(double dt_s);

  [[nodiscard]] const MotionParams& params() const noexcept { return params_; }
  [[nodiscard]] bool enabled() const noexcept { return enabled_; }
  [[nodiscard]] const Twist& commanded() const noexcept { return commanded_; }
  /// Of a car: where its front wheels point now, counter-clockwise [rad]; else 0.
  [[nodiscard]] double steering_rad() const noexcept { return steering_rad_; }
  /// Whether the motors drive to a position: then present_command() is a PositionCommand.
  [[nodiscard]] bool has_position_goal() const noexcept { return mode_ == Mode::kPosition; }
  /// A command that, given again, lets it go on with what it does now.
  [[nodiscard]] Command present_command() const;
  void archive(StateArchive& archive) override;

 protected:
  void deactivated(RobotControl& robot) override;

 private:
  enum class Mode { kTwist, kHeading, kPosition, kCar };

  void stop();
  void command_twist(const Twist& twist);
  void command_car(double v_mps, double steering_rad);
  void command_turn(double v_mps, double lateral_mps, double turn_rate_radps);

  // What each step asks for comes first: it shares lines of the cache.
  Mode mode_ = Mode::kTwist;
  bool enabled_;
  Twist commanded_;  ///< clamped, as last told
  Twist target_;     ///< after the acceleration limit
  MotionParams params_;
  DriveDescription drive_;
  HeadingCommand heading_;
  PositionControl position_;
  double commanded_steering_rad_ = 0.0;  ///< of a car
  double steering_rad_ = 0.0;            ///< of a car, after the limit of its rate
};

}  // namespace sim
