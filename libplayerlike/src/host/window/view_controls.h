// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "playerlike/messages/messages.h"
#include "sim/simulation/simulation.h"

namespace playerlike {

/// The action of a key in the live window.
enum class ViewAction {
  kForward,       ///< W, Up: drive while held
  kBackward,      ///< X, Down
  kLeft,          ///< A, Left
  kRight,         ///< D, Right
  kNextMode,      ///< Ctrl+Down: the next view mode
  kPreviousMode,  ///< Ctrl+Up
  kNextRobot,     ///< Tab
  kPause,         ///< Space
  kFaster,        ///< +
  kSlower,        ///< -
  kSave,          ///< S
  kHelp,          ///< H, F1
  kEnd,           ///< Q, Esc
};

/// The action of a key; nullopt if it has none.
/// @param keysym   X11 keysym, e.g. 0x77 for w.
/// @param control  whether a Ctrl key is held.
[[nodiscard]] std::optional<ViewAction> view_action(std::uint32_t keysym, bool control) noexcept;

/// Help text for the window: keys and their actions alternate, separated by two blanks.
[[nodiscard]] std::vector<std::string> view_help();

/// Steering of one robot by hand; it overrides the robot's program.
///
/// While a direction is held, the robot's motors get a twist from here, after all other commands of
/// a step. Speed reaches its maximum within half a simulated second, turn rate within a quarter.
/// After the last key is released the robot stands still for 0.3 simulated seconds. Then its motors
/// get the program's last command, which may be older than the steering. Not thread-safe: guarded
/// by the host's mutex.
class HandDrive {
 public:
  /// Executes a command.
  using Execute = std::function<void(DeviceId, const sim::Command&)>;

  /// @param execute  for the twists of the steering; empty: the simulation executes them.
  explicit HandDrive(const std::vector<RobotInfo>& robots, Execute execute = {});

  /// Index of the chosen robot; -1: none.
  [[nodiscard]] int chosen() const noexcept { return chosen_; }
  /// Chooses the next robot with motors; returns the previous one to its program.
  void choose_next(sim::Simulation& simulation);

  /// A direction's key was pressed or released. @pre action is one of the four directions.
  void hold(ViewAction action, bool pressed) noexcept;
  void release_all() noexcept { held_.fill(false); }
  /// Whether the chosen robot is steered by hand now.
  [[nodiscard]] bool active() const noexcept { return program_command_.has_value(); }

  /// Must be called for every command of a program before it is applied.
  void note_command(DeviceId device, const sim::Command& command);
  /// Must be called between the programs' commands and the step.
  void before_step(sim::Simulation& simulation);

 private:
  [[nodiscard]] bool any_held() const noexcept;
  void hand_back(sim::Simulation& simulation);
  void execute(sim::Simulation& simulation, const sim::Command& command) const;
  /// Motors of the chosen robot. @pre chosen_ >= 0
  [[nodiscard]] DeviceId motors() const {
    return *motors_[static_cast<std::size_t>(chosen_)].device;
  }

  struct Motors {
    std::optional<DeviceId> device;  ///< none: this robot cannot be driven
    double max_speed_mps = 0.0;
    double max_turn_rate_radps = 0.0;
  };
  const Execute execute_;
  std::vector<Motors> motors_;  ///< by robot
  int chosen_ = -1;
  std::array<bool, 4> held_{};                   ///< forward, backward, left, right
  std::optional<sim::Command> program_command_;  ///< the program's last command; set while steering
  sim::Twist twist_;                             ///< of the steering
  sim::SimTime still_ns_ = 0;                    ///< how long no key has been held
};

/// Twice or half of a time factor, within 1/16 .. 64. @return `factor` itself if the result would
/// be outside.
[[nodiscard]] double next_time_factor(double factor, bool faster) noexcept;

/// A factor for the status line: "x 2", "x 0.25".
[[nodiscard]] std::string factor_text(double factor);

}  // namespace playerlike
