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

/// How much of its work an odometry device shows to clients that ask by MORSE's protocol. Its
/// readings hold all of it, whatever the level.
enum class OdometryLevel {
  kIntegrated,    ///< the pose since the start
  kDifferential,  ///< the motion since the last reading
  kRaw,           ///< the length of the way since the last reading
};

/// Settings of the wheel odometry.
struct OdometryParams {
  double frequency_hz = 10.0;  ///< (0, 1000]
  double noise = 0.0;          ///< deviation of a wheel's path [m] after 1 m of it; grows with
                               ///< the root of the path (see Odometry)
  OdometryLevel level = OdometryLevel::kIntegrated;
};

/// Where a localisation device thinks its robot is, and how it moves.
struct PoseReading final : Reading {
  Pose pose;             ///< pose device: X_WB; odometry: X_SB, S the robot's start (or as set)
  Twist twist;           ///< in B, as achieved over the last step
  bool stalled = false;  ///< see BodyState

  /// @name Since the previous reading (the first: since the start); odometry only, else zero
  /// @{
  double path_length_m = 0.0;  ///< way of the wheels' midpoint, forth and back both counted [m]
  Pose increment;  ///< X_RB, R: B at the previous reading. SetPoseCommand leaves it alone
  /// The same shift along S's axes, in which MORSE's dx and dy are given [m].
  [[nodiscard]] Vec2 shift_m() const {
    return pose.position() - (pose * increment.inverse()).position();
  }
  /// @}
};

/// The arena's localisation: the true pose, with noise if asked for.
/// SetPoseCommand moves the frame it reports in, so that the robot's present pose reads as given.
class PoseSensor final : public SensorOf<PoseReading> {
 public:
  /// @param X_WB_start  where the robot stands before the first step.
  PoseSensor(std::string name, const PoseParams& params, const Pose& X_WB_start,
             RandomStream noise);

  std::optional<std::string> apply(const Command& command) override;
  void integrate(const StepContext& context) override;
  void placed(const Pose& X_WB) override { X_WB_ = X_WB; }
  /// The pose without noise, in the frame that is reported in.
  [[nodiscard]] std::optional<Pose> believed_pose() const override { return X_FW_ * X_WB_; }
  void archive(StateArchive& archive) override;

 protected:
  void measure(const StepContext& context) override;

 private:
  PoseParams params_;
  RandomStream noise_;
  Pose X_WB_;  ///< true, at the last step
  Pose X_FW_;  ///< of the world in the frame that is reported in; identity until set
};

/// Wheel odometry: integrates the true motion of the wheels from the robot's start.
///
/// Model: per step the wheels' midpoint moves ds forward and turns dyaw; the pose follows the arc,
/// x += ds sinc(dyaw/2) cos(yaw + dyaw/2), and so y (Siegwart, Nourbakhsh, Scaramuzza, Introduction
/// to Autonomous Mobile Robots, 2nd ed., sec. 5.2.4, with the exact chord). A robot that is shoved
/// sideways does not notice, unless its drive is omnidirectional: then its wheels roll that way
/// too, and the chord has a part to the left. With noise, each wheel's path in a step gets Gaussian
/// noise of variance noise^2 |path| (Chong and Kleeman, "Accurate odometry and error modelling for
/// a mobile robot", ICRA 1997); of an omnidirectional drive, so does the way to the left.
class Odometry final : public SensorOf<PoseReading> {
 public:
  /// @param omnidirectional  whether the wheels measure motion to the left as well.
  Odometry(std::string name, const OdometryParams& params, double wheel_separation_m,
           bool omnidirectional, RandomStream noise);

  std::optional<std::string> apply(const Command& command) override;
  void integrate(const StepContext& context) override;
  [[nodiscard]] std::optional<Pose> believed_pose() const override { return X_SB_; }
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
