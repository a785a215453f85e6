// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "libCCMorse/MorseSensor.h"
#include "libplayerc++/playerstructs.h"

namespace CCMorse {

/// Common base of MorseInfrared and MorseSonar: several transducers, each with its own mount pose
/// in the body frame B (origin at the centre of the wheel axle; x forward, y left). A transducer
/// looks along the x axis of its mount pose and reads GetMaxRange() if it detects nothing.
///
/// The number of transducers and their mount poses are known from the start. Before the first
/// reading all ranges are GetMaxRange(). An index of GetCount() or more throws MorseError
/// kBadArgument.
class MorseRanger : public MorseSensor {
 public:
  ~MorseRanger() override;

  uint32_t GetCount() const;                            ///< number of transducers
  double GetRange(uint32_t aIndex) const;               ///< [m], in [0, GetMaxRange()]
  double operator[](uint32_t aIndex) const;             ///< GetRange()
  std::vector<double> GetRanges() const;                ///< all ranges [m]
  player_pose2d_t GetMountPose(uint32_t aIndex) const;  ///< pose of a transducer in B [m, rad]
  player_point_2d_t GetPoint(uint32_t aIndex) const;    ///< measured point, in B [m]
  double GetMaxRange() const;                           ///< [m]
  double GetFieldOfView() const;                        ///< full angle of a cone [rad]; 0: a ray

  double GetLeastRange() const;    ///< shortest range of all transducers [m]
  uint32_t GetLeastIndex() const;  ///< first transducer with the shortest range

 protected:
  MorseRanger(const MorseRobot& aRobot, const std::string& aName, const char* aType,
              const char* aClass);

 private:
  double Checked(uint32_t aIndex, const char* aFunction) const;
  std::vector<player_pose2d_t> mMounts;
};

/// A ring of infrared rangers. Each of them measures along a single ray.
class MorseInfrared : public MorseRanger {
 public:
  /// @param aName  name of the device; "" for the robot's first device of type "infrared".
  explicit MorseInfrared(const MorseRobot& aRobot, const std::string& aName = "");
  ~MorseInfrared() override;
};

}  // namespace CCMorse
