// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <iosfwd>

#include "libplayerc++/clientproxy.h"

namespace PlayerCc {

/// A scanning laser rangefinder.
///
/// Frame L: the laser, x forward, y left. Beams are ordered counter-clockwise: index 0 is the
/// rightmost, and beam i looks at GetMinAngle() + i * GetScanRes() from L's x axis. A beam that
/// meets nothing reads GetMaxRange(). Before the first reading there are 0 beams, while the
/// settings (angles, resolution, greatest range, frequency, poses) are known from the start.
///
/// A beam whose index is not below GetCount() reads 0; after the first reading a warning on
/// standard error says so, once for each proxy.
class LaserProxy : public ClientProxy {
 public:
  /// @throws PlayerError kNoSuchDevice if there is no such device; the text names those there are.
  LaserProxy(PlayerClient* aPc, uint32_t aIndex = 0);
  ~LaserProxy() override;

  uint32_t GetCount() const;            ///< beams of the newest scan
  double GetMaxRange() const;           ///< greatest range [m]
  double GetScanRes() const;            ///< angle between neighbouring beams [rad]
  double GetRangeRes() const;           ///< resolution of ranges [m], see Configure()
  double GetScanningFrequency() const;  ///< scans a simulated second [Hz]
  double GetMinAngle() const;           ///< angle of beam 0 [rad]
  double GetMaxAngle() const;           ///< angle of the last beam [rad]
  double GetConfMinAngle() const;       ///< of beam 0, as configured [rad]
  double GetConfMaxAngle() const;       ///< of the last beam, as configured [rad]
  bool IntensityOn() const;             ///< false: the simulated laser measures ranges only
  player_point_2d_t GetPoint(uint32_t aIndex) const;  ///< where the beam ends, in L [m]
  /// [m], in [0, GetMaxRange()]
  double GetRange(uint32_t aIndex) const {
    double range = 0.0;
    return mElements.Find(aIndex, range) ? range : LockedRange(aIndex, "LaserProxy::GetRange");
  }
  double GetBearing(uint32_t aIndex) const;  ///< angle of the beam [rad]
  int GetIntensity(uint32_t aIndex) const;   ///< 0, see IntensityOn()
  int GetID() const;                         ///< serial number; a simulated laser's is 0

  /// Chooses what this proxy shows of each scan, from now on. The simulated laser itself keeps its
  /// geometry (the world file decides), and so do other clients' proxies: of its beams, those in
  /// [aMinAngle, aMaxAngle] are shown, and of these every n-th.
  /// @param aMinAngle, aMaxAngle  window [rad]; at least one beam must lie in it.
  /// @param aScanRes  angle between beams [0.01 degrees]: n is this over the laser's own, rounded,
  ///                  at least 1; 0: all beams.
  /// @param aRangeRes  ranges are rounded to multiples of it [mm]; 0: as they are.
  /// @param aIntensity  ignored, see IntensityOn().
  /// @param aScanningFrequency  ignored: the laser keeps its own, see GetScanningFrequency().
  /// @throws PlayerError kBadArgument for angles that are no numbers or hold no beam.
  void Configure(double aMinAngle, double aMaxAngle, uint32_t aScanRes, uint32_t aRangeRes,
                 bool aIntensity, double aScanningFrequency);
  /// @deprecated Of Player 2.0, without a frequency: the same as Configure() with the present one.
  void Configure(double aMinAngle, double aMaxAngle, uint32_t aScanRes, uint32_t aRangeRes,
                 bool aIntensity) {
    Configure(aMinAngle, aMaxAngle, aScanRes, aRangeRes, aIntensity, GetScanningFrequency());
  }
  /// Asks for the settings. They are known from the start, so nothing changes.
  void RequestConfigure();
  /// Asks for GetID(); known from the start.
  void RequestID();
  /// Asks for the geometry; known from the start.
  void RequestGeom();

  /// Where the laser is mounted: pose of L in the robot's body.
  player_pose3d_t GetPose();
  /// Where the robot is, as the newest reading of its localisation that this client has subscribed
  /// to (by a Position2dProxy) says; zero if there is none.
  player_pose3d_t GetRobotPose();
  /// Size of the device's case, as its settings say: an S1R's Hokuyo URG-04LX is a box of 5 x 5 x 7
  /// cm.
  player_bbox3d_t GetSize();

  double GetMinLeft()
      const;  ///< least range of the second half of the beams [m]; without beams GetMaxRange()
  double GetMinRight() const;  ///< the same of the first half
  double MinLeft() const;      ///< GetMinLeft()
  double MinRight() const;     ///< GetMinRight()

  /// GetRange().
  double operator[](uint32_t index) const {
    double range = 0.0;
    return mElements.Find(index, range) ? range : LockedRange(index, "LaserProxy::operator[]");
  }

 protected:
  void HandleReading() override;

 private:
  // All of these are guarded by the client's mutex.
  double CheckedRange(uint32_t aIndex, const char* aFun) const;
  // Takes it. Cold, so that sums of beams stay in registers, which a call would take from them.
  [[gnu::cold]] double LockedRange(uint32_t aIndex, const char* aFun) const;
  double LeastRange(bool aLeft) const;
  void View();

  std::size_t mCount = 0;  // of measured beams
  std::size_t mFirst = 0;  // of the shown beams among the measured ones
  std::size_t mStride = 1;
  std::size_t mShown = 0;
  double mRangeRes = 0.0;  // 0: not rounded
};

}  // namespace PlayerCc

namespace std {
/// Prints the settings and the scan, a beam a line: bearing, range, x, y.
std::ostream& operator<<(std::ostream& os, const PlayerCc::LaserProxy& c);
}  // namespace std
