// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <optional>
#include <ostream>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "core/errors.h"
#include "libplayerc++/laserproxy.h"
#include "proxies/beam_window.h"
#include "proxies/link.h"
#include "proxies/pose_feed.h"
#include "sim/core/math.h"
#include "sim/devices/laser.h"

namespace PlayerCc {

using detail::bearing_rad;
using sim::LaserReading;

namespace {

constexpr ElementWords kBeams{"beam", "beams", "the scan has"};

}  // namespace

LaserProxy::LaserProxy(PlayerClient* aPc, uint32_t aIndex) : ClientProxy(aPc, aIndex) {
  const char* fun = "LaserProxy::LaserProxy";
  Attach(PLAYER_LASER_CODE, aIndex, fun);
  const scoped_lock_t lock(LockData(fun));
  const detail::ScannerSettings scanner = detail::scanner_settings(mLink->info().properties);
  mCount = mShown = scanner.count;
  mLink->show(detail::announced_scan(scanner));
  const playerlike::ScanDriverInfo* const driver = mLink->binding.scan_driver;
  if (driver == nullptr) return;
  if (const auto* stamps = std::get_if<playerlike::PoseInterpolatorSettings>(&driver->settings)) {
    playerlike::translated(fun, [&] {
      const playerlike::InterfaceBinding poses = playerlike::find_interface(
          mLink->core->robots(), mLink->core->session().port(), "position2d", stamps->position);
      mPoses =
          std::make_shared<playerlike::PoseFeed>(mLink->core, poses.reading, stamps->interpolate);
    });
  }
}

LaserProxy::~LaserProxy() { ClientProxy::Unsubscribe(); }

void LaserProxy::HandleReading(const playerlike::NewReading& aNew) {
  const auto* scan = playerlike::reading_as<LaserReading>(*aNew.reading);
  if (scan == nullptr) return;
  if (scan->ranges_m.size() != mCount) {
    // The scan differs from the announced geometry: expose all of it.
    mCount = scan->ranges_m.size();
    mFirst = 0;
    mStride = 1;
    mShown = mCount;
  }
  const playerlike::ScanDriverInfo* const driver = mLink->binding.scan_driver;
  if (driver == nullptr) return View(aNew);
  View({playerlike::made_scan(*driver, aNew.reading)});
}

// Shows a scan or a part of it.
void LaserProxy::View(const playerlike::NewReading& aMeasured) {
  if (mStride == 1 && mShown == mCount && mRangeRes == 0.0) {
    return mLink->show(aMeasured.reading);
  }
  const auto& scan = static_cast<const LaserReading&>(*aMeasured.reading);
  auto shown = detail::part_of(scan, {mFirst, mStride, mShown});
  if (mRangeRes > 0.0) {
    for (double& range : shown->ranges_m) {
      range = playerlike::limited_range_m(range, mRangeRes, 0.0, scan.range_max_m);
    }
  }
  mLink->show(std::move(shown), aMeasured.reading);
}

// The caller holds the client's mutex.
double LaserProxy::CheckedRange(uint32_t aIndex, const char* aFun) const {
  return mLink->element_or_zero(aFun, kBeams, aIndex, mLink->newest.as<LaserReading>().ranges_m);
}

uint32_t LaserProxy::LockedCount() const {
  const scoped_lock_t lock(mLink->lock_element("LaserProxy::GetCount"));
  return static_cast<uint32_t>(mLink->newest.as<LaserReading>().ranges_m.size());
}

// Programs compare each beam with it.
double LaserProxy::GetMaxRange() const {
  const void* owner = nullptr;
  if (!mElements.Owner(owner)) return Look(&LaserReading::range_max_m);
  return static_cast<const LaserReading&>(*static_cast<const sim::Reading*>(owner)).range_max_m;
}

double LaserProxy::GetScanRes() const {
  return Look(&LaserReading::resolution_rad, "LaserProxy::GetScanRes");
}

double LaserProxy::GetRangeRes() const {
  const scoped_lock_t lock(LockData("LaserProxy::GetRangeRes"));
  return mRangeRes > 0.0 ? mRangeRes : detail::kRangeResolution_m;
}

double LaserProxy::GetScanningFrequency() const {
  const scoped_lock_t lock(LockData());
  return mLink->property("frequency", 0.0);
}

double LaserProxy::GetMinAngle() const { return GetConfMinAngle(); }

double LaserProxy::GetMaxAngle() const { return GetConfMaxAngle(); }

double LaserProxy::GetConfMinAngle() const {
  return Look(&LaserReading::angle_min_rad, "LaserProxy::GetMinAngle");
}

double LaserProxy::GetConfMaxAngle() const {
  return Look<LaserReading>(
      [this](const auto& scan) { return bearing_rad(scan, mShown > 0 ? mShown - 1 : 0); },
      "LaserProxy::GetMaxAngle");
}

bool LaserProxy::IntensityOn() const {
  const scoped_lock_t lock(LockData("LaserProxy::IntensityOn"));
  return !mLink->newest.as<LaserReading>().intensities.empty();
}

player_point_2d_t LaserProxy::GetPoint(uint32_t aIndex) const {
  const auto point = [aIndex](const LaserReading& scan, double range) -> player_point_2d_t {
    const double bearing = bearing_rad(scan, aIndex);
    return {range * sim::math::cos(bearing), range * sim::math::sin(bearing)};
  };
  double range = 0.0;
  const void* owner = nullptr;
  if (mElements.Find(aIndex, range, owner)) {
    return point(static_cast<const LaserReading&>(*static_cast<const sim::Reading*>(owner)), range);
  }
  const char* fun = "LaserProxy::GetPoint";
  const scoped_lock_t lock(mLink->lock_element(fun));
  return point(mLink->newest.as<LaserReading>(), CheckedRange(aIndex, fun));
}

double LaserProxy::LockedRange(uint32_t aIndex, const char* aFun) const {
  const scoped_lock_t lock(mLink->lock_element(aFun));
  return CheckedRange(aIndex, aFun);
}

double LaserProxy::LockedBearing(uint32_t aIndex) const {
  const char* fun = "LaserProxy::GetBearing";
  const scoped_lock_t lock(mLink->lock_element(fun));
  static_cast<void>(CheckedRange(aIndex, fun));
  const auto& scan = mLink->newest.as<LaserReading>();
  if (aIndex >= scan.ranges_m.size()) return 0.0;
  uint32_t shown = 0;  // there may be none before the first reading
  if (mElements.Count(shown)) {
    // The next calls need no lock.
    std::vector<double> bearings(scan.ranges_m.size());
    for (std::size_t i = 0; i < bearings.size(); ++i) bearings[i] = bearing_rad(scan, i);
    mElements.ShowBearings(std::move(bearings));
  }
  return bearing_rad(scan, aIndex);
}

int LaserProxy::GetIntensity(uint32_t aIndex) const {
  const char* fun = "LaserProxy::GetIntensity";
  const scoped_lock_t lock(LockData(fun));
  static_cast<void>(CheckedRange(aIndex, fun));
  const std::vector<double>& intensities = mLink->newest.as<LaserReading>().intensities;
  if (aIndex >= intensities.size() || !(intensities[aIndex] > 0.0)) return 0;
  constexpr double kMost = 255.0;  // Player's intensities are bytes
  return static_cast<int>(std::min(intensities[aIndex], kMost));
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
  const sim::SharedReading measured = mLink->measured();
  const auto& scan = static_cast<const LaserReading&>(*measured);
  // Beams are numbered from the first measured one; the angles may extend beyond the scan.
  const detail::BeamWindow window =
      detail::window_of(fun, aMinAngle, aMaxAngle, aScanRes * 0.01 * M_PI / 180.0, mCount,
                        scan.angle_min_rad, scan.resolution_rad);
  mLink->core->begin_change();
  mFirst = window.first;
  mStride = window.stride;
  mShown = window.shown;
  mRangeRes = aRangeRes * 0.001;
  View({measured});
}

void LaserProxy::RequestConfigure() {
  const scoped_lock_t lock(LockData("LaserProxy::RequestConfigure"));
}

void LaserProxy::RequestID() { const scoped_lock_t lock(LockData("LaserProxy::RequestID")); }

void LaserProxy::RequestGeom() { const scoped_lock_t lock(LockData("LaserProxy::RequestGeom")); }

player_pose3d_t LaserProxy::GetPose() {
  const scoped_lock_t lock(LockData());
  return detail::to_players<player_pose3d_t>(
      detail::scanner_settings(mLink->info().properties).mounting);
}

player_pose3d_t LaserProxy::GetRobotPose() {
  const scoped_lock_t lock(LockData("LaserProxy::GetRobotPose"));
  const std::optional<sim::Pose> known = mPoses ? mPoses->poses().at(mLink->measured()->time_ns)
                                                : mLink->core->last_pose(mLink->binding.robot);
  const sim::Pose pose = known.value_or(sim::Pose{});
  return detail::to_players<player_pose3d_t>(pose);
}

player_bbox3d_t LaserProxy::GetSize() {
  const scoped_lock_t lock(LockData());
  return detail::to_players<player_bbox3d_t>(
      detail::scanner_settings(mLink->info().properties).size);
}

double LaserProxy::LeastRange(bool aLeft) const {
  return Look<LaserReading>(
      [aLeft](const auto& scan) {
        const auto middle =
            scan.ranges_m.begin() + static_cast<std::ptrdiff_t>(scan.ranges_m.size() / 2);
        const auto begin = aLeft ? middle : scan.ranges_m.begin();
        const auto end = aLeft ? scan.ranges_m.end() : middle;
        return std::accumulate(begin, end, scan.range_max_m,
                               [](double a, double b) { return std::min(a, b); });
      },
      aLeft ? "LaserProxy::GetMinLeft" : "LaserProxy::GetMinRight");
}

double LaserProxy::GetMinLeft() const { return LeastRange(true); }
double LaserProxy::GetMinRight() const { return LeastRange(false); }
double LaserProxy::MinLeft() const { return GetMinLeft(); }
double LaserProxy::MinRight() const { return GetMinRight(); }

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
