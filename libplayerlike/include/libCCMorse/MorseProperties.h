// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "libCCMorse/ImagePoint.h"
#include "libCCMorse/MorseRobot.h"

namespace CCMorse {

/// A robot's configuration, as the world file gives it.
class MorseProperties {
 public:
  explicit MorseProperties(const MorseRobot& aRobot);

  const MorseRobot& GetRobot() const { return mRobot; }
  std::string GetModel() const;            ///< e.g. "s1r"
  uint32_t GetPort() const;                ///< its Player port
  ImageColour_t GetColour() const;         ///< in pictures
  player_pose2d_t GetInitialPose() const;  ///< in the world, at the start
  player_bbox3d_t GetSize() const;         ///< of the body

  /// Index of the robot's device on port 4000 for an interface ("laser", "position2d"): what the
  /// world's proxies table says, else the robot's number.
  /// @return -1 if the robot has no device with that interface.
  int GetProxyIndex(const std::string& aInterface) const;
  /// The same for all interfaces that the robot has.
  std::map<std::string, int> GetProxyIndexes() const;

  /// Types of the drivers that the world gives this robot, e.g. "snd".
  std::vector<std::string> GetDriverNames() const;
  /// Settings of the first driver of that type.
  /// @throws MorseError kNoSuchDevice if there is none; the text names those there are.
  std::map<std::string, std::string> GetDriverSettings(const std::string& aDriver) const;

 private:
  MorseRobot mRobot;
};

}  // namespace CCMorse
