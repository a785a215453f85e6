// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <iosfwd>
#include <vector>

#include "libplayerc++/clientproxy.h"

namespace PlayerCc {

/// Any device that measures ranges: a laser, an array of sonars or a ring of infrared rangers.
///
/// A laser is one element with many ranges. Their bearings start at GetMinAngle() and increase
/// counter-clockwise in steps of GetAngularRes(). In an array each transducer is an element with
/// one range, and the angles are those of a transducer's cone. A beam or transducer that detects
/// nothing reads GetMaxRange(). Before the first reading there are 0 ranges; settings and poses are
/// known from the start.
///
/// Indexes: by default a robot's lasers come first, then its sonars, then its infrared rangers. The
/// world's `interfaces` can define another order.
///
/// A range, point or element whose index is not below its count reads 0; after the first reading a
/// warning on standard error says so, once for each proxy.
class RangerProxy : public ClientProxy {
 public:
  /// @throws PlayerError kNoSuchDevice if the device does not exist; the text names those that do.
  RangerProxy(PlayerClient* aPc, uint32_t aIndex = 0);
  ~RangerProxy() override;

  uint32_t GetElementCount() const;       ///< 1 for a laser, otherwise the number of transducers
  player_pose3d_t GetDevicePose() const;  ///< in the robot's body frame; zero for an array
  /// Size of the device [m]. A laser has the size of a Hokuyo URG-04LX, an array that of the robot.
  player_bbox3d_t GetDeviceSize() const;
  player_pose3d_t GetElementPose(uint32_t aIndex) const;  ///< relative to GetDevicePose()
  player_bbox3d_t GetElementSize(uint32_t aIndex) const;  ///< size of a laser; 0 for transducers

  uint32_t GetRangeCount() const;  ///< number of ranges in the newest reading
  /// [m]
  double GetRange(uint32_t aIndex) const {
    double range = 0.0;
    return mElements.Find(aIndex, range) ? range : LockedRange(aIndex);
  }
  double operator[](uint32_t aIndex) const { return GetRange(aIndex); }
  uint32_t GetPointCount() const;  ///< same as GetRangeCount()
  /// End point of a range, relative to GetDevicePose() [m]. Its z is the height of the element
  /// above that pose.
  player_point_3d_t GetPoint(uint32_t aIndex) const;
  uint32_t GetIntensityCount() const;          ///< 0 but for those of Player servers
  double GetIntensity(uint32_t aIndex) const;  ///< 0 past GetIntensityCount()

  void SetPower(bool aEnable);          ///< no effect: simulated rangers are always on
  void SetIntensityData(bool aEnable);  ///< no effect, see GetIntensityCount()
  /// Requests sizes and poses. They are known from the start, so nothing changes.
  void RequestGeom();

  /// Selects the ranges that this proxy shows from now on. The simulated device keeps its settings,
  /// which the world file defines, and other clients' proxies do not change.
  /// @param aMinAngle, aMaxAngle  window of shown beams of a laser [rad]; at least one beam must
  ///                              lie in it. Arrays ignore it.
  /// @param aAngularRes  angle between shown beams of a laser [rad]: every n-th beam is shown,
  ///                     where n is the rounded ratio to the laser's own resolution, at least 1. 0:
  ///                     all beams.
  /// @param aMinRange    shorter ranges are shown as this value [m]; 0: no minimum.
  /// @param aMaxRange    longer ranges are shown as this value [m]; 0, or a value above the
  ///                     device's maximum range, selects that maximum.
  /// @param aRangeRes    ranges are rounded to multiples of this value [m]; 0: no rounding.
  /// @param aFrequency   ignored; the device keeps its own, see GetFrequency().
  /// @throws PlayerError kBadArgument for numbers that are not finite, for negative ranges, or if
  ///                     the window contains no beam.
  void Configure(double aMinAngle, double aMaxAngle, double aAngularRes, double aMinRange,
                 double aMaxRange, double aRangeRes, double aFrequency);
  /// Configure() of Player 2.x, without aMinRange.
  /// @deprecated Use the overload with seven parameters.
  void Configure(double aMinAngle, double aMaxAngle, double aAngularRes, double aMaxRange,
                 double aRangeRes, double aFrequency);
  /// Requests the settings. They are known from the start, so nothing changes.
  void RequestConfigure();

  double GetMinAngle() const;    ///< bearing of the first shown beam, or right edge of a cone [rad]
  double GetMaxAngle() const;    ///< bearing of the last shown beam, or left edge of a cone [rad]
  double GetAngularRes() const;  ///< angle between shown beams, or full angle of a cone [rad]
  double GetMinRange() const;    ///< [m], see Configure()
  double GetMaxRange() const;    ///< [m], see Configure()
  double GetRangeRes() const;    ///< [m], see Configure(); 0.001 by default
  double GetFrequency() const;   ///< readings a simulated second [Hz]

  /// Same as GetElementCount().
  /// @deprecated Player 2.x's name of GetElementCount().
  uint32_t GetSensorCount() const { return GetElementCount(); }
  /// Same as GetElementPose().
  /// @deprecated Player 2.x's name of GetElementPose().
  player_pose3d_t GetSensorPose(uint32_t aIndex) const { return GetElementPose(aIndex); }
  /// Same as GetElementSize().
  /// @deprecated Player 2.x's name of GetElementSize().
  player_bbox3d_t GetSensorSize(uint32_t aIndex) const { return GetElementSize(aIndex); }

 protected:
  void HandleReading(const playerlike::NewReading& aNew) override;

 private:
  // The following members are guarded by the client's mutex.
  [[gnu::cold]] double LockedRange(uint32_t aIndex) const;  // locks the mutex
  void View(const playerlike::NewReading& aMeasured);

  bool mIsLaser = false;
  std::size_t mCount = 0;  // number of measured ranges
  std::size_t mFirst = 0;  // index of the first shown range among the measured ones
  std::size_t mStride = 1;
  std::size_t mShown = 0;
  double mMinRange = 0.0;
  double mMaxRange = 0.0;
  double mRangeRes = 0.0;  // 0: not rounded
  bool mLimits = false;    // whether Configure() has limited or rounded the ranges
  std::vector<player_pose3d_t> mPoses;
};

}  // namespace PlayerCc

namespace std {
/// Prints the settings, then the ranges, one per line: x and y of the end point, range.
std::ostream& operator<<(std::ostream& os, const PlayerCc::RangerProxy& c);
}  // namespace std
