// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <memory>
#include <numbers>
#include <optional>
#include <string>

#include "sim/devices/device.h"

namespace sim {

/// Settings of an inertial measurement unit at the centre of the axle, aligned with the body.
struct ImuParams {
  double frequency_hz = 10.0;  ///< [Hz]
  double noise_mps2 = 0.0;     ///< standard deviation of an acceleration [m/s^2]
  double noise_radps = 0.0;    ///< standard deviation of a turning rate [rad/s]
  double noise_ut = 0.0;       ///< standard deviation of the magnetic field [uT]
  double bias_mps2 = 0.0;      ///< standard deviation of the constant bias of each acceleration
                               ///< [m/s^2]
  double bias_radps = 0.0;     ///< standard deviation of the constant bias of each turning rate
                               ///< [rad/s]
  double field_horizontal_ut = 20.0;  ///< horizontal magnetic field of the Earth [uT]
  double field_down_ut = 45.0;        ///< downward component [uT]; by default about that in Prague
  double north_rad = 0.5 * std::numbers::pi;  ///< direction of north in W, counter-clockwise from x
  double latency_s = 0.0;                     ///< [s]
};

/// A reading of an inertial unit, in the body's frame: x forward, y left, z up.
struct ImuReading final : Reading {
  std::array<double, 3> acceleration_mps2{};  ///< specific force: at rest z reads +g [m/s^2]
  std::array<double, 3> rate_radps{};         ///< turning rates [rad/s]
  std::array<double, 3> field_ut{};           ///< magnetic field [uT]
  double yaw_rad = 0.0;  ///< integral of the measured turning rate, (-pi, pi]; starts at the true
                         ///< heading in W, or at the one that SetPoseCommand set
};

/// Standard acceleration of gravity (ISO 80000-3) [m/s^2].
inline constexpr double kGravity_mps2 = 9.80665;

/// The Earth's magnetic field in the body's frame [uT].
/// @param yaw_rad  heading of the body in W.
[[nodiscard]] std::array<double, 3> field_in_body_ut(const ImuParams& params, double yaw_rad);

/// An inertial measurement unit. Accelerations and turning rates are averages over the time since
/// the previous reading, so no motion is missed. In the body's frame, a = dv/dt + omega x v.
/// Constant biases, drawn once, and white noise are added. Placing the robot causes no
/// acceleration. A SetPoseCommand sets the current heading; its position is ignored.
class Imu final : public SensorOf<ImuReading> {
 public:
  /// @param yaw_rad  true heading in W at the start.
  Imu(std::string name, const ImuParams& params, double yaw_rad, RandomStream noise);

  std::optional<std::string> apply(const Command& command) override;
  void integrate(const StepContext& context) override;
  void placed(const Pose& X_WB) override;
  void archive(StateArchive& archive) override;

 protected:
  void measure(const StepContext& context) override;

 private:
  ImuParams params_;
  RandomStream noise_;
  std::array<double, 3> bias_mps2_{};
  std::array<double, 3> bias_radps_{};
  Twist before_;                        ///< twist at the end of the last step
  double velocity_change_x_mps_ = 0.0;  ///< integral of the acceleration since the last reading
  double velocity_change_y_mps_ = 0.0;
  double rotation_rad_ = 0.0;
  double time_s_ = 0.0;
  double yaw_rad_;
};

}  // namespace sim
