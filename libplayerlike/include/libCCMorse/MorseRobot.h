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
/// by MorseClient::GetRobot(). What it tells of the robot does not change while the simulation
/// runs, and can be asked after the client is gone; the position goal needs the client.
class MorseRobot {
 public:
  std::string GetName() const;
  std::string GetModel() const;            ///< e.g. "s1r"
  uint32_t GetPort() const;                ///< the robot's Player port
  player_pose2d_t GetInitialPose() const;  ///< pose in the world at the start
  double GetLength() const;                ///< size of the body along x [m]
  double GetWidth() const;                 ///< size of the body along y [m]
  double GetHeight() const;                ///< [m]
  double GetWeight() const;                ///< [kg]; 0 if the server does not tell it
  double GetMaxSpeed() const;              ///< [m/s]
  double GetMaxTurnRate() const;           ///< [rad/s]
  std::vector<std::string> GetDeviceNames() const;
  bool HasDevice(const std::string& aName) const;
  /// @throws MorseError kNoSuchDevice if there is no such device; the text names the existing ones.
  MorseDeviceInfo GetDevice(const std::string& aName) const;
  /// Returns all devices, sorted by name.
  std::vector<MorseDeviceInfo> GetDevices() const;

  /// Sets the position goal: the robot's motors drive there by themselves, straight on and round
  /// nothing, and turn to the heading at the end (docs/devices/motion.md). Takes effect with the
  /// next step and returns at once; Read() lets the robot drive. Any other command for the motors
  /// replaces the goal. Copies of this value share the goal.
  /// @param aX, aY  in the world [m].
  /// @param aYaw    heading there [rad]; without it: the direction from where the robot was when a
  ///                Position2dProxy of this client was last read, else from its start.
  /// @throws MorseError kNotAvailable if the robot has no motors, kBadArgument for NaN or infinity,
  ///         kDisconnected once the client is gone.
  void SetPositionGoal(double aX, double aY, double aYaw);
  void SetPositionGoal(double aX, double aY);  ///< as above
  /// Whether this client has set a position goal and not cleared it.
  bool HasPositionGoal() const;
  /// The goal that this client set last [m, rad].
  /// @throws MorseError kNotAvailable if there is none, see HasPositionGoal().
  player_pose2d_t GetPositionGoal() const;
  /// Drops the position goal and stops the motors.
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
