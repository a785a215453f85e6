// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <ostream>

#include "core/errors.h"
#include "libplayerc++/rangerproxy.h"
#include "proxies/beam_window.h"
#include "proxies/link.h"
#include "proxies/sensor_support.h"
#include "sim/core/math.h"
#include "sim/devices/laser.h"
#include "sim/devices/rangers.h"

namespace PlayerCc {

using sim::LaserReading;
using sim::RangerReading;

namespace {

constexpr ElementWords kRanges{"range", "ranges"};
constexpr ElementWords kElements{"element", "elements"};

const std::vector<double>& ranges_of(const playerlike::Newest& newest) {
  const auto* scan = newest.find<LaserReading>();
  return scan != nullptr ? scan->ranges_m : newest.as<RangerReading>().ranges_m;
}

const std::vector<double>& intensities_of(const playerlike::Newest& newest) {
  const auto* scan = newest.find<LaserReading>();
  return scan != nullptr ? scan->intensities : newest.as<RangerReading>().intensities;
}

}  // namespace

RangerProxy::RangerProxy(PlayerClient* aPc, uint32_t aIndex) : ClientProxy(aPc, aIndex) {
  const char* fun = "RangerProxy::RangerProxy";
  Attach(PLAYER_RANGER_CODE, aIndex, fun);
  const scoped_lock_t lock(LockData(fun));
  mMaxRange = mLink->property("range_max", 0.0);
  mMinRange = mLink->property("range_min", 0.0);
  mIsLaser = mLink->info().type == "laser";
  if (mIsLaser) {
    const detail::ScannerSettings scanner = detail::scanner_settings(mLink->info().properties);
    mCount = scanner.count;
    mPoses.resize(1);
    mLink->show(detail::announced_scan(scanner));
  } else {
    mPoses = detail::element_poses(mLink->info().properties);
    mCount = mPoses.size();
    mLink->show(std::make_shared<RangerReading>());
  }
  mShown = mCount;
}

RangerProxy::~RangerProxy() { ClientProxy::Unsubscribe(); }

void RangerProxy::HandleReading(const playerlike::NewReading& aNew) {
  const auto* scan = playerlike::reading_as<LaserReading>(*aNew.reading);
  const auto* round = playerlike::reading_as<RangerReading>(*aNew.reading);
  if (scan == nullptr && round == nullptr) return;
  const std::size_t count = (scan != nullptr ? scan->ranges_m : round->ranges_m).size();
  if (count != mCount) {  // differs from the announced geometry: expose all of it
    mCount = count;
    mFirst = 0;
    mStride = 1;
    mShown = mCount;
  }
  View(aNew);
}

// Shows measured ranges or a part of them.
void RangerProxy::View(const playerlike::NewReading& aMeasured) {
  if (mStride == 1 && mShown == mCount && !mLimits) return mLink->show(aMeasured.reading);
  const auto limit = [this](std::vector<double>& ranges) {
    if (!mLimits) return;
    for (double& range : ranges) {
      range = playerlike::limited_range_m(range, mRangeRes, mMinRange, mMaxRange);
    }
  };
  const auto show = [&](const auto& shown) {
    limit(shown->ranges_m);
    mLink->show(shown, aMeasured.reading);
  };
  if (const auto* scan = playerlike::reading_as<LaserReading>(*aMeasured.reading)) {
    show(detail::part_of(*scan, {mFirst, mStride, mShown}));
  } else {
    show(std::make_shared<RangerReading>(static_cast<const RangerReading&>(*aMeasured.reading)));
  }
}

uint32_t RangerProxy::GetElementCount() const {
  const scoped_lock_t lock(LockData("RangerProxy::GetElementCount"));
  return static_cast<uint32_t>(mPoses.size());
}

player_pose3d_t RangerProxy::GetDevicePose() const {
  const scoped_lock_t lock(LockData());
  if (!mIsLaser) return {0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
  return detail::to_players<player_pose3d_t>(
      detail::scanner_settings(mLink->info().properties).mounting);
}

player_bbox3d_t RangerProxy::GetDeviceSize() const {
  const scoped_lock_t lock(LockData());
  if (mIsLaser)
    return detail::to_players<player_bbox3d_t>(
        detail::scanner_settings(mLink->info().properties).size);
  return detail::to_players<player_bbox3d_t>(mLink->robot());
}

player_pose3d_t RangerProxy::GetElementPose(uint32_t aIndex) const {
  const char* fun = "RangerProxy::GetElementPose";
  const scoped_lock_t lock(LockData(fun));
  return mLink->element_or_zero(fun, kElements, aIndex, mPoses);
}

player_bbox3d_t RangerProxy::GetElementSize(uint32_t aIndex) const {
  const char* fun = "RangerProxy::GetElementSize";
  const scoped_lock_t lock(LockData(fun));
  if (!mLink->has_element(fun, kElements, aIndex, mPoses.size()) || !mIsLaser)
    return {0.0, 0.0, 0.0};
  return detail::to_players<player_bbox3d_t>(
      detail::scanner_settings(mLink->info().properties).size);
}

uint32_t RangerProxy::GetRangeCount() const {
  uint32_t count = 0;
  if (mElements.Count(count)) return count;
  const scoped_lock_t lock(mLink->lock_element("RangerProxy::GetRangeCount"));
  return static_cast<uint32_t>(ranges_of(mLink->newest).size());
}

double RangerProxy::LockedRange(uint32_t aIndex) const {
  const char* fun = "RangerProxy::GetRange";
  const scoped_lock_t lock(mLink->lock_element(fun));
  return mLink->element_or_zero(fun, kRanges, aIndex, ranges_of(mLink->newest));
}

uint32_t RangerProxy::GetPointCount() const { return GetRangeCount(); }

player_point_3d_t RangerProxy::GetPoint(uint32_t aIndex) const {
  const char* fun = "RangerProxy::GetPoint";
  const scoped_lock_t lock(LockData(fun));
  const std::vector<double>& ranges = ranges_of(mLink->newest);
  if (!mLink->has_element(fun, kRanges, aIndex, ranges.size())) return {0.0, 0.0, 0.0};
  const double range = ranges[aIndex];
  if (mIsLaser) {
    const double bearing = detail::bearing_rad(mLink->newest.as<LaserReading>(), aIndex);
    return {range * sim::math::cos(bearing), range * sim::math::sin(bearing), 0.0};
  }
  const player_pose3d_t element =
      aIndex < mPoses.size() ? mPoses[aIndex] : player_pose3d_t{0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
  return {element.px + range * sim::math::cos(element.pyaw),
          element.py + range * sim::math::sin(element.pyaw), element.pz};
}

uint32_t RangerProxy::GetIntensityCount() const {
  const scoped_lock_t lock(LockData("RangerProxy::GetIntensityCount"));
  const std::size_t measured = intensities_of(mLink->newest).size();
  const bool of_echoes = measured == 0 && mLink->property("intensity", 0.0) > 0.0;
  return static_cast<uint32_t>(of_echoes ? ranges_of(mLink->newest).size() : measured);
}

double RangerProxy::GetIntensity(uint32_t aIndex) const {
  const char* fun = "RangerProxy::GetIntensity";
  const scoped_lock_t lock(LockData(fun));
  const std::vector<double>& intensities = intensities_of(mLink->newest);
  if (aIndex < intensities.size()) return intensities[aIndex];
  if (const double echo = mLink->property("intensity", 0.0); echo > 0.0) {
    const double range = mLink->element_or_zero(fun, kRanges, aIndex, ranges_of(mLink->newest));
    return playerlike::echo_intensity(range, mLink->property("range_max", 0.0), echo);
  }
  mLink->warn_once(fun, "there is no intensity " + std::to_string(aIndex) +
                            ": the simulated rangers measure ranges only; intensities read 0");
  return 0.0;
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
  const scoped_lock_t lock(LockData(fun));
  const auto limits = playerlike::translated(fun, [&] {
    return playerlike::range_limits({aMinRange, aMaxRange, aRangeRes},
                                    mLink->property("range_max", 0.0));
  });
  if (const auto* scan = playerlike::reading_as<LaserReading>(*mLink->measured())) {
    const detail::BeamWindow window = detail::window_of(
        fun, aMinAngle, aMaxAngle, aAngularRes, mCount, scan->angle_min_rad, scan->resolution_rad);
    mFirst = window.first;
    mStride = window.stride;
    mShown = window.shown;
  }
  mLink->core->begin_change();
  mMinRange = limits.min_m;
  mMaxRange = limits.max_m;
  mRangeRes = limits.resolution_m;
  mLimits = limits.any;
  const sim::SharedReading measured = mLink->measured();  // show() replaces it
  View({measured});
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
  return mIsLaser ? mLink->newest.as<LaserReading>().angle_min_rad
                  : -0.5 * mLink->property("field_of_view", 0.0);
}

double RangerProxy::GetMaxAngle() const {
  const scoped_lock_t lock(LockData("RangerProxy::GetMaxAngle"));
  return mIsLaser
             ? detail::bearing_rad(mLink->newest.as<LaserReading>(), mShown > 0 ? mShown - 1 : 0)
             : 0.5 * mLink->property("field_of_view", 0.0);
}

double RangerProxy::GetAngularRes() const {
  const scoped_lock_t lock(LockData("RangerProxy::GetAngularRes"));
  return mIsLaser ? mLink->newest.as<LaserReading>().resolution_rad
                  : mLink->property("field_of_view", 0.0);
}

double RangerProxy::GetMinRange() const { return GetVar(mMinRange); }
double RangerProxy::GetMaxRange() const { return GetVar(mMaxRange); }
double RangerProxy::GetRangeRes() const {
  const scoped_lock_t lock(LockData("RangerProxy::GetRangeRes"));
  return mRangeRes > 0.0 ? mRangeRes : detail::kRangeResolution_m;
}

double RangerProxy::GetFrequency() const {
  const scoped_lock_t lock(LockData());
  return mLink->property("frequency", 0.0);
}

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
