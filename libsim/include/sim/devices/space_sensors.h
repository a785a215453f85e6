// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <utility>

#include "sim/core/elevation.h"
#include "sim/devices/noisy_sensor.h"

/// @file
/// Sensors of the motion in space, as MORSE has them: velocity, accelerometer, gyroscope, attitude.
namespace sim {

/// Settings of a velocity sensor.
struct VelocityParams : SensorMount {
  double frequency_hz = 10.0;  ///< [Hz]
  double noise_mps = 0.0;      ///< standard deviation of each linear velocity [m/s]
  double noise_radps = 0.0;    ///< standard deviation of each turn rate [rad/s]
  double latency_s = 0.0;      ///< [s]
};

/// A reading of a velocity sensor: the velocity of its robot's body.
struct VelocityReading final : Reading {
  std::array<double, 3> linear_mps{};     ///< along the sensor's axes [m/s]
  std::array<double, 3> angular_radps{};  ///< about the sensor's axes [rad/s]
  std::array<double, 3> world_mps{};      ///< linear velocity along W's axes [m/s]
};

/// Measures the velocity of the body, as achieved in the last step (MORSE's Velocity).
class Velocity final : public MountedSensor<VelocityParams, VelocityReading> {
 public:
  Velocity(std::string name, const VelocityParams& params, RandomStream noise)
      : MountedSensor(std::move(name), "velocity", params, std::move(noise)) {}

 protected:
  void measure(const StepContext& context) override;
};

/// Settings of an accelerometer.
struct AccelerometerParams : SensorMount {
  double frequency_hz = 10.0;  ///< [Hz]
  double noise_mps2 = 0.0;     ///< standard deviation of each acceleration [m/s^2]
  double latency_s = 0.0;      ///< [s]
};

/// A reading of an accelerometer, along the sensor's axes; without gravity, as in MORSE.
struct AccelerometerReading final : Reading {
  double distance_m = 0.0;                    ///< from its place at the last reading [m]
  std::array<double, 3> velocity_mps{};       ///< of the body [m/s]
  std::array<double, 3> acceleration_mps2{};  ///< mean value since the last reading [m/s^2]
  std::array<double, 3> angular_radps2{};     ///< angular acceleration [rad/s^2]
};

/// Measures the change of the body's velocity since the last reading (MORSE's Accelerometer).
class Accelerometer final : public MountedSensor<AccelerometerParams, AccelerometerReading> {
 public:
  Accelerometer(std::string name, const AccelerometerParams& params, RandomStream noise)
      : MountedSensor(std::move(name), "accelerometer", params, std::move(noise)) {}
  void archive(StateArchive& archive) override;

 protected:
  void measure(const StepContext& context) override;

 private:
  bool has_before_ = false;  ///< the members below are those of the last reading
  std::array<double, 3> p_W_m_{};
  std::array<double, 3> v_W_mps_{};
  double omega_radps_ = 0.0;
  SimTime before_ns_ = 0;
};

/// Settings of a gyroscope.
struct GyroscopeParams : SensorMount {
  double frequency_hz = 10.0;  ///< [Hz]
  double noise_rad = 0.0;      ///< standard deviation of each angle [rad]
  double latency_s = 0.0;      ///< [s]
};

/// A reading of a gyroscope: the sensor's orientation in W [rad].
struct GyroscopeReading final : Reading {
  double yaw_rad = 0.0;
  double pitch_rad = 0.0;
  double roll_rad = 0.0;
};

/// Measures its orientation in W (MORSE's Gyroscope).
class Gyroscope final : public MountedSensor<GyroscopeParams, GyroscopeReading> {
 public:
  Gyroscope(std::string name, const GyroscopeParams& params, RandomStream noise)
      : MountedSensor(std::move(name), "gyroscope", params, std::move(noise)) {}

 protected:
  void measure(const StepContext& context) override;
};

/// Settings of an attitude sensor.
struct AttitudeParams : SensorMount {
  double frequency_hz = 10.0;  ///< [Hz]
  double noise_rad = 0.0;      ///< standard deviation of each angle [rad]
  double noise_radps = 0.0;    ///< standard deviation of each turn rate [rad/s]
  double latency_s = 0.0;      ///< [s]
};

/// A reading of an attitude sensor.
struct AttitudeReading final : Reading {
  double yaw_rad = 0.0;                ///< orientation in W
  double pitch_rad = 0.0;              ///< orientation in W
  double roll_rad = 0.0;               ///< orientation in W
  std::array<double, 3> rate_radps{};  ///< about the sensor's axes: mean since the last reading
};

/// Measures its orientation in W and its turn rates (MORSE's Attitude).
class Attitude final : public MountedSensor<AttitudeParams, AttitudeReading> {
 public:
  Attitude(std::string name, const AttitudeParams& params, RandomStream noise)
      : MountedSensor(std::move(name), "attitude", params, std::move(noise)) {}
  void archive(StateArchive& archive) override;

 protected:
  void measure(const StepContext& context) override;

 private:
  bool has_before_ = false;  ///< the members below are those of the last reading
  EulerAngles before_;
  SimTime before_ns_ = 0;
};

/// The orientation of a sensor in W. If the sensor's frame is that of the body, the angles are
/// exactly those of the body, also beyond a pitch of a quarter turn.
[[nodiscard]] EulerAngles orientation_of(const Mounting& mounting, const BodyState& body);

}  // namespace sim
