// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "libCCMorse/ImagePoint.h"
#include "libCCMorse/MorseRobot.h"

namespace CCMorse {

/// A robot's configuration from the world file.
class MorseProperties {
 public:
  explicit MorseProperties(const MorseRobot& aRobot);

  const MorseRobot& GetRobot() const { return mRobot; }
  std::string GetModel() const;            ///< e.g. "s1r"
  uint32_t GetPort() const;                ///< the robot's Player port
  ImageColour_t GetColour() const;         ///< colour in pictures
  player_pose2d_t GetInitialPose() const;  ///< pose in the world at the start
  player_bbox3d_t GetSize() const;         ///< size of the body [m]

  /// Returns the index of the robot's device on port 4000 for an interface ("laser", "position2d").
  /// The index comes from the world's proxies table; by default it is the robot's number.
  /// @return the index; -1 if the robot has no device with that interface.
  int GetProxyIndex(const std::string& aInterface) const;
  /// Returns GetProxyIndex() for all interfaces of the robot.
  std::map<std::string, int> GetProxyIndexes() const;

  /// Returns the types of the robot's drivers in the world file, e.g. "snd".
  std::vector<std::string> GetDriverNames() const;
  /// Returns the settings of the first driver of this type.
  /// @throws MorseError kNoSuchDevice if there is no such driver; the text names the existing ones.
  std::map<std::string, std::string> GetDriverSettings(const std::string& aDriver) const;

 private:
  MorseRobot mRobot;
};

}  // namespace CCMorse
