// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "sim/core/elevation.h"
#include "sim/core/pose.h"
#include "sim/core/state_archive.h"
#include "sim/core/time.h"
#include "sim/devices/arm_kinematics.h"
#include "sim/devices/device.h"

namespace sim {

/// How a joint moves.
enum class JointType {
  kRotary,  ///< turns about its axis; positions are angles [rad]
  kLinear,  ///< slides along its axis; positions are distances [m]
};

/// Axis of a joint in its own frame.
enum class JointAxis {
  kX,       ///< forwards, along the link
  kY,       ///< to the left
  kZ,       ///< upwards
  kMinusX,  ///< opposite to kX
  kMinusY,  ///< opposite to kY: positive positions lift the link
  kMinusZ,  ///< opposite to kZ
};

/// Settings of one joint. A rotary joint uses the members in radians, a linear joint those in
/// metres; travel_of() fills in what is missing.
///
/// The frame of a joint is at the end of the previous link, or at the base of the arm. Its axes are
/// those of the previous link, turned by yaw about z, then by pitch about y, then by roll about x.
/// The joint turns about or slides along its axis in this frame. Its link extends along the x axis
/// of the moved frame.
struct JointParams {
  std::string name;  ///< for posture devices; empty: "joint1", "joint2", ... by place
  JointType type = JointType::kRotary;  ///< whether it turns or slides
  double length_m = 0.1;                ///< of the link [m]
  double roll_rad = 0.0;   ///< orientation at position 0 relative to the previous link [rad]
  double pitch_rad = 0.0;  ///< as roll_rad; positive: downwards [rad]
  double yaw_rad = 0.0;    ///< as roll_rad; counter-clockwise [rad]
  JointAxis axis = JointAxis::kZ;  ///< in the joint's frame

  std::optional<double> min_rad;     ///< default -pi/2
  std::optional<double> centre_rad;  ///< default: half-way between the limits
  std::optional<double> max_rad;     ///< default pi/2
  std::optional<double> home_rad;    ///< default: the centre
  /// Initial speed of position commands; default: half of the maximum.
  std::optional<double> speed_radps;
  std::optional<double> speed_max_radps;  ///< default pi/2
  /// Initial acceleration; default: half of the maximum.
  std::optional<double> acceleration_radps2;
  std::optional<double> acceleration_max_radps2;  ///< default pi

  std::optional<double> min_m;                  ///< default 0
  std::optional<double> centre_m;               ///< default: half-way between the limits
  std::optional<double> max_m;                  ///< default 0.1
  std::optional<double> home_m;                 ///< default: the centre
  std::optional<double> speed_mps;              ///< as speed_radps
  std::optional<double> speed_max_mps;          ///< default 0.1
  std::optional<double> acceleration_mps2;      ///< as acceleration_radps2
  std::optional<double> acceleration_max_mps2;  ///< default 0.2

  bool has_brake = false;      ///< whether it has a brake
  double current_max_a = 1.0;  ///< maximum current of the motor [A]
};

/// Limits of a joint: in m and s for a linear joint, in rad and s for a rotary joint.
struct JointTravel {
  double min = 0.0;               ///< minimum position
  double centre = 0.0;            ///< centre position
  double max = 0.0;               ///< maximum position
  double home = 0.0;              ///< home position
  double speed = 0.0;             ///< initial speed of position commands
  double speed_max = 0.0;         ///< maximum speed
  double acceleration = 0.0;      ///< initial acceleration
  double acceleration_max = 0.0;  ///< maximum acceleration
};

/// The limits of a joint, with defaults for settings that are missing.
[[nodiscard]] JointTravel travel_of(const JointParams& joint);

/// Settings of an arm.
struct ActArrayParams {
  static constexpr int kMaxJoints = 16;  ///< maximum number of joints (Player 2.0's limit)

  double frequency_hz = 10.0;  ///< [Hz]
  /// Base of the arm on the body, seen from above. The link of the first joint points along its x
  /// axis if the joint has no orientation of its own and is at position 0.
  Pose X_BA;
  double height_m = 0.3;            ///< of the base above the floor [m]
  double roll_rad = 0.0;            ///< orientation of the base, besides the yaw of X_BA [rad]
  double pitch_rad = 0.0;           ///< as roll_rad; positive: downwards [rad]
  bool is_powered = true;           ///< initially
  std::vector<JointParams> joints;  ///< at most kMaxJoints; empty: default_joints()
};

/// A small arm with five rotary joints: base, shoulder, elbow, roll and bend of the wrist.
[[nodiscard]] std::vector<JointParams> default_joints();

/// State of a joint. The names are those of Player.
enum class JointState {
  kIdle,     ///< at rest without a goal, or at its goal
  kMoving,   ///< on its way
  kBraked,   ///< held by its brake
  kStalled,  ///< its motor pushes against a limit of the joint
};

/// Motion of a joint at a moment. Lengths are in m for a linear joint, in rad for a rotary joint.
struct JointReading {
  JointState state = JointState::kIdle;  ///< what the joint does
  double position = 0.0;                 ///< within the limits
  double speed = 0.0;                    ///< positive: towards the maximum
  double acceleration = 0.0;             ///< mean value over the last step
  double current_a = 0.0;                ///< through the motor; the sign is the direction [A]
  double speed_setting = 0.0;            ///< for position commands
  double acceleration_setting = 0.0;     ///< for all commands
};

/// The motions of all joints.
struct ActArrayReading final : Reading {
  std::vector<JointReading> joints;  ///< from the base outwards
  bool is_powered = true;            ///< whether the motors are on
};

/// Position and speed of a joint [m or rad, m/s or rad/s].
struct JointMotion {
  double position = 0.0;  ///< [m or rad]
  double speed = 0.0;     ///< [m/s or rad/s]
};

/// Moves a joint towards a goal, where it stops, on the fastest trajectory with limited speed and
/// acceleration.
///
/// Its speed is a trapezoid over time, or a triangle if the way is too short to reach the maximum
/// speed; see Lynch and Park, Modern Robotics (2017), sec. 9.2.2. Unlike there, the joint may
/// already move: it brakes first if it moves away from the goal, too fast, or so fast that it
/// passes the goal. The phases are integrated exactly, so a result does not depend on how a time is
/// divided into steps, apart from rounding.
///
/// @param speed         maximum, > 0 [m/s or rad/s].
/// @param acceleration  magnitude while the speed changes, > 0 [m/s^2 or rad/s^2].
/// @param dt_s          >= 0 [s].
[[nodiscard]] JointMotion advance_to_goal(JointMotion motion, double goal, double speed,
                                          double acceleration, double dt_s);

/// Moves a joint whose motor has a constant current. The motor's torque is proportional to the
/// current, and the friction is proportional to the speed:
///
///     d speed / dt = acceleration_max (current / current_max - speed / speed_max)
///
/// So the speed approaches speed_max current / current_max with the time constant speed_max /
/// acceleration_max. The result is exact; the joint's limits are not considered.
/// @param current_share  current / current_max, [-1, 1].
[[nodiscard]] JointMotion advance_with_current(JointMotion motion, double current_share,
                                               const JointTravel& travel, double dt_s);

/// The way of all joints of an arm; see TrajectoryCommand.
struct ArmTrajectory {
  SimTime start_ns = 0;
  bool has_started = false;
  std::vector<double> origin;     ///< positions at the start [m or rad]
  std::vector<double> times_s;    ///< after the start
  std::vector<double> positions;  ///< of all joints for each time [m or rad]

  /// Where a joint is to be at a time after the start [m or rad].
  [[nodiscard]] double position(std::size_t joint, double time_s) const;
  void archive(StateArchive& archive);
};

/// An arm: joints in series, each with its own motor. Takes JointCommand, JointSettingCommand and
/// TrajectoryCommand.
///
/// Kinematic: joints have no mass, do not influence each other and collide with nothing. Position
/// commands and speed commands follow advance_to_goal(), commands with a current follow
/// advance_with_current(). A goal beyond the limits is replaced by the limit, and a speed, an
/// acceleration or a current by its maximum. A joint stops at its limits. Without power, and under
/// an applied brake, a joint stops at once, forgets its command and ignores others. Initially all
/// joints are at their home positions, and the brakes are released.
///
/// On a trajectory, each joint moves at a constant speed from its position at the start, or from
/// the last positions of the list, to the next ones, and is there at their time; accelerations are
/// not limited. A joint that is commanded faster than its maximum speed comes later. Any
/// JointCommand or TrajectoryCommand ends the trajectory, and so does the loss of power.
class ActArray final : public SensorOf<ActArrayReading> {
 public:
  ActArray(std::string name, const ActArrayParams& params);

  /// The settings, with the default joints if the world has none.
  [[nodiscard]] const ActArrayParams& params() const noexcept { return params_; }

  /// Whether all joints are at rest.
  [[nodiscard]] bool at_rest() const noexcept;
  /// Whether a trajectory is on its way, or waits for its start.
  [[nodiscard]] bool on_trajectory() const noexcept { return trajectory_.has_value(); }
  /// Names of all joints, in their order.
  [[nodiscard]] std::vector<std::string> joint_names() const;
  /// Positions of all joints now [m or rad].
  [[nodiscard]] std::vector<double> positions() const;
  /// Pose of the end of the last link in B.
  [[nodiscard]] Eigen::Isometry3d end_in_body() const;

  std::optional<std::string> apply(const Command& command) override;
  void integrate(const StepContext& context) override;
  void show(SimTime now_ns, RobotSnapshot& shot) const override;
  void archive(StateArchive& archive) override;

 protected:
  void measure(const StepContext& context) override;

 private:
  enum class Mode { kStill, kGoal, kSpeed, kCurrent };
  struct Joint {
    JointTravel travel;
    double current_max_a = 1.0;
    bool has_brake = false;

    JointMotion motion;
    double mean_acceleration = 0.0;  // over the last step
    double speed_setting = 0.0;
    double acceleration_setting = 0.0;
    Mode mode = Mode::kStill;
    double goal = 0.0;           // of the modes kGoal and kSpeed
    double speed = 0.0;          // maximum on the way to the goal
    double acceleration = 0.0;   // on the way to the goal
    double current_share = 0.0;  // of the mode kCurrent
    bool is_stalled = false;

    void go_to(double position);
    void move_at(double wanted);
    void push(double current_a);
    void stop();
    void step(double dt_s);
    [[nodiscard]] double current_a() const;
    void archive(StateArchive& archive);
  };

  [[nodiscard]] std::optional<std::string> apply(const JointCommand& command);
  [[nodiscard]] std::optional<std::string> apply(const JointSettingCommand& command);
  [[nodiscard]] std::optional<std::string> apply(const TrajectoryCommand& command);
  [[nodiscard]] std::optional<std::string> set_brakes(bool applied);
  void follow_trajectory(const StepContext& context);
  [[nodiscard]] std::string no_such_joint(int joint) const;
  [[nodiscard]] bool is_braked(const Joint& joint) const { return brakes_ && joint.has_brake; }
  [[nodiscard]] JointState state_of(const Joint& joint) const;

  ActArrayParams params_;
  std::vector<Joint> joints_;
  bool is_powered_;
  bool brakes_ = false;  // applied
  std::optional<ArmTrajectory> trajectory_;
};

}  // namespace sim
