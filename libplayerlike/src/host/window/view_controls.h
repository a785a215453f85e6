// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "host/stepping/hand_drive.h"
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

/// The direction keys of the window: they steer one robot, which the user chooses. Not thread-safe:
/// guarded by the host's mutex.
class KeyDrive {
 public:
  /// Chooses the first robot with motors. @param hand  must outlive this object.
  explicit KeyDrive(HandDrive& hand) : hand_(hand), chosen_(hand.next_drivable(-1)) {}

  /// Index of the chosen robot; -1: none.
  [[nodiscard]] int chosen() const noexcept { return chosen_; }
  /// Chooses the next robot with motors; returns the previous one to its program.
  void choose_next(sim::Simulation& simulation);

  /// A direction's key was pressed or released. @pre action is one of the four directions.
  void hold(ViewAction action, bool pressed);
  void release_all();
  /// Whether the chosen robot is steered by hand now.
  [[nodiscard]] bool active() const { return chosen_ >= 0 && hand_.active(chosen_); }

 private:
  HandDrive& hand_;
  int chosen_;
  std::array<bool, 4> held_{};  ///< forward, backward, left, right
};

/// Twice or half of a time factor, within 1/16 .. 64. @return `factor` itself if the result would
/// be outside.
[[nodiscard]] double next_time_factor(double factor, bool faster) noexcept;

/// A factor for the status line: "x 2", "x 0.25".
[[nodiscard]] std::string factor_text(double factor);

}  // namespace playerlike
