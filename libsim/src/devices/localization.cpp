// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/devices/localization.h"

#include <cmath>

#include "devices/device_kind.h"

namespace sim {
namespace {

double sinc(double x) { return std::abs(x) < 1e-8 ? 1.0 : std::sin(x) / x; }

}  // namespace

PoseSensor::PoseSensor(std::string name, const PoseParams& params, const Pose& X_WB_start,
                       RandomStream noise)
    : SensorOf(std::move(name), "pose", params.frequency_hz),
      params_(params),
      noise_(std::move(noise)),
      X_WB_(X_WB_start) {}

std::optional<std::string> PoseSensor::apply(const Command& command) {
  const auto* set = std::get_if<SetPoseCommand>(&command);
  if (set == nullptr) return Device::apply(command);
  X_FW_ = set->pose * X_WB_.inverse();
  return std::nullopt;
}

void PoseSensor::integrate(const StepContext& context) { X_WB_ = context.body.X_WB; }

void PoseSensor::measure(const StepContext& context) {
  auto& reading = next(context);
  // While the frame has not been set, the true pose passes unchanged, to the bit.
  reading.pose = X_FW_ == Pose{} ? X_WB_ : X_FW_ * X_WB_;
  if (params_.noise_m > 0.0) {
    reading.pose.x_m += noise_.gaussian(params_.noise_m);
    reading.pose.y_m += noise_.gaussian(params_.noise_m);
  }
  if (params_.noise_yaw_rad > 0.0) {
    reading.pose.yaw_rad =
        normalize_angle(reading.pose.yaw_rad + noise_.gaussian(params_.noise_yaw_rad));
  }
  reading.twist = context.body.twist;
  reading.stalled = context.body.stalled;
}

void PoseSensor::archive(StateArchive& archive) {
  SensorOf::archive(archive);
  archive(noise_, X_WB_, X_FW_);
}

Odometry::Odometry(std::string name, const OdometryParams& params, double wheel_separation_m,
                   bool omnidirectional, RandomStream noise)
    : SensorOf(std::move(name), "odometry", params.frequency_hz),
      params_(params),
      wheel_separation_m_(wheel_separation_m),
      omnidirectional_(omnidirectional),
      noise_(std::move(noise)) {}

std::optional<std::string> Odometry::apply(const Command& command) {
  const auto* set = std::get_if<SetPoseCommand>(&command);
  if (set == nullptr) return Device::apply(command);
  const Pose X_BR = X_SB_.inverse() * X_SR_;
  X_SB_ = set->pose;
  X_SB_.yaw_rad = normalize_angle(X_SB_.yaw_rad);
  X_SR_ = X_SB_ * X_BR;
  return std::nullopt;
}

void Odometry::integrate(const StepContext& context) {
  double ds_m = context.body.travel_m;
  double dyaw_rad = context.body.turn_rad;
  double side_m = omnidirectional_ ? context.body.side_m : 0.0;
  if (params_.noise > 0.0) {
    double left_m = ds_m - 0.5 * wheel_separation_m_ * dyaw_rad;
    double right_m = ds_m + 0.5 * wheel_separation_m_ * dyaw_rad;
    left_m += noise_.gaussian(params_.noise * std::sqrt(std::abs(left_m)));
    right_m += noise_.gaussian(params_.noise * std::sqrt(std::abs(right_m)));
    ds_m = 0.5 * (left_m + right_m);
    dyaw_rad = (right_m - left_m) / wheel_separation_m_;
    if (omnidirectional_) {
      side_m += noise_.gaussian(params_.noise * std::sqrt(std::abs(side_m)));
    }
  }
  if (ds_m == 0.0 && dyaw_rad == 0.0 && side_m == 0.0) return;
  const double heading = X_SB_.yaw_rad + 0.5 * dyaw_rad;
  const double chord_m = ds_m * sinc(0.5 * dyaw_rad);
  const double side_chord_m = side_m * sinc(0.5 * dyaw_rad);
  X_SB_ = {X_SB_.x_m + chord_m * std::cos(heading) - side_chord_m * std::sin(heading),
           X_SB_.y_m + chord_m * std::sin(heading) + side_chord_m * std::cos(heading),
           normalize_angle(X_SB_.yaw_rad + dyaw_rad)};
  path_length_m_ += side_m == 0.0 ? std::abs(ds_m) : std::hypot(ds_m, side_m);
}

void Odometry::measure(const StepContext& context) {
  auto& reading = next(context);
  reading.pose = X_SB_;
  reading.twist = context.body.twist;
  if (!omnidirectional_) reading.twist.lateral_mps = 0.0;  // the wheels do not measure it
  reading.stalled = context.body.stalled;
  // For a robot at rest the increment is exactly zero.
  reading.increment = X_SR_ == X_SB_ ? Pose{} : X_SR_.inverse() * X_SB_;
  reading.path_length_m = path_length_m_;
  X_SR_ = X_SB_;
  path_length_m_ = 0.0;
}

void Odometry::archive(StateArchive& archive) {
  SensorOf::archive(archive);
  archive(noise_, X_SB_, X_SR_, path_length_m_);
}

constexpr const char* kLevels[] = {"integrated", "differential", "raw"};

constexpr Field kPoseSettings[] = {
    frequency_field<&PoseParams::frequency_hz>(),
    noise_field<&PoseParams::noise_m>("standard deviation of x and of y"),
    field<&PoseParams::noise_yaw_rad>("noise_yaw_deg", "degrees",
                                      "standard deviation of the heading")
        .within(0.0, 360.0),
};
SIM_FIELDS(PoseParams, kPoseSettings)

constexpr Field kOdometrySettings[] = {
    frequency_field<&OdometryParams::frequency_hz>(
        "readings per simulated second; the wheels are integrated in each step"),
    field<&OdometryParams::noise>(
        "noise", "m after 1 m",
        "standard deviation of a wheel's path after 1 m of it; grows with the root of the path")
        .within(0.0, 10.0),
    field<&OdometryParams::level>(
        "level", "",
        "form of MORSE's stream: `\"integrated\"`, `\"differential\"` or `\"raw\"`, see below")
        .one_of(kLevels),
};
SIM_FIELDS(OdometryParams, kOdometrySettings)

constexpr Field kPoseReading[] = {
    field<&PoseReading::pose>("", "m, rad"),
    field<&PoseReading::twist, &Twist::v_mps>("v", "m/s"),
    field<&PoseReading::twist, &Twist::omega_radps>("omega", "rad/s"),
    field<&PoseReading::twist, &Twist::lateral_mps>("lateral", "m/s"),
    field<&PoseReading::stalled>("stalled"),
    field<&PoseReading::path_length_m>("path_length", "m"),
    field<&PoseReading::increment>("increment", "m, rad"),
};
SIM_FIELDS(PoseReading, kPoseReading)

DeviceKind odometry_kind() {
  return device_kind<OdometryParams, PoseReading>(
      "odometry", {{"position2d", 1}},
      [](const DeviceConstruction& construction, const OdometryParams& params) {
        const DriveDescription& drive = construction.model.drive;
        return std::make_unique<Odometry>(construction.name(), params, drive.wheel_separation_m,
                                          drive.kind == DriveKind::kOmnidirectional,
                                          construction.noise());
      });
}

DeviceKind pose_kind() {
  return device_kind<PoseParams, PoseReading>(
      "pose", {{"localize"}, {"position2d"}},
      [](const DeviceConstruction& construction, const PoseParams& params) {
        return std::make_unique<PoseSensor>(construction.name(), params, construction.robot.pose,
                                            construction.noise());
      });
}

}  // namespace sim
