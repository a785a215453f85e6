// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/devices/motion.h"

#include <algorithm>

namespace sim {
namespace {

// One step of a ramp from `from` to `to`; max_rate 0 jumps.
double ramp(double from, double to, double max_rate, double dt_s) {
  if (max_rate <= 0.0) return to;
  return from + std::clamp(to - from, -max_rate * dt_s, max_rate * dt_s);
}

}  // namespace

Motion::Motion(std::string name, const MotionParams& params)
    : Actuator(std::move(name), "motion"), params_(params), enabled_(params.enabled_at_start) {}

std::optional<std::string> Motion::apply(const Command& command) {
  if (const auto* twist = std::get_if<TwistCommand>(&command)) {
    if (!enabled_) return std::nullopt;
    commanded_ = {std::clamp(twist->twist.v_mps, -params_.max_speed_mps, params_.max_speed_mps),
                  std::clamp(twist->twist.omega_radps, -params_.max_turn_rate_radps,
                             params_.max_turn_rate_radps),
                  0.0};
    return std::nullopt;
  }
  if (const auto* motors = std::get_if<MotorEnableCommand>(&command)) {
    enabled_ = motors->enabled;
    if (!enabled_) {
      commanded_ = {};
      target_ = {};
    }
    return std::nullopt;
  }
  return Device::apply(command);
}

std::optional<std::string> Motion::carry_out(const Command& command, RobotControl& robot) {
  if (enabled_ && std::holds_alternative<TwistCommand>(command)) {
    static_cast<void>(robot.take_motors(*this));
  }
  return apply(command);
}

void Motion::placed(const Pose&) {
  commanded_ = {};
  target_ = {};
}

void Motion::deactivated(RobotControl&) { commanded_ = {}; }

Twist Motion::next_target(double dt_s) {
  target_.v_mps = ramp(target_.v_mps, commanded_.v_mps, params_.max_acceleration_mps2, dt_s);
  target_.omega_radps =
      ramp(target_.omega_radps, commanded_.omega_radps, params_.max_turn_acceleration_radps2, dt_s);
  return target_;
}

void Motion::hash(StateHash& hash) const {
  hash.add(enabled_);
  for (const double x :
       {commanded_.v_mps, commanded_.omega_radps, target_.v_mps, target_.omega_radps}) {
    hash.add(x);
  }
}

}  // namespace sim
