// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "libCCMorse/MorseError.h"
#include "libplayerc++/playerstructs.h"

namespace playerlike {
class ClientCore;
}

namespace CCMorse {

/// Description of a robot's device.
struct MorseDeviceInfo {
  std::string name;                          ///< name within the robot, e.g. "laser"
  std::string type;                          ///< e.g. "laser", "pose", "motion"
  std::map<std::string, double> properties;  ///< numeric settings, in SI units and radians
};

/// A robot of the world, as a client sees it. A small value: copies stand for the same robot. Made
/// by MorseClient::GetRobot(). The properties of the robot are constant during the simulation and
/// remain available after the client is destroyed. The position goal requires the client.
class MorseRobot {
 public:
  std::string GetName() const;
  std::string GetModel() const;            ///< e.g. "s1r"
  uint32_t GetPort() const;                ///< the robot's Player port
  player_pose2d_t GetInitialPose() const;  ///< pose in the world at the start
  double GetLength() const;                ///< size of the body along x [m]
  double GetWidth() const;                 ///< size of the body along y [m]
  double GetHeight() const;                ///< [m]
  double GetWeight() const;                ///< [kg]; 0 if the server does not send it
  double GetMaxSpeed() const;              ///< [m/s]
  double GetMaxTurnRate() const;           ///< [rad/s]
  std::vector<std::string> GetDeviceNames() const;
  bool HasDevice(const std::string& aName) const;
  /// @throws MorseError kNoSuchDevice if there is no such device; the text names the existing ones.
  MorseDeviceInfo GetDevice(const std::string& aName) const;
  /// Returns all devices, sorted by name.
  std::vector<MorseDeviceInfo> GetDevices() const;

  /// Sets the position goal. The robot's motors drive straight to the goal without avoiding
  /// obstacles, and then turn to the heading (docs/devices/motion.md). The call returns at once,
  /// and the goal takes effect in the next step. The robot drives during Read(). Any other command
  /// for the motors replaces the goal. Copies of this value share the goal.
  /// @param aX, aY  position in the world frame [m].
  /// @param aYaw  heading at the goal [rad]. Without it, the heading is the direction to the goal
  ///     from the robot's position at the last reading of a Position2dProxy of this client, or from
  ///     the start position if there was no reading.
  /// @throws MorseError kNotAvailable if the robot has no motors, kBadArgument for NaN or infinity,
  ///         kDisconnected after the client was destroyed.
  void SetPositionGoal(double aX, double aY, double aYaw);
  void SetPositionGoal(double aX, double aY);  ///< as above
  /// Returns whether this client has set a position goal and has not cleared it.
  bool HasPositionGoal() const;
  /// Returns the last goal that this client set [m, rad].
  /// @throws MorseError kNotAvailable if there is none, see HasPositionGoal().
  player_pose2d_t GetPositionGoal() const;
  /// Clears the position goal and stops the motors.
  /// @throws MorseError as SetPositionGoal().
  void ClearPositionGoal();

 private:
  friend class MorseClient;
  friend class MorseDevice;
  friend class MorseProperties;
  friend class MorsePen;
  MorseRobot(std::shared_ptr<playerlike::ClientCore> aCore, std::size_t aIndex);
  std::shared_ptr<playerlike::ClientCore> mCore;
  std::size_t mIndex;
};

}  // namespace CCMorse
