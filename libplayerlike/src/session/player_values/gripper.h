// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

#include "libplayerinterface/player_constants.h"
#include "session/player_values/fields.h"
#include "session/range_settings.h"
#include "sim/devices/device.h"
#include "sim/devices/gripper.h"

/// @file
/// Player's interface gripper.
namespace playerlike {

/// Bits of broken beams, as Player's drivers for Pioneers set them.
inline constexpr std::uint32_t kOuterBeam = 0x04;
inline constexpr std::uint32_t kInnerBeam = 0x08;

inline constexpr Code<sim::GripperState> kGripperStates[] = {
    {sim::GripperState::kOpen, PLAYER_GRIPPER_STATE_OPEN},
    {sim::GripperState::kClosed, PLAYER_GRIPPER_STATE_CLOSED},
    {sim::GripperState::kMoving, PLAYER_GRIPPER_STATE_MOVING},
    {sim::GripperState::kError, PLAYER_GRIPPER_STATE_ERROR}};
inline constexpr Code<sim::GripCommand::Action> kGripActions[] = {
    {sim::GripCommand::Action::kOpen, PLAYER_GRIPPER_CMD_OPEN},
    {sim::GripCommand::Action::kClose, PLAYER_GRIPPER_CMD_CLOSE},
    {sim::GripCommand::Action::kStop, PLAYER_GRIPPER_CMD_STOP},
    {sim::GripCommand::Action::kStore, PLAYER_GRIPPER_CMD_STORE},
    {sim::GripCommand::Action::kRetrieve, PLAYER_GRIPPER_CMD_RETRIEVE}};

[[nodiscard]] inline std::uint8_t gripper_state_code(sim::GripperState state) noexcept {
  return code_of(kGripperStates, state);
}
/// The state of a code PLAYER_GRIPPER_STATE_...; kError if there is none.
[[nodiscard]] inline sim::GripperState gripper_state(int code) noexcept {
  return value_of(kGripperStates, code).value_or(sim::GripperState::kError);
}
/// The action of a command PLAYER_GRIPPER_CMD_...; nullopt if there is none.
[[nodiscard]] inline std::optional<sim::GripCommand::Action> grip_action(int command) noexcept {
  return value_of(kGripActions, command);
}
[[nodiscard]] inline std::uint8_t grip_command(sim::GripCommand::Action action) noexcept {
  return code_of(kGripActions, action);
}
[[nodiscard]] inline std::uint32_t broken_beams(const sim::GripperReading& reading) {
  return (reading.outer_beam ? kOuterBeam : 0) | (reading.inner_beam ? kInnerBeam : 0);
}

template <typename Data>
[[nodiscard]] sim::GripperReading gripper_reading(const Data& data) {
  sim::GripperReading reading;
  reading.state = gripper_state(data.state);
  reading.outer_beam = (data.beams & kOuterBeam) != 0;
  reading.inner_beam = (data.beams & kInnerBeam) != 0;
  reading.stored = data.stored;
  return reading;
}

template <typename Geometry>
[[nodiscard]] Geometry gripper_geometry(const DeviceSettings& settings) {
  const double length = setting_of(settings, "length");
  const double opening = setting_of(settings, "opening");
  const double height = setting_of(settings, "height");
  const Mounting mounting = mounting_of(settings);
  const double capacity = setting_of(settings, "capacity");
  Geometry geometry = {};
  geometry.pose = {mounting.x_m, mounting.y_m, 0.0, 0.0, 0.0, mounting.yaw_rad};
  geometry.outer_size = {opening + 2.0 * setting_of(settings, "thickness"), length, height};
  geometry.inner_size = {opening, length, height};
  geometry.num_beams = 2;
  geometry.capacity =
      static_cast<std::uint8_t>(capacity > 0.0 ? (capacity < 255.0 ? capacity : 255.0) : 0.0);
  return geometry;
}

}  // namespace playerlike
