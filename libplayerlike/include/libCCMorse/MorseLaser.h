// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "libCCMorse/MorseSensor.h"
#include "libplayerc++/playerstructs.h"

namespace CCMorse {

/// A scanning laser rangefinder.
///
/// Frame L: the laser, x forward, y left. Beam 0 is the rightmost; beam i looks at GetMinAngle() +
/// i * GetResolution(). A beam that meets nothing reads GetMaxRange(). Before the first reading
/// there are 0 beams; the settings are known from the start. An index that is not below GetCount()
/// is refused with MorseError kBadArgument.
class MorseLaser : public MorseSensor {
 public:
  /// @param aName  device; "": the robot's first of type "laser".
  explicit MorseLaser(const MorseRobot& aRobot, const std::string& aName = "");
  ~MorseLaser() override;

  uint32_t GetCount() const;  ///< beams of the newest scan
  /// [m], in [0, GetMaxRange()]
  double GetRange(uint32_t aIndex) const {
    double range = 0.0;
    return mElements.Find(aIndex, range) ? range : LockedRange(aIndex);
  }
  double operator[](uint32_t aIndex) const { return GetRange(aIndex); }
  double GetBearing(uint32_t aIndex) const;           ///< angle of the beam [rad]
  player_point_2d_t GetPoint(uint32_t aIndex) const;  ///< where the beam ends, in L [m]
  std::vector<double> GetRanges() const;              ///< all of them

  double GetMinAngle() const;    ///< of beam 0 [rad]
  double GetMaxAngle() const;    ///< of the last beam [rad]
  double GetResolution() const;  ///< angle between neighbouring beams [rad]
  double GetMaxRange() const;    ///< [m]

  /// Least range of the scan [m]; GetMaxRange() before the first. Looks through all beams.
  double GetLeastRange() const;
  /// Angle of the beam that has it; of several, the rightmost [rad]; 0 before the first scan.
  double GetLeastAngle() const;

  /// Where the laser is mounted: pose of L in the robot's body.
  player_pose2d_t GetMountPose() const;

 private:
  [[gnu::cold]] double LockedRange(uint32_t aIndex) const;
  void Check(uint32_t aIndex, uint32_t aCount, const char* aFunction) const;
};

}  // namespace CCMorse
