// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <ostream>
#include <vector>

#include "libplayerc++/sonarproxy.h"
#include "proxies/link.h"
#include "proxies/sensor_support.h"
#include "sim/devices/rangers.h"

namespace PlayerCc {

using detail::count_of_ranges;
using sim::RangerReading;

SonarProxy::SonarProxy(PlayerClient* aPc, uint32_t aIndex) : ClientProxy(aPc, aIndex) {
  const char* fun = "SonarProxy::SonarProxy";
  Attach(PLAYER_SONAR_CODE, aIndex, fun);
  const scoped_lock_t lock(LockData(fun));
  mPoses = detail::element_poses(mLink->info().properties);
}

SonarProxy::~SonarProxy() { ClientProxy::Unsubscribe(); }

uint32_t SonarProxy::GetCount() const {
  uint32_t count = 0;
  if (mElements.Count(count)) return count;
  const scoped_lock_t lock(mLink->lock_element("SonarProxy::GetCount"));
  return count_of_ranges(mLink->newest.as<RangerReading>());
}

double SonarProxy::GetScan(uint32_t aIndex) const {
  double range = 0.0;
  if (mElements.Find(aIndex, range)) return range;
  const char* fun = "SonarProxy::GetScan";
  const scoped_lock_t lock(mLink->lock_element(fun));
  const std::vector<double>& ranges = mLink->newest.as<RangerReading>().ranges_m;
  constexpr ElementWords kScans{"transducer", "transducers", "there are", "-1"};
  return mLink->has_element(fun, kScans, aIndex, ranges.size()) ? ranges[aIndex] : -1.0;
}

double SonarProxy::operator[](uint32_t aIndex) const { return GetScan(aIndex); }

uint32_t SonarProxy::GetPoseCount() const {
  const scoped_lock_t lock(LockData("SonarProxy::GetPoseCount"));
  return static_cast<uint32_t>(mPoses.size());
}

player_pose3d_t SonarProxy::GetPose(uint32_t aIndex) const {
  const char* fun = "SonarProxy::GetPose";
  const scoped_lock_t lock(LockData(fun));
  return mLink->element_or_zero(fun, detail::kTransducers, aIndex, mPoses);
}

void SonarProxy::RequestGeom() { const scoped_lock_t lock(LockData("SonarProxy::RequestGeom")); }

}  // namespace PlayerCc

namespace std {

std::ostream& operator<<(std::ostream& os, const PlayerCc::SonarProxy& c) {
  os << '#' << static_cast<const PlayerCc::ClientProxy&>(c)
     << "\n#x [m]\ty [m]\tyaw [rad]\trange [m]\n";
  for (uint32_t i = 0; i < c.GetPoseCount(); ++i) {
    PlayerCc::detail::print_pose(os, c.GetPose(i));
    os << '\t' << c.GetScan(i) << '\n';
  }
  return os;
}

}  // namespace std
