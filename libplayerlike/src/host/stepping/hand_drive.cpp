// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "host/stepping/hand_drive.h"

#include <algorithm>
#include <utility>
#include <variant>

#include "sim/devices/motion.h"

namespace playerlike {
namespace {

constexpr double kFullSpeedAfter_s = 0.5;
constexpr double kFullTurnAfter_s = 0.25;
constexpr double kTurnShare = 0.5;
constexpr sim::SimTime kStillFor_ns = 3 * sim::kNanosecondsPerSecond / 10;

// Moves from `now` towards `wanted` by at most `by`. Slowing down is immediate, and a reversal
// starts at zero.
double approach(double now, double wanted, double by) {
  if (now * wanted <= 0.0) now = 0.0;
  return wanted > 0.0 ? std::min(wanted, now + by) : std::max(wanted, now - by);
}

}  // namespace

HandDrive::HandDrive(const std::vector<RobotInfo>& robots, Execute execute)
    : execute_(std::move(execute)) {
  for (const RobotInfo& robot : robots) {
    Motors& motors = motors_.emplace_back();
    motors.max_speed_mps = robot.max_speed_mps;
    motors.max_turn_rate_radps = robot.max_turn_rate_radps;
    const auto motion = std::ranges::find(robot.devices, std::string("motion"), &DeviceInfo::type);
    if (motion != robot.devices.end()) motors.device = motion->id;
  }
}

bool HandDrive::can_drive(int robot) const noexcept {
  return robot >= 0 && static_cast<std::size_t>(robot) < motors_.size() &&
         motors_[static_cast<std::size_t>(robot)].device;
}

int HandDrive::next_drivable(int robot) const noexcept {
  const auto count = static_cast<int>(motors_.size());
  for (int i = 1; i <= count; ++i) {
    const int next = (robot + i) % count;
    if (can_drive(next)) return next;
  }
  return -1;
}

void HandDrive::steer(int robot, Stick stick) {
  motors_.at(static_cast<std::size_t>(robot)).stick = stick;
}

bool HandDrive::active(int robot) const {
  return motors_.at(static_cast<std::size_t>(robot)).program_command.has_value();
}

void HandDrive::hand_back(int robot, sim::Simulation& simulation) {
  hand_back(motors_.at(static_cast<std::size_t>(robot)), simulation);
}

void HandDrive::note_command(DeviceId device, const sim::Command& command) {
  Motors& motors = motors_.at(static_cast<std::size_t>(device.robot));
  if (!motors.program_command || !(device == *motors.device)) return;
  if (!std::holds_alternative<sim::MotorEnableCommand>(command)) motors.program_command = command;
}

void HandDrive::before_step(sim::Simulation& simulation) {
  for (Motors& motors : motors_) {
    if (motors.program_command || !motors.stick.at_rest()) before_step(motors, simulation);
  }
}

void HandDrive::before_step(Motors& motors, sim::Simulation& simulation) {
  if (!motors.program_command) {
    const DeviceId device = *motors.device;
    const auto& motion =
        dynamic_cast<const sim::Motion&>(simulation.device(device.robot, device.device));
    motors.program_command = motion.present_command();
    motors.twist = {};
  }
  const sim::SimTime step_ns = simulation.world().simulation.step_ns;
  motors.still_ns = motors.stick.at_rest() ? motors.still_ns + step_ns : 0;
  if (motors.still_ns > kStillFor_ns) return hand_back(motors, simulation);
  const double dt_s = sim::to_seconds(step_ns);
  const double speed = motors.max_speed_mps;
  const double turn = kTurnShare * motors.max_turn_rate_radps;
  sim::Twist& twist = motors.twist;
  twist.v_mps = approach(twist.v_mps, motors.stick.ahead * speed, speed * dt_s / kFullSpeedAfter_s);
  twist.omega_radps =
      approach(twist.omega_radps, motors.stick.left * turn, turn * dt_s / kFullTurnAfter_s);
  execute(motors, simulation, sim::TwistCommand{twist});
}

void HandDrive::execute(const Motors& motors, sim::Simulation& simulation,
                        const sim::Command& command) const {
  if (execute_) return execute_(*motors.device, command);
  static_cast<void>(simulation.apply(*motors.device, command));
}

void HandDrive::hand_back(Motors& motors, sim::Simulation& simulation) {
  if (!motors.program_command) return;
  execute(motors, simulation, *motors.program_command);
  motors.program_command.reset();
  motors.still_ns = 0;
}

}  // namespace playerlike
