// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "libplayerinterface/player_constants.h"
#include "session/player_values/fields.h"
#include "session/range_settings.h"
#include "sim/devices/actarray.h"

/// @file
/// Player's interface actarray.
namespace playerlike {

/// A joint's setting, e.g. "min" of joint 2 is the property min_2.
[[nodiscard]] inline double joint_setting(const DeviceSettings& settings, const char* name,
                                          std::size_t joint) {
  return setting_of(settings, std::string(name) + '_' + std::to_string(joint));
}

inline constexpr Code<sim::JointState> kJointStates[] = {
    {sim::JointState::kIdle, PLAYER_ACTARRAY_ACTSTATE_IDLE},
    {sim::JointState::kMoving, PLAYER_ACTARRAY_ACTSTATE_MOVING},
    {sim::JointState::kBraked, PLAYER_ACTARRAY_ACTSTATE_BRAKED},
    {sim::JointState::kStalled, PLAYER_ACTARRAY_ACTSTATE_STALLED}};

[[nodiscard]] inline std::uint8_t joint_state_code(sim::JointState state) noexcept {
  return code_of(kJointStates, state);
}
/// The state of a code PLAYER_ACTARRAY_ACTSTATE_...; kIdle if there is none.
[[nodiscard]] inline sim::JointState joint_state(int code) noexcept {
  return value_of(kJointStates, code).value_or(sim::JointState::kIdle);
}
/// The unit vector along a joint's axis. @param axis  the setting, a sim::JointAxis.
struct AxisVector {
  double x, y, z;
};
[[nodiscard]] inline AxisVector axis_vector(double axis) {
  switch (static_cast<sim::JointAxis>(static_cast<int>(axis))) {
    case sim::JointAxis::kX:
      return {1.0, 0.0, 0.0};
    case sim::JointAxis::kY:
      return {0.0, 1.0, 0.0};
    case sim::JointAxis::kMinusX:
      return {-1.0, 0.0, 0.0};
    case sim::JointAxis::kMinusY:
      return {0.0, -1.0, 0.0};
    case sim::JointAxis::kMinusZ:
      return {0.0, 0.0, -1.0};
    case sim::JointAxis::kZ:
      break;
  }
  return {0.0, 0.0, 1.0};
}

/// Messages lack the setting of the speed.
template <typename Actuator, MaybeConst<sim::JointReading> Joint, typename Same>
void same_values(Actuator& actuator, Joint& joint, Same same) {
  same(actuator.position, joint.position);
  same(actuator.speed, joint.speed);
  same(actuator.acceleration, joint.acceleration);
  same(actuator.current, joint.current_a);
  same.converted(actuator.state, joint.state, joint_state_code, joint_state);
}

template <typename Data, MaybeConst<sim::ActArrayReading> Arm, typename Same>
void same_values(Data& data, Arm& arm, Same same) {
  same(data.actuators, arm.joints);
  same(data.motor_state, arm.is_powered);
}

/// @param now  the newest reading of the joint; null before the first one.
template <typename Geometry>
[[nodiscard]] Geometry actuator_geometry(const DeviceSettings& settings, std::size_t joint,
                                         const sim::JointReading* now) {
  const auto value = [&](const char* name) { return joint_setting(settings, name, joint); };
  const auto single = [&](const char* name) { return static_cast<float>(value(name)); };
  const bool is_linear = value("type") == static_cast<double>(sim::JointType::kLinear);
  const AxisVector axis = axis_vector(value("axis"));
  Geometry geometry = {};
  geometry.type = is_linear ? PLAYER_ACTARRAY_TYPE_LINEAR : PLAYER_ACTARRAY_TYPE_ROTARY;
  geometry.length = single("length");
  geometry.orientation = {value("roll"), value("pitch"), value("yaw")};
  geometry.axis = {axis.x, axis.y, axis.z};
  geometry.min = single("min");
  geometry.centre = single("centre");
  geometry.max = single("max");
  geometry.home = single("home");
  geometry.config_speed = now != nullptr ? static_cast<float>(now->speed_setting) : single("speed");
  geometry.hasbrakes = value("brake") != 0.0 ? 1 : 0;
  return geometry;
}

}  // namespace playerlike
