// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <ostream>
#include <string>
#include <utility>

#include "devices/errors.h"
#include "devices/warnings.h"
#include "libplayerc++/laserproxy.h"
#include "proxies/beam_window.h"
#include "proxies/link.h"
#include "sim/devices/laser.h"

namespace PlayerCc {

namespace {

// What both the S1R's Hokuyo URG-04LX and a SICK LMS200 report of themselves, by their data sheets.
constexpr double kRangeResolution_m = 0.001;

}  // namespace

LaserProxy::LaserProxy(PlayerClient* aPc, uint32_t aIndex) : ClientProxy(aPc, aIndex) {
  LaserProxy::Subscribe(aIndex);
}

LaserProxy::~LaserProxy() { LaserProxy::Unsubscribe(); }

void LaserProxy::Subscribe(uint32_t aIndex) {
  const char* fun = "LaserProxy::LaserProxy";
  Attach(PLAYER_LASER_CODE, aIndex, fun);
  const scoped_lock_t lock(LockData(fun));
  const detail::ScannerSettings scanner = detail::scanner_settings(mLink->info().properties);
  mNativeCount = mShown = scanner.count;
  mNativeMin = scanner.least_rad;
  mNativeRes = scanner.native_rad;
  mMaxRange = scanner.range_max_m;
  mFrequency = scanner.frequency_hz;
  mPose = scanner.pose;
  mSize = scanner.size;
}

void LaserProxy::Unsubscribe() { ClientProxy::Unsubscribe(); }

void LaserProxy::HandleReading(const detail::Reading& aReading) {
  const auto* reading = dynamic_cast<const sim::LaserReading*>(&aReading.measured);
  if (reading == nullptr) return;
  if (reading->ranges_m.size() != mNativeCount) {
    // Another geometry than announced: show all of it.
    mNativeCount = reading->ranges_m.size();
    mFirst = 0;
    mStride = 1;
    mShown = mNativeCount;
  }
  mNativeMin = reading->angle_min_rad;
  mNativeRes = reading->resolution_rad;
  mMaxRange = reading->range_max_m;
  mScan = reading->ranges_m;
  View();
}

// Makes the shown ranges from the measured ones.
void LaserProxy::View() {
  if (mScan.empty()) return;
  if (mStride == 1 && mShown == mScan.size() && mRangeRes == 0.0) {
    mRanges = mScan;
    return;
  }
  mRanges.resize(mShown);
  for (std::size_t i = 0; i < mShown; ++i) {
    double range = mScan[mFirst + i * mStride];
    if (mRangeRes > 0.0) range = std::min(std::round(range / mRangeRes) * mRangeRes, mMaxRange);
    mRanges[i] = range;
  }
}

bool LaserProxy::IsCapable(uint32_t aType, uint32_t aSubtype) const {
  switch (aType) {
    case PLAYER_MSGTYPE_DATA:
      return aSubtype == PLAYER_LASER_DATA_SCAN;
    case PLAYER_MSGTYPE_REQ:
      return aSubtype == PLAYER_LASER_REQ_GET_GEOM || aSubtype == PLAYER_LASER_REQ_SET_CONFIG ||
             aSubtype == PLAYER_LASER_REQ_GET_CONFIG || aSubtype == PLAYER_LASER_REQ_GET_ID;
    default:
      return false;
  }
}

// With the client's mutex held, as the next two.
double LaserProxy::CheckedRange(uint32_t aIndex, const char* aFun) const {
  if (mRanges.empty()) return 0.0;
  if (aIndex >= mRanges.size()) {
    if (!std::exchange(mHasWarned, true)) {
      playerlike::warn(std::string(aFun) + ": there is no beam " + std::to_string(aIndex) +
                       ": the scan has " + std::to_string(mRanges.size()) +
                       ", counted from 0; beams beyond the last read 0");
    }
    return 0.0;
  }
  return mRanges[aIndex];
}

double LaserProxy::Bearing(uint32_t aIndex) const {
  return mNativeMin + static_cast<double>(mFirst + aIndex * mStride) * mNativeRes;
}

double LaserProxy::LeastRange(std::size_t aBegin, std::size_t aEnd) const {
  double least = mMaxRange;
  for (std::size_t i = aBegin; i < aEnd; ++i) least = std::min(least, mRanges[i]);
  return least;
}

uint32_t LaserProxy::GetCount() const {
  const scoped_lock_t lock(LockData("LaserProxy::GetCount"));
  return static_cast<uint32_t>(mRanges.size());
}

double LaserProxy::GetMaxRange() const { return GetVar(mMaxRange); }

double LaserProxy::GetScanRes() const {
  const scoped_lock_t lock(LockData("LaserProxy::GetScanRes"));
  return mNativeRes * static_cast<double>(mStride);
}

double LaserProxy::GetRangeRes() const {
  const scoped_lock_t lock(LockData("LaserProxy::GetRangeRes"));
  return mRangeRes > 0.0 ? mRangeRes : kRangeResolution_m;
}

double LaserProxy::GetScanningFrequency() const { return GetVar(mFrequency); }

double LaserProxy::GetMinAngle() const { return GetConfMinAngle(); }

double LaserProxy::GetMaxAngle() const { return GetConfMaxAngle(); }

double LaserProxy::GetConfMinAngle() const {
  const scoped_lock_t lock(LockData("LaserProxy::GetMinAngle"));
  return Bearing(0);
}

double LaserProxy::GetConfMaxAngle() const {
  const scoped_lock_t lock(LockData("LaserProxy::GetMaxAngle"));
  return mShown > 0 ? Bearing(static_cast<uint32_t>(mShown - 1)) : Bearing(0);
}

bool LaserProxy::IntensityOn() const {
  const scoped_lock_t lock(LockData("LaserProxy::IntensityOn"));
  return false;
}

player_point_2d_t LaserProxy::GetPoint(uint32_t aIndex) const {
  const char* fun = "LaserProxy::GetPoint";
  const scoped_lock_t lock(LockData(fun));
  const double range = CheckedRange(aIndex, fun);
  const double bearing = Bearing(aIndex);
  return {range * std::cos(bearing), range * std::sin(bearing)};
}

double LaserProxy::GetRange(uint32_t aIndex) const {
  const char* fun = "LaserProxy::GetRange";
  const scoped_lock_t lock(LockData(fun));
  return CheckedRange(aIndex, fun);
}

double LaserProxy::GetBearing(uint32_t aIndex) const {
  const char* fun = "LaserProxy::GetBearing";
  const scoped_lock_t lock(LockData(fun));
  static_cast<void>(CheckedRange(aIndex, fun));
  return aIndex < mRanges.size() ? Bearing(aIndex) : 0.0;
}

int LaserProxy::GetIntensity(uint32_t aIndex) const {
  const char* fun = "LaserProxy::GetIntensity";
  const scoped_lock_t lock(LockData(fun));
  static_cast<void>(CheckedRange(aIndex, fun));
  return 0;
}

int LaserProxy::GetID() const {
  const scoped_lock_t lock(LockData("LaserProxy::GetID"));
  return 0;
}

void LaserProxy::Configure(double aMinAngle, double aMaxAngle, uint32_t aScanRes,
                           uint32_t aRangeRes, bool aIntensity, double aScanningFrequency) {
  static_cast<void>(aIntensity);
  static_cast<void>(aScanningFrequency);
  const char* fun = "LaserProxy::Configure";
  playerlike::require_finite(fun,
                             {{"the least angle", aMinAngle}, {"the greatest angle", aMaxAngle}});
  const scoped_lock_t lock(LockData(fun));
  // Beams are numbered from the first measured one; a window may reach beyond the scan.
  const detail::BeamWindow window =
      detail::window_of(fun, aMinAngle, aMaxAngle, aScanRes * 0.01 * M_PI / 180.0, mNativeCount,
                        mNativeMin, mNativeRes);
  mFirst = window.first;
  mStride = window.stride;
  mShown = window.shown;
  mRangeRes = aRangeRes * 0.001;
  View();
}

void LaserProxy::RequestConfigure() {
  const scoped_lock_t lock(LockData("LaserProxy::RequestConfigure"));
}

void LaserProxy::RequestID() { const scoped_lock_t lock(LockData("LaserProxy::RequestID")); }

void LaserProxy::RequestGeom() { const scoped_lock_t lock(LockData("LaserProxy::RequestGeom")); }

player_pose3d_t LaserProxy::GetPose() { return GetVar(mPose); }

player_pose3d_t LaserProxy::GetRobotPose() {
  const scoped_lock_t lock(LockData("LaserProxy::GetRobotPose"));
  const sim::Pose pose = mLink->core->last_pose(mLink->binding.robot).value_or(sim::Pose{});
  return {pose.x_m, pose.y_m, 0.0, 0.0, 0.0, pose.yaw_rad};
}

player_bbox3d_t LaserProxy::GetSize() { return GetVar(mSize); }

double LaserProxy::GetMinLeft() const {
  const scoped_lock_t lock(LockData("LaserProxy::GetMinLeft"));
  return LeastRange(mRanges.size() / 2, mRanges.size());
}

double LaserProxy::GetMinRight() const {
  const scoped_lock_t lock(LockData("LaserProxy::GetMinRight"));
  return LeastRange(0, mRanges.size() / 2);
}

double LaserProxy::MinLeft() const { return GetMinLeft(); }
double LaserProxy::MinRight() const { return GetMinRight(); }

double LaserProxy::operator[](uint32_t index) const {
  const char* fun = "LaserProxy::operator[]";
  const scoped_lock_t lock(LockData(fun));
  return CheckedRange(index, fun);
}

}  // namespace PlayerCc

namespace std {

std::ostream& operator<<(std::ostream& os, const PlayerCc::LaserProxy& c) {
  os << '#' << static_cast<const PlayerCc::ClientProxy&>(c)
     << "\n#min [rad]\tmax [rad]\tresolution [rad]\tmax range [m]\tbeams\n"
     << c.GetMinAngle() << '\t' << c.GetMaxAngle() << '\t' << c.GetScanRes() << '\t'
     << c.GetMaxRange() << '\t' << c.GetCount() << "\n#bearing [rad]\trange [m]\tx [m]\ty [m]\n";
  for (uint32_t i = 0; i < c.GetCount(); ++i) {
    const player_point_2d_t p = c.GetPoint(i);
    os << c.GetBearing(i) << '\t' << c.GetRange(i) << '\t' << p.px << '\t' << p.py << '\n';
  }
  return os;
}

}  // namespace std
