// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "session/player_values.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "sim/core/utf8.h"

namespace playerlike {
namespace {

using GripAction = sim::GripCommand::Action;

// A value and its code in Player's interface.
template <typename Value>
struct Code {
  Value value;
  std::uint8_t code;
};

constexpr Code<sim::GripperState> kGripperStates[] = {
    {sim::GripperState::kOpen, PLAYER_GRIPPER_STATE_OPEN},
    {sim::GripperState::kClosed, PLAYER_GRIPPER_STATE_CLOSED},
    {sim::GripperState::kMoving, PLAYER_GRIPPER_STATE_MOVING},
    {sim::GripperState::kError, PLAYER_GRIPPER_STATE_ERROR}};
constexpr Code<GripAction> kGripActions[] = {{GripAction::kOpen, PLAYER_GRIPPER_CMD_OPEN},
                                             {GripAction::kClose, PLAYER_GRIPPER_CMD_CLOSE},
                                             {GripAction::kStop, PLAYER_GRIPPER_CMD_STOP},
                                             {GripAction::kStore, PLAYER_GRIPPER_CMD_STORE},
                                             {GripAction::kRetrieve, PLAYER_GRIPPER_CMD_RETRIEVE}};
constexpr Code<sim::JointState> kJointStates[] = {
    {sim::JointState::kIdle, PLAYER_ACTARRAY_ACTSTATE_IDLE},
    {sim::JointState::kMoving, PLAYER_ACTARRAY_ACTSTATE_MOVING},
    {sim::JointState::kBraked, PLAYER_ACTARRAY_ACTSTATE_BRAKED},
    {sim::JointState::kStalled, PLAYER_ACTARRAY_ACTSTATE_STALLED}};

// The tables contain all values.
template <typename Value, std::size_t kCount>
std::uint8_t code_of(const Code<Value> (&table)[kCount], Value value) noexcept {
  return std::ranges::find(table, value, &Code<Value>::value)->code;
}

template <typename Value, std::size_t kCount>
std::optional<Value> value_of(const Code<Value> (&table)[kCount], int code) noexcept {
  const auto* row = std::ranges::find(table, code, &Code<Value>::code);
  return row != std::end(table) ? std::optional(row->value) : std::nullopt;
}

}  // namespace

std::optional<std::string> text_property(const RobotInfo& robot, const DeviceInfo& device,
                                         std::string_view name) {
  if (name == "name") return device.name;
  if (name == "type") return device.type;
  if (name == "robot") return robot.name;
  return std::nullopt;
}

std::uint8_t gripper_state_code(sim::GripperState state) noexcept {
  return code_of(kGripperStates, state);
}
sim::GripperState gripper_state(int code) noexcept {
  return value_of(kGripperStates, code).value_or(sim::GripperState::kError);
}

std::optional<GripAction> grip_action(int command) noexcept {
  return value_of(kGripActions, command);
}
std::uint8_t grip_command(GripAction action) noexcept { return code_of(kGripActions, action); }

double joint_setting(const DeviceSettings& settings, const char* name, std::size_t joint) {
  return setting_of(settings, std::string(name) + '_' + std::to_string(joint));
}

std::uint8_t joint_state_code(sim::JointState state) noexcept {
  return code_of(kJointStates, state);
}
sim::JointState joint_state(int code) noexcept {
  return value_of(kJointStates, code).value_or(sim::JointState::kIdle);
}

AxisVector axis_vector(double axis) {
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

std::vector<std::int8_t> map_cells(const sim::OccupancyMap& map) {
  const auto cell = [](float occupancy) -> std::int8_t {
    if (occupancy > 0.5F) return kMapDataRange;
    return occupancy < 0.5F ? static_cast<std::int8_t>(-kMapDataRange) : std::int8_t{0};
  };
  std::vector<std::int8_t> cells(map.cells.size());
  // The first row is the top row here, and the bottom row in Player.
  for (int row = 0; row < map.height; ++row) {
    const auto from = map.cells.begin() + static_cast<std::ptrdiff_t>(row) * map.width;
    const std::ptrdiff_t y = map.height - 1 - row;
    std::transform(from, from + map.width, cells.begin() + y * map.width, cell);
  }
  return cells;
}

std::string sayable(std::string_view text) {
  std::string said;
  while (!text.empty()) {
    const std::size_t length = sim::utf8_length(text);
    const auto first = static_cast<unsigned char>(text.front());
    const bool printable = length > 1 || (length == 1 && first >= 0x20 && first != 0x7f);
    const bool space = first == '\n' || first == '\t' || first == '\r';
    const std::string_view next = printable ? text.substr(0, length) : space ? " " : "?";
    if (said.size() + next.size() > sim::kMaxSpeech) break;
    said += next;
    text.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return said;
}

ParticleMoments moments_of(const std::vector<LocalizationParticle>& particles) {
  double weight = 0.0;
  sim::Vec2 position = sim::Vec2::Zero();
  sim::Vec2 direction = sim::Vec2::Zero();
  double squares = 0.0;
  for (const LocalizationParticle& particle : particles) {
    weight += particle.weight;
    position += particle.weight * particle.pose.position();
    squares += particle.weight * particle.pose.position().squaredNorm();
    direction += particle.weight *
                 sim::Vec2(std::cos(particle.pose.yaw_rad), std::sin(particle.pose.yaw_rad));
  }
  if (!(weight > 0.0)) return {};
  position /= weight;
  return {{position.x(), position.y(), std::atan2(direction.y(), direction.x())},
          std::max(0.0, 0.5 * (squares / weight - position.squaredNorm()))};
}

}  // namespace playerlike
