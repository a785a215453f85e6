// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "libCCMorse/MorseSensor.h"
#include "libplayerc++/playerstructs.h"

namespace CCMorse {

/// What MorseInfrared and MorseSonar have in common: a few transducers, each with a place of its
/// own on the body B (the middle of the wheels' axle; x forward, y left) and a direction, its x
/// axis. One that meets nothing reads GetMaxRange(). How many there are and where they sit is
/// known from the start; before the first reading all ranges are GetMaxRange(). An index that is
/// not below GetCount() is refused with MorseError kBadArgument.
class MorseRanger : public MorseSensor {
 public:
  ~MorseRanger() override;

  uint32_t GetCount() const;                            ///< transducers
  double GetRange(uint32_t aIndex) const;               ///< [m], in [0, GetMaxRange()]
  double operator[](uint32_t aIndex) const;             ///< GetRange()
  std::vector<double> GetRanges() const;                ///< all of them
  player_pose2d_t GetMountPose(uint32_t aIndex) const;  ///< of a transducer in B [m, rad]
  player_point_2d_t GetPoint(uint32_t aIndex) const;    ///< GetRange() ahead of it, in B [m]
  double GetMaxRange() const;                           ///< [m]
  double GetFieldOfView() const;                        ///< of each, full angle [rad]; 0: a ray

  double GetLeastRange() const;    ///< of all transducers [m]
  uint32_t GetLeastIndex() const;  ///< of the transducer that has it; of several, the first

 protected:
  MorseRanger(const MorseRobot& aRobot, const std::string& aName, const char* aType,
              const char* aClass);

 private:
  double Checked(uint32_t aIndex, const char* aFunction) const;
  std::vector<player_pose2d_t> mMounts;
};

/// A ring of infrared rangers, single rays.
class MorseInfrared : public MorseRanger {
 public:
  /// @param aName  device; "": the robot's first of type "infrared".
  explicit MorseInfrared(const MorseRobot& aRobot, const std::string& aName = "");
  ~MorseInfrared() override;
};

}  // namespace CCMorse
