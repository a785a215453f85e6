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
/// by MorseClient::GetRobot(). What it tells does not change while the simulation runs, and can be
/// asked after the client is gone.
class MorseRobot {
 public:
  std::string GetName() const;
  std::string GetModel() const;            ///< e.g. "s1r"
  uint32_t GetPort() const;                ///< the robot's Player port
  player_pose2d_t GetInitialPose() const;  ///< pose in the world at the start
  double GetLength() const;                ///< size of the body along x [m]
  double GetWidth() const;                 ///< size of the body along y [m]
  double GetHeight() const;                ///< [m]
  double GetMaxSpeed() const;              ///< [m/s]
  double GetMaxTurnRate() const;           ///< [rad/s]
  std::vector<std::string> GetDeviceNames() const;
  bool HasDevice(const std::string& aName) const;
  /// @throws MorseError kNoSuchDevice if there is no such device; the text names the existing ones.
  MorseDeviceInfo GetDevice(const std::string& aName) const;
  /// Returns all devices, sorted by name.
  std::vector<MorseDeviceInfo> GetDevices() const;

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
