// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/devices/imu.h"

#include <cmath>
#include <utility>

#include "devices/device_kind.h"
#include "devices/modifiers.h"
#include "sim/core/math.h"
#include "sim/world/description.h"

namespace sim {

std::array<double, 3> field_in_body_ut(const ImuParams& params, double yaw_rad) {
  const double north_rad = params.north_rad - yaw_rad;
  return {params.field_horizontal_ut * math::cos(north_rad),
          params.field_horizontal_ut * math::sin(north_rad), -params.field_down_ut};
}

Imu::Imu(std::string name, const ImuParams& params, double yaw_rad, RandomStream noise)
    : SensorOf(std::move(name), "imu", params.frequency_hz, params.latency_s),
      params_(params),
      noise_(std::move(noise)),
      yaw_rad_(yaw_rad) {
  for (double& bias : bias_mps2_) bias = noise_.gaussian(params_.bias_mps2);
  for (double& bias : bias_radps_) bias = noise_.gaussian(params_.bias_radps);
}

std::optional<std::string> Imu::apply(const Command& command) {
  const auto* set = std::get_if<SetPoseCommand>(&command);
  if (set == nullptr) return Device::apply(command);
  if (auto fault = fault_of(*set)) return fault;
  // The next reading adds the rotation since the last reading, including the part before this
  // command.
  yaw_rad_ = normalize_angle(set->pose.yaw_rad - rotation_rad_);
  return std::nullopt;
}

void Imu::integrate(const StepContext& context) {
  const double dt_s = to_seconds(context.world.simulation.step_ns);
  const Twist& now = context.body.twist;
  // The step's rotation is multiplied by the mean of the speeds at its start and end.
  const double lateral = 0.5 * (before_.lateral_mps + now.lateral_mps);
  const double forward = 0.5 * (before_.v_mps + now.v_mps);
  velocity_change_x_mps_ += now.v_mps - before_.v_mps - context.body.turn_rad * lateral;
  velocity_change_y_mps_ += now.lateral_mps - before_.lateral_mps + context.body.turn_rad * forward;
  rotation_rad_ += context.body.turn_rad;
  time_s_ += dt_s;
  before_ = now;
}

void Imu::placed(const Pose&) { before_ = {}; }

void Imu::measure(const StepContext& context) {
  auto& reading = next(context);
  reading.acceleration_mps2 = {velocity_change_x_mps_ / time_s_, velocity_change_y_mps_ / time_s_,
                               kGravity_mps2};
  reading.rate_radps = {0.0, 0.0, rotation_rad_ / time_s_};
  reading.field_ut = field_in_body_ut(params_, context.body.X_WB.yaw_rad);
  for (std::size_t i = 0; i < 3; ++i) {
    reading.acceleration_mps2[i] += bias_mps2_[i] + noise_.gaussian(params_.noise_mps2);
    reading.rate_radps[i] += bias_radps_[i] + noise_.gaussian(params_.noise_radps);
    reading.field_ut[i] += noise_.gaussian(params_.noise_ut);
  }
  yaw_rad_ = normalize_angle(yaw_rad_ + reading.rate_radps[2] * time_s_);
  reading.yaw_rad = yaw_rad_;
  velocity_change_x_mps_ = 0.0;
  velocity_change_y_mps_ = 0.0;
  rotation_rad_ = 0.0;
  time_s_ = 0.0;
}

void Imu::archive(StateArchive& archive) {
  SensorOf::archive(archive);
  archive(noise_, before_, velocity_change_x_mps_, velocity_change_y_mps_, rotation_rad_, time_s_,
          yaw_rad_);
}

constexpr const char* kImuNoiseNames[] = {"IMUNoise", "Noise"};
constexpr ModifierParameter kImuNoise[] = {
    {"gyro_std",
     0.5,
     {0.0, 60.0, false, "rad/s"},
     "noise_rate_deg",
     [](void* params, double value) { static_cast<ImuParams*>(params)->noise_radps = value; }},
    {"accel_std",
     0.5,
     {0.0, 1000.0, false, "m/s^2"},
     "noise_acceleration",
     [](void* params, double value) { static_cast<ImuParams*>(params)->noise_mps2 = value; }},
};
constexpr Modifier kImuModifiers[] = {{kImuNoiseNames, kImuNoise}};

constexpr Field kImuSettings[] = {
    frequency_field<&ImuParams::frequency_hz>(),
    field<&ImuParams::noise_mps2>("noise_acceleration", "m/s^2",
                                  "standard deviation of an acceleration")
        .within(0.0, 1000.0)
        .with_realism(0.0, 0.02),
    field<&ImuParams::noise_radps>("noise_rate_deg", "degrees/s",
                                   "standard deviation of a turn rate")
        .within(0.0, 3600.0)
        .with_realism(0.0, 0.2),
    field<&ImuParams::noise_ut>("noise_field", "uT", "standard deviation of the magnetic field")
        .within(0.0, 1000.0)
        .with_realism(0.0, 0.3),
    field<&ImuParams::bias_mps2>("bias_acceleration", "m/s^2",
                                 "standard deviation of each axis's constant error")
        .within(0.0, 1000.0)
        .with_realism(0.0, 0.03),
    field<&ImuParams::bias_radps>("bias_rate_deg", "degrees/s",
                                  "standard deviation of each turn rate's constant error")
        .within(0.0, 3600.0)
        .with_realism(0.0, 0.1),
    field<&ImuParams::field_horizontal_ut>("field_horizontal", "uT",
                                           "northward component of the Earth's magnetic field")
        .within(0.0, 1000.0),
    field<&ImuParams::field_down_ut>("field_down", "uT", "downward component of that field")
        .within(-1000.0, 1000.0),
    north_field<&ImuParams::north_rad>(),
    latency_field<&ImuParams::latency_s>(),
    modifiers_field<kImuModifiers>(),
};
SIM_FIELDS(ImuParams, kImuSettings)

constexpr Field kImuReading[] = {
    field<&ImuReading::acceleration_mps2>("acceleration", "m/s^2", "in the robot's frame"),
    field<&ImuReading::rate_radps>("rate", "rad/s", "in the robot's frame"),
    field<&ImuReading::field_ut>("field", "uT", "magnetic field in the robot's frame"),
    field<&ImuReading::yaw_rad>("yaw", "rad", "heading integrated from the measured rate"),
};
SIM_FIELDS(ImuReading, kImuReading)

DeviceKind imu_kind() {
  return device_kind<ImuParams, ImuReading>(
      "imu", {{"imu"}}, [](const DeviceConstruction& construction, const ImuParams& params) {
        return std::make_unique<Imu>(construction.name(), params, construction.robot.pose.yaw_rad,
                                     construction.noise());
      });
}

}  // namespace sim
