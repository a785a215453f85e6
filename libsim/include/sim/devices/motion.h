// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sim/core/random_stream.h"
#include "sim/devices/device.h"
#include "sim/world/robot_model.h"

namespace sim {

/// Settings of the motors and of their position control. An acceleration limit of 0 means no limit.
struct MotionParams {
  double max_speed_mps = 0.5;                 ///< [m/s]
  double max_turn_rate_radps = 3.0;           ///< [rad/s]
  double max_acceleration_mps2 = 0.0;         ///< [m/s^2]; 0: no limit, the speed changes at once
  double max_turn_acceleration_radps2 = 0.0;  ///< [rad/s^2]; 0: no limit
  bool enabled_at_start = true;               ///< whether the motors are initially on
  double approach_gain = 2.0;                 ///< speed per remaining metre [1/s]
  double turn_gain = 2.0;                     ///< turn rate per remaining radian [1/s]
  double tolerance_m = 0.01;                  ///< distance to the goal on arrival [m]
  double heading_tolerance_rad = 0.01;        ///< heading error on arrival [rad]
  double slip = 0.0;             ///< standard deviation of each wheel's slip; see WheelSlip
  double slip_time_s = 0.2;      ///< time in which slip loses its correlation [s]
  double speed_loss_mps = 0.0;   ///< by which the robot is slower than its target [m/s]
  double turn_loss_radps = 0.0;  ///< by which it turns more slowly than its target [rad/s]
  double latency_s = 0.0;        ///< from a command until it takes effect [s]
};

/// Slip of the wheels: s = 1 - v / (omega r), with v the speed of a wheel's centre over the floor,
/// omega its turn rate and r its radius (J. Y. Wong, Theory of Ground Vehicles, 4th ed., 2008, sec.
/// 1.3). A positive slip is lost speed.
///
/// The slip of each wheel is a first-order Gauss-Markov process of mean 0 (P. S. Maybeck,
/// Stochastic Models, Estimation, and Control, vol. 1, 1979, sec. 4.11): stationary, with the
/// standard deviation MotionParams::slip and the autocorrelation exp(-t / slip_time_s). It is
/// limited to 0.5. The two wheels of a car have one slip, so it stays on the arc of its steering.
struct WheelSlip {
  double left = 0.0;
  double right = 0.0;
  double side = 0.0;  ///< of an omnidirectional drive's motion to the left
};

/// Position control: drives a robot to a pose, step by step.
///
/// All poses are those of B in one fixed frame. Symbols: the distance d of the goal; its bearing a
/// in B, in (-pi, pi]; the remaining rotation e to the goal's heading; the gains k and h
/// (approach_gain, turn_gain).
///
/// - A differential drive farther from the goal than the tolerance turns with omega = h a. It turns
///   on the spot while |a| > 0.5, and otherwise drives with v = k d cos a. At the goal it turns on
///   the spot with omega = h e. If it is pushed away by more than three tolerances, it drives
///   again.
/// - An omnidirectional drive does both at once: v = k d towards the goal, omega = h e.
/// - A car steers along the arc through the goal, of curvature 2 sin a / d. This is pure pursuit
///   with the goal as the look-ahead point (R. C. Coulter, "Implementation of the pure pursuit path
///   tracking algorithm", CMU-RI-TR-92-01, 1992). It drives backwards to a goal behind it. If the
///   goal is within its turning circle, the car first drives away from it, steering the other way.
///   The heading at the goal is that of the arc, unless the controller seeks the goal's heading: if
///   the direction to the goal is within 78 degrees of that heading and the steering allows, the
///   look-ahead point is half the distance before the goal, along the goal's heading. The angle
///   between the two directions then decreases with d, and so does the car's heading error. If the
///   goal comes within the turning circle meanwhile, the controller gives up the heading.
///
/// Speeds are bounded by the command's limits. With an acceleration limit a (or alpha), they are
/// also bounded by sqrt(a d) (or sqrt(alpha e)), so that the robot can brake before the goal.
/// Proportional position control with bounded speeds is described in Siegwart, Nourbakhsh,
/// Scaramuzza, Introduction to Autonomous Mobile Robots, 2nd ed., sec. 3.6.2; their controller
/// drives curves.
class PositionControl {
 public:
  /// Output of the controller for the next step.
  struct Step {
    Twist twist;                ///< [m/s], [rad/s]
    double steering_rad = 0.0;  ///< of a car, instead of a turn rate
    bool arrived = false;       ///< the goal is reached; the twist is zero
  };

  PositionControl() = default;
  /// @pre the command's speeds are > 0, with limits already applied.
  PositionControl(const DriveDescription& drive, const MotionParams& params,
                  const PositionCommand& command)
      : drive_(drive), params_(params), command_(command) {}

  /// @param X_FB  the robot's pose in the goal's frame.
  [[nodiscard]] Step step(const Pose& X_FB);

  [[nodiscard]] const PositionCommand& command() const noexcept { return command_; }
  /// Writes or reads the state. `drive` and `params` are those passed to the constructor.
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
  bool aligning_ = false;           ///< differential: at the goal, turning to its heading
  bool backwards_ = false;          ///< car: driving backwards
  bool leaving_ = false;            ///< car: driving away from a goal within its turning circle
  bool sought_heading_ = false;     ///< car: the controller has sought the goal's heading
  bool heading_abandoned_ = false;  ///< car: the controller has abandoned the goal's heading
};

/// The motors of a robot. Takes commands by twist, by heading, by position, or like a car.
///
/// Each command replaces the one before. What a drive cannot do is ignored: differential drives and
/// cars ignore speeds to the left; a car stands still when commanded to turn on the spot. The front
/// wheels of a car turn at the rate of its model. For a car with `steering_commands`, a twist's
/// turn rate is the angle of the front wheels, and a speed is theirs. Any other drive that gets a
/// CarCommand turns at v tan(steering) / wheelbase, with the length of the robot as its wheelbase.
///
/// With a latency, execute() accepts a command at once, and the command takes effect that much
/// later, in the order of commands. Placing the robot, and another device that takes the motors,
/// cancel the commands that wait.
class Motion final : public Actuator {
 public:
  /// @param drive  of the robot; CarCommand uses its wheelbase for other drives as well.
  /// @param noise  for the slip; not used without slip.
  Motion(std::string name, const MotionParams& params, const DriveDescription& drive = {},
         const RandomStream& noise = {0, ""});

  /// Takes TwistCommand (clamped to the limits), HeadingCommand, PositionCommand, CarCommand and
  /// MotorEnableCommand.
  std::optional<std::string> apply(const Command& command) override;
  /// Like apply(), after the latency. A command to drive also takes the motors from other devices,
  /// unless they are off.
  std::optional<std::string> execute(const Command& command, RobotControl& robot) override;
  /// Continues to hold a heading or to drive to a position, if commanded.
  void act(RobotControl& robot) override;
  void on_motors_taken() override;
  void placed(const Pose& X_WB) override;
  void take_over_from(const Device& before, SimTime later_ns) override;

  [[nodiscard]] Motion* motion() noexcept override { return this; }

  /// The target twist for the next step of dt_s, with limits, loss and slip applied; advances
  /// limits and slip.
  [[nodiscard]] Twist next_target(double dt_s);

  /// Whether the wheels can slip.
  [[nodiscard]] bool slips() const noexcept { return slip_ != nullptr; }
  /// Slip in the last step whose target next_target() returned.
  [[nodiscard]] WheelSlip slip() const noexcept;

  [[nodiscard]] const MotionParams& params() const noexcept { return params_; }
  [[nodiscard]] bool enabled() const noexcept { return enabled_; }
  [[nodiscard]] const Twist& commanded() const noexcept { return commanded_; }
  /// Current angle of a car's front wheels, counter-clockwise [rad]; 0 for other drives.
  [[nodiscard]] double steering_rad() const noexcept { return steering_rad_; }
  /// Whether the motors drive to a position. In this case present_command() is a PositionCommand.
  [[nodiscard]] bool has_position_goal() const noexcept { return mode_ == Mode::kPosition; }
  /// A command that makes the device continue what it is doing now.
  [[nodiscard]] Command present_command() const;
  void archive(StateArchive& archive) override;

 protected:
  void deactivated(RobotControl& robot) override;

 private:
  enum class Mode { kTwist, kHeading, kPosition, kCar };
  /// The state of slipping wheels.
  struct SlipProcess {
    RandomStream noise;
    WheelSlip slip;
  };
  /// A command that waits for its latency.
  struct Waiting {
    SimTime due_ns;
    Command command;
  };

  /// The target twist without slip.
  [[nodiscard]] Twist ramped(double dt_s);
  void advance_slip(double dt_s);
  [[nodiscard]] Twist slipped(const Twist& twist) const;
  [[nodiscard]] std::optional<std::string> check(const Command& command,
                                                 const RobotControl& robot) const;
  std::optional<std::string> execute_now(const Command& command, RobotControl& robot);
  void stop();
  void command_twist(const Twist& twist);
  void command_car(double v_mps, double steering_rad);
  [[nodiscard]] bool steers_by_commands() const;
  void command_front_wheels(double v_mps, double steering_rad);
  void command_turn(double v_mps, double lateral_mps, double turn_rate_radps);

  // What each step needs comes first, so that it shares cache lines.
  Mode mode_ = Mode::kTwist;
  bool enabled_;
  Twist commanded_;  ///< last command, clamped
  Twist target_;     ///< after the acceleration limit
  MotionParams params_;
  DriveDescription drive_;
  HeadingCommand heading_;
  PositionControl position_;
  double commanded_steering_rad_ = 0.0;  ///< of a car
  double steering_rad_ = 0.0;            ///< of a car, after the rate limit
  std::unique_ptr<SlipProcess> slip_;    ///< null: no slip
  SimTime latency_ns_;
  std::vector<Waiting> waiting_;  ///< oldest first
};

}  // namespace sim
