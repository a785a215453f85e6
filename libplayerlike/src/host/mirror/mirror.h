// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "host/stepping/client.h"
#include "playerlike/host/report.h"
#include "playerlike/host/run_settings.h"
#include "sim/simulation/simulation.h"

namespace playerlike {

/// The motors of a real robot.
struct RealMotors {
  std::string robot;   ///< name in the world
  std::string server;  ///< as sim::RealRobotDescription::server
  int port = 0;        ///< Player port of the real robot
  DeviceId device{-1, -1};
};

/// The robots of a world that mirror real ones (sim::RobotDescription::real).
///
/// Commands for their devices go to the device of the real robot that has the same interface and
/// index, and its readings replace those of the simulated device. Devices that the real robot lacks
/// stay simulated. The simulated robot stands where the real one says that it is.
///
/// Each real robot has a RealLink with threads of its own. This class has none: the host calls it
/// before and after each step. Not thread-safe: guarded by the host's mutex.
class Mirror {
 public:
  /// A reading of a simulated robot's device.
  using Given = std::pair<DeviceId, sim::SharedReading>;
  /// A connection that was lost in the last step.
  struct Loss {
    int robot = -1;
    std::string text;  ///< for the log and for programs
    bool ends_run = false;
    bool is_passing = false;  ///< the connection will be made again
  };

  /// Connects to the real robots of a world.
  /// @param simulation, robots  must outlive this object.
  /// @return null if the world has none.
  /// @throws sim::ConfigError run/real-robot with each robot that cannot be reached or has no
  ///         device that tells its pose.
  [[nodiscard]] static std::unique_ptr<Mirror> open(sim::Simulation& simulation,
                                                    const std::vector<RobotInfo>& robots,
                                                    const OpenRealRobot& open, const Warn& warn);
  Mirror(const Mirror&) = delete;
  Mirror& operator=(const Mirror&) = delete;
  /// Stops the real robots.
  ~Mirror();

  /// How a command was executed: nothing on success, otherwise the reason why not.
  using Executed = std::optional<std::string>;

  /// Sends a command to the real robot if the device mirrors one of its devices, and executes it by
  /// the ghost, if there is one. Refuses a command to move the robot by a device that the real
  /// robot lacks. @return nullopt: the simulation must execute it.
  std::optional<Executed> take_command(DeviceId device, const sim::Command& command);
  /// Takes the readings that have arrived and puts the robots where they are.
  void before_step();
  /// Moves the ghosts. @return connections that were lost since the last step.
  [[nodiscard]] std::vector<Loss> after_step();
  /// Stops the motors of the real robots, e.g. while the run is paused.
  void halt();
  /// Stops the motors of one robot, if it mirrors a real one.
  void halt(int robot);
  /// Stops the real robots for good and closes the connections.
  void stop() noexcept;

  /// Whether readings of a device come from the real robot, also after the loss of its connection.
  [[nodiscard]] bool replaces(DeviceId device) const;
  /// The readings that arrived before the last step, oldest first.
  [[nodiscard]] const std::vector<Given>& readings() const noexcept { return given_; }
  /// The newest reading of a device; null before the first. @pre replaces(device)
  [[nodiscard]] sim::SharedReading newest(DeviceId device) const;
  /// Whether the connection to the real robot of a robot is lost at present.
  [[nodiscard]] bool has_lost(int robot) const;
  /// Why there are no further readings of a device: the text of its Loss. Empty: there are, or the
  /// connection will be made again.
  [[nodiscard]] const std::string& loss_of(DeviceId device) const;

  /// The motors of all real robots.
  [[nodiscard]] std::vector<RealMotors> motors() const;
  /// Completes a scene: scans of the real robots, ghosts, and lost connections.
  void show(sim::SceneSnapshot& scene) const;
  /// The window has begun to show the present scene, or has it on the screen now.
  void note_scene_taken();
  void note_scene_shown();
  /// The velocity that a real robot reports; nullopt: unknown, or the robot mirrors none.
  [[nodiscard]] std::optional<sim::Twist> twist_of(std::size_t robot) const;
  /// Names of the further columns of trajectory.csv, with a comma in front of each.
  [[nodiscard]] static const char* column_names() noexcept;
  /// Their values for a robot; empty fields where there are none.
  [[nodiscard]] std::string columns(std::size_t robot) const;
  /// The report's "mirror".
  [[nodiscard]] std::vector<MirrorReport> report() const;

 private:
  class Robot;

  Mirror();
  [[nodiscard]] Robot* robot_at(int robot) const;

  std::vector<std::unique_ptr<Robot>> robots_;  ///< by index in the world; null: none
  std::vector<Given> given_;
};

}  // namespace playerlike
