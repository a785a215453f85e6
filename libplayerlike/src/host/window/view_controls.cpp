// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "host/window/view_controls.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "sim/core/number_text.h"
#include "sim/devices/motion.h"

namespace playerlike {
namespace {

// X11 keysyms (X.Org, keysymdef.h) of keys without a character.
constexpr std::uint32_t kTab = 0xff09;
constexpr std::uint32_t kEscape = 0xff1b;
constexpr std::uint32_t kLeftArrow = 0xff51;
constexpr std::uint32_t kUpArrow = 0xff52;
constexpr std::uint32_t kRightArrow = 0xff53;
constexpr std::uint32_t kDownArrow = 0xff54;
constexpr std::uint32_t kKeypadPlus = 0xffab;
constexpr std::uint32_t kKeypadMinus = 0xffad;
constexpr std::uint32_t kF1 = 0xffbe;

constexpr double kFullSpeedAfter_s = 0.5;
constexpr double kFullTurnAfter_s = 0.25;
// The motors' maximum turn rate is too fast for steering by hand.
constexpr double kTurnShare = 0.5;
constexpr sim::SimTime kStillFor_ns = 3 * sim::kNanosecondsPerSecond / 10;

constexpr double kLeastFactor = 1.0 / 16.0;
constexpr double kGreatestFactor = 64.0;

// Moves from `now` towards `wanted` by at most `by`. A stop is immediate, and a reversal starts at
// zero.
double approach(double now, double wanted, double by) {
  if (wanted == 0.0) return 0.0;
  if (now * wanted < 0.0) now = 0.0;
  return wanted > now ? std::min(wanted, now + by) : std::max(wanted, now - by);
}

}  // namespace

std::optional<ViewAction> view_action(std::uint32_t keysym, bool control) noexcept {
  if (control) {
    if (keysym == kUpArrow) return ViewAction::kPreviousMode;
    if (keysym == kDownArrow) return ViewAction::kNextMode;
    return std::nullopt;
  }
  switch (keysym) {
    case 'w':
    case 'W':
    case kUpArrow:
      return ViewAction::kForward;
    case 'x':
    case 'X':
    case kDownArrow:
      return ViewAction::kBackward;
    case 'a':
    case 'A':
    case kLeftArrow:
      return ViewAction::kLeft;
    case 'd':
    case 'D':
    case kRightArrow:
      return ViewAction::kRight;
    case kTab:
      return ViewAction::kNextRobot;
    case ' ':
      return ViewAction::kPause;
    case '+':
    case '=':  // '+' without Shift on keyboards with both on one key
    case kKeypadPlus:
      return ViewAction::kFaster;
    case '-':
    case kKeypadMinus:
      return ViewAction::kSlower;
    case 's':
    case 'S':
      return ViewAction::kSave;
    case 'h':
    case 'H':
    case kF1:
      return ViewAction::kHelp;
    case 'q':
    case 'Q':
    case kEscape:
      return ViewAction::kEnd;
    default:
      return std::nullopt;
  }
}

// Built on each call: the window's thread calls it until the process ends, when static objects may
// be destroyed.
std::vector<std::string> view_help() {
  return {"W A D X, arrows  drive  Tab  next robot  Ctrl+Up, Ctrl+Down  view mode  S  save picture",
          "Space  pause  +, -  speed  H  hide help  Q, Esc  end the run"};
}

double next_time_factor(double factor, bool faster) noexcept {
  const double next = faster ? 2.0 * factor : 0.5 * factor;
  return faster ? (next <= kGreatestFactor ? next : factor)
                : (next >= kLeastFactor ? next : factor);
}

std::string factor_text(double factor) { return "x " + sim::rounded_text(factor, 4); }

HandDrive::HandDrive(const std::vector<RobotInfo>& robots, Execute execute)
    : execute_(std::move(execute)) {
  for (const RobotInfo& robot : robots) {
    Motors motors{std::nullopt, robot.max_speed_mps, robot.max_turn_rate_radps};
    const auto motion = std::find_if(robot.devices.begin(), robot.devices.end(),
                                     [](const DeviceInfo& d) { return d.type == "motion"; });
    if (motion != robot.devices.end()) motors.device = motion->id;
    if (chosen_ < 0 && motors.device) chosen_ = static_cast<int>(motors_.size());
    motors_.push_back(motors);
  }
}

void HandDrive::choose_next(sim::Simulation& simulation) {
  if (chosen_ < 0) return;
  hand_back(simulation);
  release_all();
  const auto count = static_cast<int>(motors_.size());
  do {
    chosen_ = (chosen_ + 1) % count;
  } while (!motors_[static_cast<std::size_t>(chosen_)].device);
}

void HandDrive::hold(ViewAction action, bool pressed) noexcept {
  held_.at(static_cast<std::size_t>(action)) = pressed;
}

bool HandDrive::any_held() const noexcept {
  return std::any_of(held_.begin(), held_.end(), [](bool held) { return held; });
}

void HandDrive::note_command(DeviceId device, const sim::Command& command) {
  if (!program_command_ || !(device == motors())) return;
  if (!std::holds_alternative<sim::MotorEnableCommand>(command)) program_command_ = command;
}

void HandDrive::before_step(sim::Simulation& simulation) {
  if (chosen_ < 0 || (!any_held() && !active())) return;
  const DeviceId device = motors();
  if (!active()) {
    const auto& motion =
        dynamic_cast<const sim::Motion&>(simulation.device(device.robot, device.device));
    program_command_ = motion.present_command();
    twist_ = {};
  }
  const sim::SimTime step_ns = simulation.world().simulation.step_ns;
  still_ns_ = any_held() ? 0 : still_ns_ + step_ns;
  if (still_ns_ > kStillFor_ns) {
    hand_back(simulation);
    return;
  }
  const Motors& limits = motors_[static_cast<std::size_t>(chosen_)];
  const double dt_s = sim::to_seconds(step_ns);
  const auto direction = [this](ViewAction plus, ViewAction minus) {
    return (held_.at(static_cast<std::size_t>(plus)) ? 1.0 : 0.0) -
           (held_.at(static_cast<std::size_t>(minus)) ? 1.0 : 0.0);
  };
  const double speed = limits.max_speed_mps;
  const double turn = kTurnShare * limits.max_turn_rate_radps;
  const double ahead = direction(ViewAction::kForward, ViewAction::kBackward);
  // The left key turns the robot to its left, also when it drives backwards.
  const double left = direction(ViewAction::kLeft, ViewAction::kRight);
  twist_.v_mps = approach(twist_.v_mps, ahead * speed, speed * dt_s / kFullSpeedAfter_s);
  twist_.omega_radps = approach(twist_.omega_radps, left * turn, turn * dt_s / kFullTurnAfter_s);
  execute(simulation, sim::TwistCommand{twist_});
}

void HandDrive::execute(sim::Simulation& simulation, const sim::Command& command) const {
  if (execute_) return execute_(motors(), command);
  static_cast<void>(simulation.apply(motors(), command));
}

void HandDrive::hand_back(sim::Simulation& simulation) {
  if (!program_command_) return;
  execute(simulation, *program_command_);
  program_command_.reset();
  still_ns_ = 0;
}

}  // namespace playerlike
