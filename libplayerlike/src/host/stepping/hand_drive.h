// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "playerlike/messages/messages.h"
#include "sim/simulation/simulation.h"

namespace playerlike {

/// Steering of robots by hand; it overrides their programs.
///
/// While a robot's stick is not at rest, its motors get a twist from here, after all other commands
/// of a step. Speed reaches its maximum within half a simulated second, turn rate within a quarter.
/// After the stick is at rest again the robot stands still for 0.3 simulated seconds. Then its
/// motors get the program's last command, which may be older than the steering. Not thread-safe:
/// guarded by the host's mutex.
class HandDrive {
 public:
  /// Executes a command.
  using Execute = std::function<void(DeviceId, const sim::Command&)>;
  /// Where a robot's stick stands: shares of the top speeds, in [-1, 1]. A turn rate of 1 is half
  /// of the motors' maximum, which is too fast for steering by hand.
  struct Stick {
    double ahead = 0.0;
    double left = 0.0;  ///< turns to the robot's left, also when it drives backwards
    [[nodiscard]] bool at_rest() const noexcept { return ahead == 0.0 && left == 0.0; }
  };

  /// @param execute  for the twists of the steering; empty: the simulation executes them.
  explicit HandDrive(const std::vector<RobotInfo>& robots, Execute execute = {});

  /// Whether a robot has motors. @return false if there is no such robot.
  [[nodiscard]] bool can_drive(int robot) const noexcept;
  /// Index of the next robot with motors, after the last one the first; -1: none has motors.
  [[nodiscard]] int next_drivable(int robot) const noexcept;

  /// Moves a robot's stick. @pre can_drive(robot)
  void steer(int robot, Stick stick);
  /// Whether a robot is steered by hand now. @pre The robot exists.
  [[nodiscard]] bool active(int robot) const;
  /// Returns a robot to its program at once. @pre The robot exists.
  void hand_back(int robot, sim::Simulation& simulation);

  /// Must be called for every command of a program before it is applied.
  void note_command(DeviceId device, const sim::Command& command);
  /// Must be called between the programs' commands and the step.
  void before_step(sim::Simulation& simulation);

 private:
  struct Motors {
    std::optional<DeviceId> device;  ///< none: this robot cannot be driven
    double max_speed_mps = 0.0;
    double max_turn_rate_radps = 0.0;
    Stick stick;
    std::optional<sim::Command> program_command;  ///< the program's last one; set while steering
    sim::Twist twist;                             ///< of the steering
    sim::SimTime still_ns = 0;                    ///< how long the stick has been at rest
  };
  void before_step(Motors& motors, sim::Simulation& simulation);
  void hand_back(Motors& motors, sim::Simulation& simulation);
  void execute(const Motors& motors, sim::Simulation& simulation,
               const sim::Command& command) const;

  const Execute execute_;
  std::vector<Motors> motors_;  ///< by robot
};

}  // namespace playerlike
