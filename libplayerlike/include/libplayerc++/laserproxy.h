// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <iosfwd>
#include <memory>

#include "libplayerc++/clientproxy.h"

namespace playerlike {
class PoseFeed;
}  // namespace playerlike

namespace PlayerCc {

/// A scanning laser rangefinder.
///
/// Frame L is the laser's frame: x forward, y left. Beams are ordered counter-clockwise: beam 0 is
/// the rightmost, and the bearing of beam i is GetMinAngle() + i * GetScanRes() from L's x axis. A
/// beam that detects nothing reads GetMaxRange(). Before the first reading there are 0 beams; the
/// settings (angles, resolution, maximum range, frequency, poses) are known from the start.
///
/// A beam whose index is not below GetCount() reads 0; after the first reading a warning on
/// standard error says so, once for each proxy.
class LaserProxy : public ClientProxy {
 public:
  /// @throws PlayerError kNoSuchDevice if the device does not exist; the text names those that do.
  LaserProxy(PlayerClient* aPc, uint32_t aIndex = 0);
  ~LaserProxy() override;

  /// Number of beams of the newest scan.
  uint32_t GetCount() const {
    uint32_t count = 0;
    return mElements.Count(count) ? count : LockedCount();
  }
  double GetMaxRange() const;           ///< maximum range [m]
  double GetScanRes() const;            ///< angle between neighbouring beams [rad]
  double GetRangeRes() const;           ///< resolution of ranges [m], see Configure()
  double GetScanningFrequency() const;  ///< scans per simulated second [Hz]
  double GetMinAngle() const;           ///< bearing of beam 0 [rad]
  double GetMaxAngle() const;           ///< bearing of the last beam [rad]
  double GetConfMinAngle() const;       ///< configured bearing of beam 0 [rad]
  double GetConfMaxAngle() const;       ///< configured bearing of the last beam [rad]
  bool IntensityOn() const;             ///< whether the scan has them: from Player servers only
  player_point_2d_t GetPoint(uint32_t aIndex) const;  ///< end point of the beam in L [m]
  /// Range of a beam [m], in [0, GetMaxRange()].
  double GetRange(uint32_t aIndex) const {
    double range = 0.0;
    return mElements.Find(aIndex, range) ? range : LockedRange(aIndex, "LaserProxy::GetRange");
  }
  /// Bearing of a beam in L [rad].
  double GetBearing(uint32_t aIndex) const {
    double bearing = 0.0;
    return mElements.Bearing(aIndex, bearing) ? bearing : LockedBearing(aIndex);
  }
  int GetIntensity(uint32_t aIndex) const;  ///< 0 to 255; 0 without IntensityOn()
  int GetID() const;                        ///< serial number; a simulated laser's is 0

  /// Selects the beams that this proxy shows from now on: every n-th beam in the window [aMinAngle,
  /// aMaxAngle]. The simulated laser keeps its geometry, which the world file defines, and other
  /// clients' proxies do not change.
  /// @param aMinAngle, aMaxAngle  window [rad]; at least one beam must lie in it.
  /// @param aScanRes  angle between shown beams [0.01 degrees]; n is its rounded ratio to the
  ///                  laser's own resolution, at least 1. 0: all beams.
  /// @param aRangeRes  ranges are rounded to multiples of this value [mm]; 0: no rounding.
  /// @param aIntensity  ignored; see IntensityOn().
  /// @param aScanningFrequency  ignored; the laser keeps its own, see GetScanningFrequency().
  /// @throws PlayerError kBadArgument for angles that are not finite, or if the window contains no
  ///         beam.
  void Configure(double aMinAngle, double aMaxAngle, uint32_t aScanRes, uint32_t aRangeRes,
                 bool aIntensity, double aScanningFrequency);
  /// @deprecated Player 2.0: same as Configure() with the current frequency.
  void Configure(double aMinAngle, double aMaxAngle, uint32_t aScanRes, uint32_t aRangeRes,
                 bool aIntensity) {
    Configure(aMinAngle, aMaxAngle, aScanRes, aRangeRes, aIntensity, GetScanningFrequency());
  }
  /// Requests the settings. They are known from the start, so nothing changes.
  void RequestConfigure();
  /// Requests GetID(). It is known from the start, so nothing changes.
  void RequestID();
  /// Requests the geometry. It is known from the start, so nothing changes.
  void RequestGeom();

  /// Mount pose: the pose of L in the robot's body frame [m, rad].
  player_pose3d_t GetPose();
  /// Pose of the robot. Of a driver laserposeinterpolator: at the time of the scan. Of other
  /// lasers: from the newest reading of a localisation device to which this client has subscribed
  /// (with a Position2dProxy). Zero if there is none.
  player_pose3d_t GetRobotPose();
  /// Size of the device's case from its settings [m]. For an S1R's Hokuyo URG-04LX it is 5 x 5 x 7
  /// cm.
  player_bbox3d_t GetSize();

  double GetMinLeft() const;   ///< shortest range of the left half [m]; GetMaxRange() if empty
  double GetMinRight() const;  ///< shortest range of the right half [m]; GetMaxRange() if empty
  double MinLeft() const;      ///< same as GetMinLeft()
  double MinRight() const;     ///< same as GetMinRight()

  /// Same as GetRange().
  double operator[](uint32_t index) const {
    double range = 0.0;
    return mElements.Find(index, range) ? range : LockedRange(index, "LaserProxy::operator[]");
  }

 protected:
  void HandleReading(const playerlike::NewReading& aNew) override;

 private:
  // The following members are guarded by the client's mutex.
  double CheckedRange(uint32_t aIndex, const char* aFun) const;
  // These lock the mutex. Cold, so that loops over beams keep their values in registers, which a
  // call would clobber.
  [[gnu::cold]] double LockedRange(uint32_t aIndex, const char* aFun) const;
  [[gnu::cold]] double LockedBearing(uint32_t aIndex) const;
  [[gnu::cold]] uint32_t LockedCount() const;
  double LeastRange(bool aLeft) const;
  void View(const playerlike::NewReading& aMeasured);

  std::size_t mCount = 0;  // number of measured beams
  std::size_t mFirst = 0;  // index of the first shown beam among the measured ones
  std::size_t mStride = 1;
  std::size_t mShown = 0;
  double mRangeRes = 0.0;                        // 0: not rounded
  std::shared_ptr<playerlike::PoseFeed> mPoses;  // of a driver laserposeinterpolator; else null
};

}  // namespace PlayerCc

namespace std {
/// Prints the settings and the scan, one beam per line: bearing, range, x, y.
std::ostream& operator<<(std::ostream& os, const PlayerCc::LaserProxy& c);
}  // namespace std
