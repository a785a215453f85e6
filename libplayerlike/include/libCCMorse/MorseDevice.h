// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <memory>
#include <string>

#include "libCCMorse/MorseRobot.h"
#include "libplayerc++/mutex.h"

namespace CCMorse {

/// Common base of all sensors and actuators of a robot.
class MorseDevice {
 public:
  MorseDevice(const MorseDevice&) = delete;
  MorseDevice& operator=(const MorseDevice&) = delete;
  virtual ~MorseDevice();

  const MorseRobot& GetRobot() const { return mRobot; }
  std::string GetName() const;  ///< name within the robot
  std::string GetType() const;  ///< type, as in world files
  /// Returns the numeric settings by name, in SI units and radians, e.g. "frequency".
  std::map<std::string, double> GetProperties() const;

 protected:
  /// @param aName   name of the device; "" for the robot's first device of the type.
  /// @param aType   required type.
  /// @param aClass  class name for error texts; a string literal.
  /// @throws MorseError kNoSuchDevice if the robot has no such device; the text names the existing
  ///         devices of that type.
  MorseDevice(const MorseRobot& aRobot, const std::string& aName, const char* aType,
              const char* aClass);

  /// Returns "Class::function", for error texts.
  std::string Fun(const char* aFunction) const;
  /// Locks the client's data.
  /// @param aLooks  number of getter calls to count; the detection of programs that poll without
  ///                letting time advance uses the count.
  /// @throws MorseError kDisconnected if the client is gone.
  PlayerCc::mutex_t::scoped_lock Lock(const char* aFunction, int aLooks = 1) const;
  /// Returns a property, or aOtherwise if there is none of that name.
  double GetProperty(const char* aName, double aOtherwise) const;

  const std::shared_ptr<playerlike::ClientCore>& Core() const { return mRobot.mCore; }
  int RobotIndex() const { return mRobotIndex; }
  int DeviceIndex() const { return mDeviceIndex; }

 private:
  MorseRobot mRobot;
  const char* mClass;
  int mRobotIndex;
  int mDeviceIndex;
};

}  // namespace CCMorse
