// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "playerlike/messages/messages.h"
#include "sim/simulation/simulation.h"

namespace playerlike {

/// What a key of the live window asks for.
enum class ViewAction {
  kForward,       ///< W, Up: drive while it is held
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

/// Meaning of a key; nullopt if it has none.
/// @param keysym   X11 keysym, e.g. 0x77 for w.
/// @param control  whether a Ctrl key is held.
[[nodiscard]] std::optional<ViewAction> view_action(std::uint32_t keysym, bool control) noexcept;

/// Lines that tell the keys, for the window: keys and what they do in turn, two blanks apart.
[[nodiscard]] std::vector<std::string> view_help();

/// Steering of one robot by hand, against what its program says.
///
/// While a direction is held, the robot's motors get a twist of ours, last in every step. Speed
/// grows to its full value within half a simulated second and turn rate within a quarter. After the
/// last key is released the robot is held still for 0.3 simulated seconds; then its motors get back
/// what the program told them last, in the meantime or before.
/// Not thread-safe: guarded by the host's lock.
class HandDrive {
 public:
  explicit HandDrive(const std::vector<RobotInfo>& robots);

  /// Index of the chosen robot; -1 if there is none.
  [[nodiscard]] int chosen() const noexcept { return chosen_; }
  /// Chooses the next robot that has motors; the one steered so far goes back to its program.
  void choose_next(sim::Simulation& simulation);

  /// A direction's key went down or up. @pre action is one of the four directions.
  void hold(ViewAction action, bool pressed) noexcept;
  void release_all() noexcept { held_.fill(false); }
  /// Whether the chosen robot is steered by hand now.
  [[nodiscard]] bool active() const noexcept { return program_command_.has_value(); }

  /// To be told of every command of a program before it is applied.
  void note_command(DeviceId device, const sim::Command& command);
  /// To be called between the programs' commands and the step.
  void before_step(sim::Simulation& simulation);

 private:
  [[nodiscard]] bool any_held() const noexcept;
  void hand_back(sim::Simulation& simulation);
  /// Motors of the chosen robot. @pre chosen_ >= 0
  [[nodiscard]] DeviceId motors() const {
    return *motors_[static_cast<std::size_t>(chosen_)].device;
  }

  struct Motors {
    std::optional<DeviceId> device;  ///< none: this robot cannot be driven
    double max_speed_mps = 0.0;
    double max_turn_rate_radps = 0.0;
  };
  std::vector<Motors> motors_;  ///< by robot
  int chosen_ = -1;
  std::array<bool, 4> held_{};                   ///< forward, backward, left, right
  std::optional<sim::Command> program_command_;  ///< what the program wants; set while we steer
  sim::Twist twist_;                             ///< ours
  sim::SimTime still_ns_ = 0;                    ///< how long no key has been held
};

/// The next faster or slower time factor, twice or half the present one, within 1/16 .. 64.
/// @return `factor` itself if the next one were beyond.
[[nodiscard]] double next_time_factor(double factor, bool faster) noexcept;

/// A factor for the status line: "x 2", "x 0.25".
[[nodiscard]] std::string factor_text(double factor);

}  // namespace playerlike
