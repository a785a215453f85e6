// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <memory>
#include <numbers>
#include <optional>
#include <string>

#include "sim/devices/device.h"

namespace sim {

/// Settings of an inertial measurement unit in the middle of the axle, its axes those of the body.
struct ImuParams {
  double frequency_hz = 10.0;  ///< (0, 1000]
  double noise_mps2 = 0.0;     ///< standard deviation of an acceleration [m/s^2], >= 0
  double noise_radps = 0.0;    ///< of a turning rate [rad/s], >= 0
  double noise_ut = 0.0;       ///< of the magnetic field [uT], >= 0
  double bias_mps2 = 0.0;      ///< standard deviation of the constant error of each axis, >= 0
  double bias_radps = 0.0;     ///< the same of the turning rates [rad/s], >= 0
  double field_horizontal_ut = 20.0;  ///< of the Earth's magnetic field, to the north [uT], >= 0
  double field_down_ut = 45.0;        ///< downwards [uT]; the defaults are about those of Prague
  double north_rad = 0.5 * std::numbers::pi;  ///< direction of north in W, counter-clockwise from x
};

/// What an inertial unit measures, in the body's frame: x forward, y left, z up.
struct ImuReading final : Reading {
  std::array<double, 3> acceleration_mps2{};  ///< specific force: at rest z reads +g [m/s^2]
  std::array<double, 3> rate_radps{};         ///< turning rates [rad/s]
  std::array<double, 3> field_ut{};           ///< magnetic field [uT]
  double yaw_rad = 0.0;  ///< the measured turning rate added up, from the true heading in W at the
                         ///< start on, or what SetPoseCommand said it was, (-pi, pi]
};

/// Standard acceleration of gravity (ISO 80000-3) [m/s^2].
inline constexpr double kGravity_mps2 = 9.80665;

/// The Earth's magnetic field in a body's frame [uT].
/// @param yaw_rad  heading of the body in W.
[[nodiscard]] std::array<double, 3> field_in_body_ut(const ImuParams& params, double yaw_rad);

/// An inertial measurement unit. Accelerations and turning rates are means over the time since the
/// reading before, so that none is missed: in the body's frame a = dv/dt + omega x v. Then come
/// biases, drawn once, and white noise. Being placed somewhere is not felt. Of a SetPoseCommand it
/// takes the heading: the present one is that.
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
  Twist before_;               ///< at the end of the last step
  double gained_x_mps_ = 0.0;  ///< acceleration times time since the last reading
  double gained_y_mps_ = 0.0;
  double turned_rad_ = 0.0;
  double time_s_ = 0.0;
  double yaw_rad_;
};

}  // namespace sim
