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
/// Frame L is the laser's frame: x forward, y left. Beam 0 is the rightmost; the bearing of beam i
/// is GetMinAngle() + i * GetResolution(). A beam that detects nothing reads GetMaxRange().
///
/// The settings are known from the start. Before the first reading there are 0 beams. An index of
/// GetCount() or more throws MorseError kBadArgument.
class MorseLaser : public MorseSensor {
 public:
  /// @param aName  name of the device; "" for the robot's first device of type "laser".
  explicit MorseLaser(const MorseRobot& aRobot, const std::string& aName = "");
  ~MorseLaser() override;

  uint32_t GetCount() const;  ///< number of beams of the newest scan
  /// Returns the range of a beam [m], in [0, GetMaxRange()].
  double GetRange(uint32_t aIndex) const {
    double range = 0.0;
    return mElements.Find(aIndex, range) ? range : LockedRange(aIndex);
  }
  double operator[](uint32_t aIndex) const { return GetRange(aIndex); }
  double GetBearing(uint32_t aIndex) const;           ///< bearing of the beam in L [rad]
  player_point_2d_t GetPoint(uint32_t aIndex) const;  ///< end point of the beam in L [m]
  std::vector<double> GetRanges() const;              ///< all ranges [m]

  double GetMinAngle() const;    ///< bearing of beam 0 [rad]
  double GetMaxAngle() const;    ///< bearing of the last beam [rad]
  double GetResolution() const;  ///< angle between neighbouring beams [rad]
  double GetMaxRange() const;    ///< [m]

  /// Shortest range of the scan [m]; GetMaxRange() before the first scan. Each call searches all
  /// beams.
  double GetLeastRange() const;
  /// Bearing of the beam with the shortest range [rad]; of several such beams, the rightmost. 0
  /// before the first scan.
  double GetLeastAngle() const;

  /// Mount pose: the pose of L in the body frame B [m, rad].
  player_pose2d_t GetMountPose() const;

 private:
  [[gnu::cold]] double LockedRange(uint32_t aIndex) const;
  void Check(uint32_t aIndex, uint32_t aCount, const char* aFunction) const;
};

}  // namespace CCMorse
