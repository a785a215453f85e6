// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <iosfwd>
#include <vector>

#include "libplayerc++/clientproxy.h"

namespace PlayerCc {

/// Any device that measures ranges: a laser, an array of sonars or a ring of infrared rangers.
///
/// A laser is one element with many ranges, counter-clockwise from GetMinAngle() on,
/// GetAngularRes() apart. In an array each transducer is an element with one range, and the angles
/// are those of a transducer's cone. A range that meets nothing reads GetMaxRange(). Before the
/// first reading there are 0 ranges, while the settings and places are known from the start.
///
/// Which of a robot's rangers has which index: lasers first, then sonars, then infrared ones,
/// unless the world's `interfaces` say otherwise.
///
/// A range, point or element whose index is not below its count reads 0; after the first reading a
/// warning on standard error says so, once for each proxy.
class RangerProxy : public ClientProxy {
 public:
  /// @throws PlayerError kNoSuchDevice if there is no such device; the text names those there are.
  RangerProxy(PlayerClient* aPc, uint32_t aIndex = 0);
  ~RangerProxy() override;

  uint32_t GetElementCount() const;       ///< 1 for a laser, else the transducers
  player_pose3d_t GetDevicePose() const;  ///< in the robot's body; of an array: the body's own
  /// Size of the device: a laser's is that of a Hokuyo URG-04LX, an array's that of the robot [m].
  player_bbox3d_t GetDeviceSize() const;
  player_pose3d_t GetElementPose(uint32_t aIndex) const;  ///< seen from GetDevicePose()
  player_bbox3d_t GetElementSize(uint32_t aIndex) const;  ///< a laser's own; transducers are points

  uint32_t GetRangeCount() const;  ///< ranges of the newest reading
  /// [m]
  double GetRange(uint32_t aIndex) const {
    double range = 0.0;
    return mElements.Find(aIndex, range) ? range : LockedRange(aIndex);
  }
  double operator[](uint32_t aIndex) const { return GetRange(aIndex); }
  uint32_t GetPointCount() const;  ///< as many as there are ranges
  /// Where a range ends, seen from GetDevicePose() [m]; z is the height of the element over it.
  player_point_3d_t GetPoint(uint32_t aIndex) const;
  uint32_t GetIntensityCount() const;          ///< 0: the simulated rangers measure ranges only
  double GetIntensity(uint32_t aIndex) const;  ///< 0, see GetIntensityCount()

  void SetPower(bool aEnable);          ///< without effect: simulated rangers are always on
  void SetIntensityData(bool aEnable);  ///< without effect, see GetIntensityCount()
  /// Asks for sizes and places; known from the start.
  void RequestGeom();

  /// Chooses what this proxy shows of each reading, from now on. The simulated device keeps its
  /// settings (the world file decides), and so do other clients' proxies.
  /// @param aMinAngle, aMaxAngle  of a laser: only beams in this window are shown, of which there
  ///                              must be one [rad]; passed over by arrays.
  /// @param aAngularRes  of a laser: of these beams every n-th, n being this over the laser's own
  ///                     resolution, rounded, at least 1 [rad]; 0: all.
  /// @param aMinRange    nearer ranges are shown as this one [m]; 0: none.
  /// @param aMaxRange    farther ranges are shown as this one [m]; 0, or more than the device's
  ///                     own: that.
  /// @param aRangeRes    ranges are rounded to multiples of it [m]; 0: as they are.
  /// @param aFrequency   ignored: the device keeps its own, see GetFrequency().
  /// @throws PlayerError kBadArgument for numbers that are not finite, negative ranges, or angles
  ///                     that hold no beam.
  void Configure(double aMinAngle, double aMaxAngle, double aAngularRes, double aMinRange,
                 double aMaxRange, double aRangeRes, double aFrequency);
  /// As above, as Player 2.x has it, without aMinRange.
  /// @deprecated use the one with seven numbers.
  void Configure(double aMinAngle, double aMaxAngle, double aAngularRes, double aMaxRange,
                 double aRangeRes, double aFrequency);
  /// Asks for the settings. They are known from the start, so nothing changes.
  void RequestConfigure();

  double GetMinAngle() const;    ///< of the first shown beam, or half a cone to the right [rad]
  double GetMaxAngle() const;    ///< of the last shown beam, or half a cone to the left [rad]
  double GetAngularRes() const;  ///< between shown beams, or a cone's full angle [rad]
  double GetMinRange() const;    ///< [m], see Configure()
  double GetMaxRange() const;    ///< [m], see Configure()
  double GetRangeRes() const;    ///< [m], see Configure(); 0.001 by default
  double GetFrequency() const;   ///< readings a simulated second [Hz]

  /// GetElementCount(), as Player 2.x called it. @deprecated
  uint32_t GetSensorCount() const { return GetElementCount(); }
  /// GetElementPose(), as Player 2.x called it. @deprecated
  player_pose3d_t GetSensorPose(uint32_t aIndex) const { return GetElementPose(aIndex); }
  /// GetElementSize(), as Player 2.x called it. @deprecated
  player_bbox3d_t GetSensorSize(uint32_t aIndex) const { return GetElementSize(aIndex); }

 protected:
  void HandleReading() override;

 private:
  // All of these are guarded by the client's mutex.
  [[gnu::cold]] double LockedRange(uint32_t aIndex) const;  // takes it
  void View();

  bool mIsLaser = false;
  std::size_t mCount = 0;  // of measured ranges
  std::size_t mFirst = 0;  // of the shown ones among these
  std::size_t mStride = 1;
  std::size_t mShown = 0;
  double mMinRange = 0.0;
  double mMaxRange = 0.0;
  double mRangeRes = 0.0;  // 0: not rounded
  std::vector<player_pose3d_t> mPoses;
};

}  // namespace PlayerCc

namespace std {
/// Prints the settings, then the ranges, one a line: x and y of its end, range.
std::ostream& operator<<(std::ostream& os, const PlayerCc::RangerProxy& c);
}  // namespace std
