// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <ostream>

#include "libplayerc++/sonarproxy.h"
#include "proxies/link.h"
#include "proxies/sensor_support.h"
#include "sim/devices/rangers.h"

namespace PlayerCc {

SonarProxy::SonarProxy(PlayerClient* aPc, uint32_t aIndex) : ClientProxy(aPc, aIndex) {
  SonarProxy::Subscribe(aIndex);
}

SonarProxy::~SonarProxy() { SonarProxy::Unsubscribe(); }

void SonarProxy::Subscribe(uint32_t aIndex) {
  const char* fun = "SonarProxy::SonarProxy";
  Attach(PLAYER_SONAR_CODE, aIndex, fun);
  const scoped_lock_t lock(LockData(fun));
  mPoses = detail::element_poses(mLink->info().properties);
}

void SonarProxy::Unsubscribe() { ClientProxy::Unsubscribe(); }

void SonarProxy::HandleReading(const detail::Reading& aReading) {
  const auto* reading = dynamic_cast<const sim::RangerReading*>(&aReading.measured);
  if (reading != nullptr) mRanges = reading->ranges_m;
}

bool SonarProxy::IsCapable(uint32_t aType, uint32_t aSubtype) const {
  return (aType == PLAYER_MSGTYPE_DATA && aSubtype == PLAYER_SONAR_DATA_RANGES) ||
         (aType == PLAYER_MSGTYPE_REQ && aSubtype == PLAYER_SONAR_REQ_GET_GEOM);
}

uint32_t SonarProxy::GetCount() const {
  const scoped_lock_t lock(LockData("SonarProxy::GetCount"));
  return static_cast<uint32_t>(mRanges.size());
}

double SonarProxy::GetScan(uint32_t aIndex) const {
  const scoped_lock_t lock(LockData("SonarProxy::GetScan"));
  return aIndex < mRanges.size() ? mRanges[aIndex] : -1.0;
}

double SonarProxy::operator[](uint32_t aIndex) const { return GetScan(aIndex); }

uint32_t SonarProxy::GetPoseCount() const {
  const scoped_lock_t lock(LockData("SonarProxy::GetPoseCount"));
  return static_cast<uint32_t>(mPoses.size());
}

player_pose3d_t SonarProxy::GetPose(uint32_t aIndex) const {
  const char* fun = "SonarProxy::GetPose";
  const scoped_lock_t lock(LockData(fun));
  detail::require_index(fun, "transducer", aIndex, mPoses.size());
  return mPoses[aIndex];
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
