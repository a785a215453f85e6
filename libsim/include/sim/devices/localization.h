// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "sim/devices/device.h"

namespace sim {

/// Settings of the arena's localisation (the pose sensor).
struct PoseParams {
  double frequency_hz = 10.0;  ///< (0, 1000]
  double noise_m = 0.0;        ///< standard deviation of x and of y [m], >= 0
  double noise_yaw_rad = 0.0;  ///< standard deviation of yaw [rad], >= 0
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
  double frequency_hz = 10.0;  ///< (0, 1000]
  double noise = 0.0;          ///< standard deviation of a wheel's path after 1 m [m]; grows with
                               ///< the square root of the path (see Odometry)
  OdometryLevel level = OdometryLevel::kIntegrated;
};

/// The robot's pose as estimated by a localisation device, and its motion.
struct PoseReading final : Reading {
  Pose pose;             ///< pose device: X_WB; odometry: X_SB, with S the robot's start (or as set
                         ///< by SetPoseCommand)
  Twist twist;           ///< in B, as achieved in the last step
  bool stalled = false;  ///< see BodyState

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
class Odometry final : public SensorOf<PoseReading> {
 public:
  /// @param omnidirectional  whether the wheels measure motion to the left as well.
  Odometry(std::string name, const OdometryParams& params, double wheel_separation_m,
           bool omnidirectional, RandomStream noise);

  std::optional<std::string> apply(const Command& command) override;
  void integrate(const StepContext& context) override;
  [[nodiscard]] std::optional<Pose> pose_estimate() const override { return X_SB_; }
  void archive(StateArchive& archive) override;

 protected:
  void measure(const StepContext& context) override;

 private:
  OdometryParams params_;
  double wheel_separation_m_;
  bool omnidirectional_;
  Pose X_SB_;
  double path_length_m_ = 0.0;  ///< since the last reading
  RandomStream noise_;
  Pose X_SR_;  ///< B at the last reading
};

}  // namespace sim
