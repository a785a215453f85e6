// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/devices/imu.h"

#include <cmath>
#include <utility>

#include "sim/world/description.h"

namespace sim {

std::array<double, 3> field_in_body_ut(const ImuParams& params, double yaw_rad) {
  const double north_rad = params.north_rad - yaw_rad;
  return {params.field_horizontal_ut * std::cos(north_rad),
          params.field_horizontal_ut * std::sin(north_rad), -params.field_down_ut};
}

Imu::Imu(std::string name, const ImuParams& params, double yaw_rad, RandomStream noise)
    : Sensor(std::move(name), "imu", params.frequency_hz),
      params_(params),
      noise_(std::move(noise)),
      yaw_rad_(yaw_rad) {
  for (double& bias : bias_mps2_) bias = noise_.gaussian(params_.bias_mps2);
  for (double& bias : bias_radps_) bias = noise_.gaussian(params_.bias_radps);
}

std::optional<std::string> Imu::apply(const Command& command) {
  const auto* set = std::get_if<SetPoseCommand>(&command);
  if (set == nullptr) return Device::apply(command);
  // The next reading adds what it has turned since the last one, also before now.
  yaw_rad_ = normalize_angle(set->pose.yaw_rad - turned_rad_);
  return std::nullopt;
}

void Imu::integrate(const StepContext& context) {
  const double dt_s = to_seconds(context.world.simulation.step_ns);
  const Twist& now = context.body.twist;
  // The mean of both ends' speeds goes with the step's turn.
  const double lateral = 0.5 * (before_.lateral_mps + now.lateral_mps);
  const double forward = 0.5 * (before_.v_mps + now.v_mps);
  gained_x_mps_ += now.v_mps - before_.v_mps - context.body.turn_rad * lateral;
  gained_y_mps_ += now.lateral_mps - before_.lateral_mps + context.body.turn_rad * forward;
  turned_rad_ += context.body.turn_rad;
  time_s_ += dt_s;
  before_ = now;
}

void Imu::placed(const Pose&) { before_ = {}; }

void Imu::measure(const StepContext& context) {
  stamp(context, reading_);
  reading_.acceleration_mps2 = {gained_x_mps_ / time_s_, gained_y_mps_ / time_s_, kGravity_mps2};
  reading_.rate_radps = {0.0, 0.0, turned_rad_ / time_s_};
  reading_.field_ut = field_in_body_ut(params_, context.body.X_WB.yaw_rad);
  for (std::size_t i = 0; i < 3; ++i) {
    reading_.acceleration_mps2[i] += bias_mps2_[i] + noise_.gaussian(params_.noise_mps2);
    reading_.rate_radps[i] += bias_radps_[i] + noise_.gaussian(params_.noise_radps);
    reading_.field_ut[i] += noise_.gaussian(params_.noise_ut);
  }
  yaw_rad_ = normalize_angle(yaw_rad_ + reading_.rate_radps[2] * time_s_);
  reading_.yaw_rad = yaw_rad_;
  gained_x_mps_ = 0.0;
  gained_y_mps_ = 0.0;
  turned_rad_ = 0.0;
  time_s_ = 0.0;
}

void Imu::hash(StateHash& hash) const {
  Sensor::hash(hash);
  hash.add(noise_.draws());
  for (const double x : {gained_x_mps_, gained_y_mps_, turned_rad_, time_s_, yaw_rad_}) {
    hash.add(x);
  }
}

}  // namespace sim
