// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <memory>
#include <string>

#include "libCCMorse/MorseRobot.h"
#include "libplayerc++/mutex.h"

namespace CCMorse {

/// A part of a robot: what all sensors and actuators have in common.
class MorseDevice {
 public:
  MorseDevice(const MorseDevice&) = delete;
  MorseDevice& operator=(const MorseDevice&) = delete;
  virtual ~MorseDevice();

  const MorseRobot& GetRobot() const { return mRobot; }
  std::string GetName() const;  ///< in its robot
  std::string GetType() const;  ///< as world files name it
  /// Numeric settings by name, SI units and radians, e.g. "frequency".
  std::map<std::string, double> GetProperties() const;

 protected:
  /// @param aName   device of that name; "": the robot's first device of the type.
  /// @param aType   type that it must have.
  /// @param aClass  class by whose name errors are thrown; a literal.
  /// @throws MorseError kNoSuchDevice if the robot has none; the text names those it has.
  MorseDevice(const MorseRobot& aRobot, const std::string& aName, const char* aType,
              const char* aClass);

  /// "Class::function", for errors.
  std::string Fun(const char* aFunction) const;
  /// Locks the client's data. @throws MorseError kDisconnected if the client is gone.
  PlayerCc::mutex_t::scoped_lock Lock(const char* aFunction, int aLooks = 1) const;
  /// A property, or another value if there is none of that name.
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
