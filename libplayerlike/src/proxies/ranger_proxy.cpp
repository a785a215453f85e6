// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <ostream>

#include "devices/errors.h"
#include "libplayerc++/rangerproxy.h"
#include "proxies/beam_window.h"
#include "proxies/link.h"
#include "proxies/sensor_support.h"
#include "sim/devices/laser.h"
#include "sim/devices/rangers.h"

namespace PlayerCc {

RangerProxy::RangerProxy(PlayerClient* aPc, uint32_t aIndex) : ClientProxy(aPc, aIndex) {
  RangerProxy::Subscribe(aIndex);
}

RangerProxy::~RangerProxy() { RangerProxy::Unsubscribe(); }

void RangerProxy::Subscribe(uint32_t aIndex) {
  const char* fun = "RangerProxy::RangerProxy";
  Attach(PLAYER_RANGER_CODE, aIndex, fun);
  const scoped_lock_t lock(LockData(fun));
  mFrequency = mLink->property("frequency", 0.0);
  mNativeMaxRange = mLink->property("range_max", 0.0);
  mMaxRange = mNativeMaxRange;
  mIsLaser = mLink->info().type == "laser";
  if (mIsLaser) {
    const detail::ScannerSettings scanner = detail::scanner_settings(mLink->info().properties);
    mNativeCount = scanner.count;
    mNativeMin = scanner.least_rad;
    mNativeRes = scanner.native_rad;
    mPose = scanner.pose;
    mSize = scanner.size;
    mElements.resize(1);
  } else {
    mElements = detail::element_poses(mLink->info().properties);
    mNativeCount = mElements.size();
    mFieldOfView = mLink->property("field_of_view", 0.0);
    mSize = {mLink->robot().width_m, mLink->robot().length_m, mLink->robot().height_m};
  }
  mShown = mNativeCount;
}

void RangerProxy::Unsubscribe() { ClientProxy::Unsubscribe(); }

void RangerProxy::HandleReading(const detail::Reading& aReading) {
  if (const auto* scan = dynamic_cast<const sim::LaserReading*>(&aReading.measured)) {
    mMeasured = scan->ranges_m;
    mNativeMin = scan->angle_min_rad;
    mNativeRes = scan->resolution_rad;
  } else if (const auto* round = dynamic_cast<const sim::RangerReading*>(&aReading.measured)) {
    mMeasured = round->ranges_m;
  } else {
    return;
  }
  if (mMeasured.size() != mNativeCount) {  // another geometry than announced: show all of it
    mNativeCount = mMeasured.size();
    mFirst = 0;
    mStride = 1;
    mShown = mNativeCount;
  }
  View();
}

// Makes the shown ranges from the measured ones.
void RangerProxy::View() {
  if (mMeasured.empty()) return;
  mRanges.resize(mShown);
  for (std::size_t i = 0; i < mShown; ++i) {
    double range = mMeasured[mFirst + i * mStride];
    if (mRangeRes > 0.0) range = std::round(range / mRangeRes) * mRangeRes;
    mRanges[i] = std::min(std::max(range, mMinRange), mMaxRange);
  }
}

bool RangerProxy::IsCapable(uint32_t aType, uint32_t aSubtype) const {
  switch (aType) {
    case PLAYER_MSGTYPE_DATA:
      return aSubtype == PLAYER_RANGER_DATA_RANGE;
    case PLAYER_MSGTYPE_REQ:
      return aSubtype == PLAYER_RANGER_REQ_GET_GEOM || aSubtype == PLAYER_RANGER_REQ_SET_CONFIG ||
             aSubtype == PLAYER_RANGER_REQ_GET_CONFIG;
    default:
      return false;
  }
}

// With the client's mutex held.
double RangerProxy::Bearing(std::size_t aShown) const {
  return mNativeMin + static_cast<double>(mFirst + aShown * mStride) * mNativeRes;
}

uint32_t RangerProxy::GetElementCount() const {
  const scoped_lock_t lock(LockData("RangerProxy::GetElementCount"));
  return static_cast<uint32_t>(mElements.size());
}

player_pose3d_t RangerProxy::GetDevicePose() const { return GetVar(mPose); }

player_bbox3d_t RangerProxy::GetDeviceSize() const { return GetVar(mSize); }

player_pose3d_t RangerProxy::GetElementPose(uint32_t aIndex) const {
  const char* fun = "RangerProxy::GetElementPose";
  const scoped_lock_t lock(LockData(fun));
  detail::require_index(fun, "element", aIndex, mElements.size());
  return mElements[aIndex];
}

player_bbox3d_t RangerProxy::GetElementSize(uint32_t aIndex) const {
  const char* fun = "RangerProxy::GetElementSize";
  const scoped_lock_t lock(LockData(fun));
  detail::require_index(fun, "element", aIndex, mElements.size());
  return mIsLaser ? mSize : player_bbox3d_t{0.0, 0.0, 0.0};
}

uint32_t RangerProxy::GetRangeCount() const {
  const scoped_lock_t lock(LockData("RangerProxy::GetRangeCount"));
  return static_cast<uint32_t>(mRanges.size());
}

double RangerProxy::GetRange(uint32_t aIndex) const {
  const char* fun = "RangerProxy::GetRange";
  const scoped_lock_t lock(LockData(fun));
  detail::require_index(fun, "range", aIndex, mRanges.size());
  return mRanges[aIndex];
}

double RangerProxy::operator[](uint32_t aIndex) const { return GetRange(aIndex); }

uint32_t RangerProxy::GetPointCount() const { return GetRangeCount(); }

player_point_3d_t RangerProxy::GetPoint(uint32_t aIndex) const {
  const char* fun = "RangerProxy::GetPoint";
  const scoped_lock_t lock(LockData(fun));
  detail::require_index(fun, "point", aIndex, mRanges.size());
  const double range = mRanges[aIndex];
  if (mIsLaser) {
    const double bearing = Bearing(aIndex);
    return {range * std::cos(bearing), range * std::sin(bearing), 0.0};
  }
  const player_pose3d_t element = aIndex < mElements.size() ? mElements[aIndex] : mPose;
  return {element.px + range * std::cos(element.pyaw), element.py + range * std::sin(element.pyaw),
          element.pz};
}

uint32_t RangerProxy::GetIntensityCount() const {
  const scoped_lock_t lock(LockData("RangerProxy::GetIntensityCount"));
  return 0;
}

double RangerProxy::GetIntensity(uint32_t aIndex) const {
  const char* fun = "RangerProxy::GetIntensity";
  const scoped_lock_t lock(LockData(fun));
  throw PlayerError(fun,
                    "there is no intensity " + std::to_string(aIndex) +
                        ": the simulated rangers measure ranges only",
                    PlayerError::kBadArgument);
}

void RangerProxy::SetPower(bool aEnable) {
  static_cast<void>(aEnable);
  const scoped_lock_t lock(LockData("RangerProxy::SetPower"));
}

void RangerProxy::SetIntensityData(bool aEnable) {
  static_cast<void>(aEnable);
  const scoped_lock_t lock(LockData("RangerProxy::SetIntensityData"));
}

void RangerProxy::RequestGeom() { const scoped_lock_t lock(LockData("RangerProxy::RequestGeom")); }

void RangerProxy::Configure(double aMinAngle, double aMaxAngle, double aAngularRes,
                            double aMinRange, double aMaxRange, double aRangeRes,
                            double aFrequency) {
  static_cast<void>(aFrequency);
  const char* fun = "RangerProxy::Configure";
  playerlike::require_finite(fun, {{"the least angle", aMinAngle},
                                   {"the greatest angle", aMaxAngle},
                                   {"the angular resolution", aAngularRes},
                                   {"the least range", aMinRange},
                                   {"the greatest range", aMaxRange},
                                   {"the resolution of ranges", aRangeRes}});
  if (aMinRange < 0.0 || aMaxRange < 0.0 || aRangeRes < 0.0) {
    throw PlayerError(fun, "a range, or the resolution of ranges, is negative",
                      PlayerError::kBadArgument);
  }
  const scoped_lock_t lock(LockData(fun));
  if (mIsLaser) {
    const detail::BeamWindow window = detail::window_of(fun, aMinAngle, aMaxAngle, aAngularRes,
                                                        mNativeCount, mNativeMin, mNativeRes);
    mFirst = window.first;
    mStride = window.stride;
    mShown = window.shown;
  }
  mMaxRange = aMaxRange > 0.0 ? std::min(aMaxRange, mNativeMaxRange) : mNativeMaxRange;
  mMinRange = std::min(aMinRange, mMaxRange);
  mRangeRes = aRangeRes;
  View();
}

void RangerProxy::Configure(double aMinAngle, double aMaxAngle, double aAngularRes,
                            double aMaxRange, double aRangeRes, double aFrequency) {
  Configure(aMinAngle, aMaxAngle, aAngularRes, 0.0, aMaxRange, aRangeRes, aFrequency);
}

void RangerProxy::RequestConfigure() {
  const scoped_lock_t lock(LockData("RangerProxy::RequestConfigure"));
}

double RangerProxy::GetMinAngle() const {
  const scoped_lock_t lock(LockData("RangerProxy::GetMinAngle"));
  return mIsLaser ? Bearing(0) : -0.5 * mFieldOfView;
}

double RangerProxy::GetMaxAngle() const {
  const scoped_lock_t lock(LockData("RangerProxy::GetMaxAngle"));
  return mIsLaser ? Bearing(mShown > 0 ? mShown - 1 : 0) : 0.5 * mFieldOfView;
}

double RangerProxy::GetAngularRes() const {
  const scoped_lock_t lock(LockData("RangerProxy::GetAngularRes"));
  return mIsLaser ? mNativeRes * static_cast<double>(mStride) : mFieldOfView;
}

double RangerProxy::GetMinRange() const { return GetVar(mMinRange); }
double RangerProxy::GetMaxRange() const { return GetVar(mMaxRange); }
double RangerProxy::GetRangeRes() const { return GetVar(mRangeRes); }
double RangerProxy::GetFrequency() const { return GetVar(mFrequency); }

}  // namespace PlayerCc

namespace std {

std::ostream& operator<<(std::ostream& os, const PlayerCc::RangerProxy& c) {
  os << '#' << static_cast<const PlayerCc::ClientProxy&>(c)
     << "\n#min [rad]\tmax [rad]\tresolution [rad]\tmax range [m]\telements\tranges\n"
     << c.GetMinAngle() << '\t' << c.GetMaxAngle() << '\t' << c.GetAngularRes() << '\t'
     << c.GetMaxRange() << '\t' << c.GetElementCount() << '\t' << c.GetRangeCount()
     << "\n#x [m]\ty [m]\trange [m]\n";
  for (uint32_t i = 0; i < c.GetRangeCount(); ++i) {
    const player_point_3d_t p = c.GetPoint(i);
    os << p.px << '\t' << p.py << '\t' << c.GetRange(i) << '\n';
  }
  return os;
}

}  // namespace std
