// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "sim/devices/coordinates.h"
#include "sim/devices/device.h"
#include "sim/devices/mount.h"

namespace sim {

/// Settings of the arena's localisation (the pose sensor).
struct PoseParams : SensorMount, CoordinateParams {
  double frequency_hz = 10.0;   ///< [Hz]
  double noise_m = 0.0;         ///< standard deviation of x and of y [m]
  double noise_yaw_rad = 0.0;   ///< standard deviation of yaw [rad]
  bool noise_in_space = false;  ///< z, roll and pitch get the same noise as x and yaw
  double latency_s = 0.0;       ///< from a measurement until its reading [s]
};

/// Which part of its data an odometry device shows to clients that use MORSE's protocol. Its
/// readings always contain all of it.
enum class OdometryLevel {
  kIntegrated,    ///< the pose since the start
  kDifferential,  ///< the motion since the last reading
  kRaw,           ///< the path length since the last reading
};

/// Settings of the wheel odometry.
struct OdometryParams {
  double frequency_hz = 10.0;  ///< [Hz]
  double noise = 0.0;          ///< standard deviation of a wheel's path after 1 m [m]; grows with
                               ///< the square root of the path (see Odometry)
  OdometryLevel level = OdometryLevel::kIntegrated;
  Pose start;  ///< what it reads before the first step
  /// @name Systematic errors (see Odometry)
  /// @{
  double wheel_ratio = 1.0;        ///< E_d: diameter of the right wheel / of the left
  double wheelbase_ratio = 1.0;    ///< E_b: true wheelbase / the assumed one
  double scale = 1.0;              ///< factor of all distances
  double side_scale = 1.0;         ///< further factor of distances sideways
  double heading_drift_radps = 0;  ///< added to the turn rate [rad/s]
  /// @}
  /// @name Further noise
  /// @{
  double scale_noise = 0.0;         ///< standard deviation of the factor, new for each reading
  double heading_noise_rad = 0.0;   ///< standard deviation of the heading after 1 s [rad];
                                    ///< grows with the square root of time
  double noise_pose_m = 0.0;        ///< of x and y of single readings [m]
  double noise_pose_yaw_rad = 0.0;  ///< of yaw of single readings [rad]
  bool noise_in_space = false;      ///< z, roll and pitch of single readings get noise, too
  /// @}
  double latency_s = 0.0;  ///< from a measurement until its reading [s]
};

/// The robot's pose as estimated by a localisation device, and its motion.
struct PoseReading final : Reading {
  Pose pose;             ///< pose device: X_WB; odometry: X_SB, with S the robot's start (or as set
                         ///< by SetPoseCommand)
  Twist twist;           ///< in B, as achieved in the last step
  bool stalled = false;  ///< see BodyState
  Elevation elevation;   ///< height and inclination, in W; odometry: zero except for noise

  /// @name Since the previous reading, or since the start for the first; zero except for odometry
  /// @{
  double path_length_m = 0.0;  ///< path length of the wheels' midpoint, either direction [m]
  Pose increment;  ///< X_RB, with R the frame B at the previous reading; SetPoseCommand does not
                   ///< affect it
  /// The same displacement along S's axes, as in MORSE's dx and dy [m].
  [[nodiscard]] Vec2 shift_m() const {
    return pose.position() - (pose * increment.inverse()).position();
  }
  /// @}
};

/// The arena's localisation: the true pose, optionally with noise. SetPoseCommand shifts the frame
/// of its reports, so that the robot's current pose is reported as given.
class PoseSensor final : public SensorOf<PoseReading> {
 public:
  /// @param X_WB_start  pose of the robot before the first step.
  PoseSensor(std::string name, const PoseParams& params, const Pose& X_WB_start,
             RandomStream noise);

  std::optional<std::string> connect(std::string_view robot,
                                     const DeviceDirectory& devices) override;
  [[nodiscard]] std::string_view carrier() const noexcept override { return mounting_.carrier(); }
  std::optional<std::string> apply(const Command& command) override;
  void integrate(const StepContext& context) override;
  void placed(const Pose& X_WB) override { X_WB_ = X_WB; }
  /// The pose without noise, in the frame of the reports.
  [[nodiscard]] std::optional<Pose> pose_estimate() const override { return X_FW_ * X_WB_; }
  void archive(StateArchive& archive) override;

 protected:
  void measure(const StepContext& context) override;

 private:
  PoseParams params_;
  Mounting mounting_;
  RandomStream noise_;
  Pose X_WB_;  ///< true, at the last step
  Pose X_FW_;  ///< pose of the world in the frame of the reports; identity until set
};

/// Wheel odometry: integrates the true motion of the wheels, beginning at the robot's start.
///
/// Model: in each step the wheels' midpoint moves ds forward and turns by dyaw. The pose follows
/// the arc: x += ds sinc(dyaw/2) cos(yaw + dyaw/2), and y with the sine (Siegwart, Nourbakhsh,
/// Scaramuzza, Introduction to Autonomous Mobile Robots, 2nd ed., sec. 5.2.4, with the exact
/// chord). Odometry does not measure a sideways push, unless the drive is omnidirectional: then the
/// wheels roll sideways too, and the chord has a component to the left. With noise, each wheel's
/// path in a step gets Gaussian noise of variance noise^2 |path| (Chong and Kleeman, "Accurate
/// odometry and error modelling for a mobile robot", ICRA 1997). For an omnidirectional drive, the
/// path to the left gets such noise as well.
///
/// Slip: if the motors have slip (MotionParams), the wheels turn farther than they roll, and
/// odometry measures how far they turn: the path over the floor divided by 1 - slip.
///
/// Systematic errors: J. Borenstein and L. Feng, "Measurement and correction of systematic odometry
/// errors in mobile robots", IEEE Trans. Robotics and Automation 12(6), 1996 (UMBmark). The wheels'
/// diameters have the ratio E_d = D_right / D_left and the nominal mean; odometry assumes that they
/// are equal. So it measures the left path times (E_d + 1) / 2 and the right path times
/// (1 / E_d + 1) / 2, the inverses of the paper's correction factors. It assumes the wheelbase
/// b / E_b, with b the true one.
class Odometry final : public SensorOf<PoseReading> {
 public:
  /// @param omnidirectional  whether the wheels measure motion to the left as well.
  /// @param motors  name of the robot's motion device, whose slip it measures; "": none.
  Odometry(std::string name, const OdometryParams& params, double wheel_separation_m,
           bool omnidirectional, std::string motors, RandomStream noise);

  std::optional<std::string> connect(std::string_view robot,
                                     const DeviceDirectory& devices) override;
  std::optional<std::string> apply(const Command& command) override;
  void integrate(const StepContext& context) override;
  [[nodiscard]] std::optional<Pose> pose_estimate() const override { return X_SB_; }
  void archive(StateArchive& archive) override;

 protected:
  void measure(const StepContext& context) override;

 private:
  /// Motion of the wheels' midpoint in a step, as the wheels measure it.
  struct WheelPath {
    double ds_m;
    double side_m;
    double dyaw_rad;
  };
  /// The motion as the wheels turn, without errors of the measurement.
  [[nodiscard]] WheelPath turned(const BodyState& body) const;
  /// Adds the errors of a step of dt_s.
  void add_errors(double dt_s, WheelPath& path);
  void draw_scale();

  OdometryParams params_;
  double wheel_separation_m_;
  bool omnidirectional_;
  bool has_errors_;
  std::string motors_;
  const Motion* slipping_motors_ = nullptr;  ///< null if the wheels do not slip
  Pose X_SB_;
  double path_length_m_ = 0.0;  ///< since the last reading
  RandomStream noise_;
  Pose X_SR_;                 ///< B at the last reading
  double present_scale_ = 1;  ///< of all distances until the next reading
};

}  // namespace sim
