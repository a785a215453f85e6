// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/devices/space_sensors.h"

#include <cmath>
#include <utility>

#include "devices/device_kind.h"
#include "devices/modifiers.h"

namespace sim {
namespace {

using Vec3 = Eigen::Vector3d;

std::array<double, 3> array_of(const Vec3& v) { return {v.x(), v.y(), v.z()}; }
Vec3 vector_of(const std::array<double, 3>& a) { return {a[0], a[1], a[2]}; }

void add_noise(RandomStream& noise, double sigma, std::array<double, 3>& values) {
  if (sigma <= 0.0) return;
  for (double& value : values) value += noise.gaussian(sigma);
}

Vec3 velocity_in_body(const BodyState& body) {
  return {body.twist.v_mps, body.twist.lateral_mps, 0.0};
}
Vec3 turn_in_body(const BodyState& body) { return {0.0, 0.0, body.twist.omega_radps}; }

}  // namespace

EulerAngles orientation_of(const Mounting& mounting, const BodyState& body) {
  if (mounting.is_trivial()) {
    return {body.elevation.roll_rad, body.elevation.pitch_rad, body.X_WB.yaw_rad};
  }
  return euler_angles_of(mounting.in_world(body).linear());
}

// --- velocity

void Velocity::measure(const StepContext& context) {
  auto& reading = next(context);
  const BodyState& body = context.body;
  const Eigen::Matrix3d R_SB = mounting().in_body().linear().transpose();
  const Eigen::Matrix3d R_WB = in_space(body.X_WB, body.elevation).linear();
  reading.linear_mps = array_of(R_SB * velocity_in_body(body));
  reading.angular_radps = array_of(R_SB * turn_in_body(body));
  reading.world_mps = array_of(R_WB * velocity_in_body(body));
  add_noise(noise(), params().noise_mps, reading.linear_mps);
  add_noise(noise(), params().noise_radps, reading.angular_radps);
  add_noise(noise(), params().noise_mps, reading.world_mps);
}

constexpr Field kVelocitySettings[] = {
    frequency_field<&VelocityParams::frequency_hz>(),
    field<&VelocityParams::noise_mps>("noise", "m/s", "standard deviation of a linear velocity")
        .within(0.0, 100.0)
        .with_realism(0.0, 0.01),
    field<&VelocityParams::noise_radps>("noise_rate_deg", "degrees/s",
                                        "standard deviation of a turn rate")
        .within(0.0, 3600.0)
        .with_realism(0.0, 0.2),
    latency_field<&VelocityParams::latency_s>(),
    include<VelocityParams, SensorMount>(),
};
SIM_FIELDS(VelocityParams, kVelocitySettings)

constexpr Field kVelocityReading[] = {
    field<&VelocityReading::linear_mps>("linear", "m/s", "in the sensor's axes"),
    field<&VelocityReading::angular_radps>("angular", "rad/s", "in the sensor's axes"),
    field<&VelocityReading::world_mps>("world", "m/s", "in the world's axes"),
};
SIM_FIELDS(VelocityReading, kVelocityReading)

DeviceKind velocity_kind() {
  return device_kind<Velocity, VelocityParams, VelocityReading>("velocity", {});
}

// --- accelerometer

void Accelerometer::measure(const StepContext& context) {
  auto& reading = next(context);
  const BodyState& body = context.body;
  const Eigen::Matrix3d R_SB = mounting().in_body().linear().transpose();
  const Eigen::Isometry3d X_WB = in_space(body.X_WB, body.elevation);
  const Vec3 p_W = mounting().in_world(body).translation();
  const Vec3 v_W = X_WB.linear() * velocity_in_body(body);
  reading.velocity_mps = array_of(R_SB * velocity_in_body(body));
  reading.distance_m = 0.0;
  reading.acceleration_mps2 = {};
  reading.angular_radps2 = {};
  const double dt_s = to_seconds(context.now_ns - before_ns_);
  if (has_before_ && dt_s > 0.0) {
    const Vec3 a_W = (v_W - vector_of(v_W_mps_)) / dt_s;
    const Vec3 alpha(0.0, 0.0, (body.twist.omega_radps - omega_radps_) / dt_s);
    reading.distance_m = (p_W - vector_of(p_W_m_)).norm();
    reading.acceleration_mps2 = array_of(R_SB * (X_WB.linear().transpose() * a_W));
    reading.angular_radps2 = array_of(R_SB * alpha);
  }
  add_noise(noise(), params().noise_mps2, reading.acceleration_mps2);
  has_before_ = true;
  p_W_m_ = array_of(p_W);
  v_W_mps_ = array_of(v_W);
  omega_radps_ = body.twist.omega_radps;
  before_ns_ = context.now_ns;
}

void Accelerometer::archive(StateArchive& archive) {
  MountedSensor::archive(archive);
  archive(has_before_, p_W_m_, v_W_mps_, omega_radps_, before_ns_);
}

constexpr Field kAccelerometerSettings[] = {
    frequency_field<&AccelerometerParams::frequency_hz>(),
    field<&AccelerometerParams::noise_mps2>("noise", "m/s^2",
                                            "standard deviation of an acceleration")
        .within(0.0, 1000.0)
        .with_realism(0.0, 0.02),
    latency_field<&AccelerometerParams::latency_s>(),
    include<AccelerometerParams, SensorMount>(),
};
SIM_FIELDS(AccelerometerParams, kAccelerometerSettings)

constexpr Field kAccelerometerReading[] = {
    field<&AccelerometerReading::distance_m>("distance", "m", "from its place at the last reading"),
    field<&AccelerometerReading::velocity_mps>("velocity", "m/s", "in the sensor's axes"),
    field<&AccelerometerReading::acceleration_mps2>("acceleration", "m/s^2",
                                                    "in the sensor's axes"),
    field<&AccelerometerReading::angular_radps2>("angular_acceleration", "rad/s^2",
                                                 "in the sensor's axes"),
};
SIM_FIELDS(AccelerometerReading, kAccelerometerReading)

DeviceKind accelerometer_kind() {
  return device_kind<Accelerometer, AccelerometerParams, AccelerometerReading>("accelerometer",
                                                                               {{"imu", 3}});
}

// --- gyroscope

void Gyroscope::measure(const StepContext& context) {
  auto& reading = next(context);
  const EulerAngles now = orientation_of(mounting(), context.body);
  std::array<double, 3> angles{now.yaw_rad, now.pitch_rad, now.roll_rad};
  add_noise(noise(), params().noise_rad, angles);
  reading.yaw_rad = normalize_angle(angles[0]);
  reading.pitch_rad = normalize_angle(angles[1]);
  reading.roll_rad = normalize_angle(angles[2]);
}

constexpr const char* kGyroscopeNoiseNames[] = {"PoseNoise", "Noise"};
constexpr ModifierParameter kGyroscopeNoise[] = {
    {"rot_std",
     5.0 / 180.0 * 3.14159265358979323846,  // MORSE's default: 5 degrees
     {0.0, 6.0, false, "rad"},
     "noise_deg",
     [](void* params, double value) { static_cast<GyroscopeParams*>(params)->noise_rad = value; }},
};
constexpr Modifier kGyroscopeModifiers[] = {{kGyroscopeNoiseNames, kGyroscopeNoise}};

constexpr Field kGyroscopeSettings[] = {
    frequency_field<&GyroscopeParams::frequency_hz>(),
    field<&GyroscopeParams::noise_rad>("noise_deg", "degrees", "standard deviation of an angle")
        .within(0.0, 360.0)
        .with_realism(0.0, 0.2),
    latency_field<&GyroscopeParams::latency_s>(),
    include<GyroscopeParams, SensorMount>(),
    modifiers_field<kGyroscopeModifiers>(),
};
SIM_FIELDS(GyroscopeParams, kGyroscopeSettings)

constexpr Field kGyroscopeReading[] = {
    field<&GyroscopeReading::yaw_rad>("yaw", "rad", "orientation in the world"),
    field<&GyroscopeReading::pitch_rad>("pitch", "rad", "orientation in the world"),
    field<&GyroscopeReading::roll_rad>("roll", "rad", "orientation in the world"),
};
SIM_FIELDS(GyroscopeReading, kGyroscopeReading)

DeviceKind gyroscope_kind() {
  return device_kind<Gyroscope, GyroscopeParams, GyroscopeReading>("gyroscope", {{"imu", 2}});
}

// --- attitude

void Attitude::measure(const StepContext& context) {
  auto& reading = next(context);
  const EulerAngles now = orientation_of(mounting(), context.body);
  reading.rate_radps = {};
  const double dt_s = to_seconds(context.now_ns - before_ns_);
  if (has_before_ && dt_s > 0.0) {
    const EulerAngles turned{normalize_angle(now.roll_rad - before_.roll_rad),
                             normalize_angle(now.pitch_rad - before_.pitch_rad),
                             normalize_angle(now.yaw_rad - before_.yaw_rad)};
    reading.rate_radps = body_rates(
        {before_.roll_rad + 0.5 * turned.roll_rad, before_.pitch_rad + 0.5 * turned.pitch_rad,
         before_.yaw_rad + 0.5 * turned.yaw_rad},
        {turned.roll_rad / dt_s, turned.pitch_rad / dt_s, turned.yaw_rad / dt_s});
  }
  has_before_ = true;
  before_ = now;
  before_ns_ = context.now_ns;
  std::array<double, 3> angles{now.yaw_rad, now.pitch_rad, now.roll_rad};
  add_noise(noise(), params().noise_rad, angles);
  add_noise(noise(), params().noise_radps, reading.rate_radps);
  reading.yaw_rad = normalize_angle(angles[0]);
  reading.pitch_rad = normalize_angle(angles[1]);
  reading.roll_rad = normalize_angle(angles[2]);
}

void Attitude::archive(StateArchive& archive) {
  MountedSensor::archive(archive);
  archive(has_before_, before_.roll_rad, before_.pitch_rad, before_.yaw_rad, before_ns_);
}

constexpr Field kAttitudeSettings[] = {
    frequency_field<&AttitudeParams::frequency_hz>(),
    field<&AttitudeParams::noise_rad>("noise_deg", "degrees", "standard deviation of an angle")
        .within(0.0, 360.0)
        .with_realism(0.0, 0.2),
    field<&AttitudeParams::noise_radps>("noise_rate_deg", "degrees/s",
                                        "standard deviation of a turn rate")
        .within(0.0, 3600.0)
        .with_realism(0.0, 0.2),
    latency_field<&AttitudeParams::latency_s>(),
    include<AttitudeParams, SensorMount>(),
};
SIM_FIELDS(AttitudeParams, kAttitudeSettings)

constexpr Field kAttitudeReading[] = {
    field<&AttitudeReading::yaw_rad>("yaw", "rad", "orientation in the world"),
    field<&AttitudeReading::pitch_rad>("pitch", "rad", "orientation in the world"),
    field<&AttitudeReading::roll_rad>("roll", "rad", "orientation in the world"),
    field<&AttitudeReading::rate_radps>("rate", "rad/s", "turn rates"),
};
SIM_FIELDS(AttitudeReading, kAttitudeReading)

DeviceKind attitude_kind() {
  return device_kind<Attitude, AttitudeParams, AttitudeReading>("attitude", {});
}

}  // namespace sim
