// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <ostream>
#include <string>

#include "libplayerc++/bumperproxy.h"
#include "proxies/link.h"
#include "proxies/sensor_support.h"
#include "sim/devices/bumper.h"

namespace PlayerCc {

BumperProxy::BumperProxy(PlayerClient* aPc, uint32_t aIndex) : ClientProxy(aPc, aIndex) {
  BumperProxy::Subscribe(aIndex);
}

BumperProxy::~BumperProxy() { BumperProxy::Unsubscribe(); }

void BumperProxy::Subscribe(uint32_t aIndex) {
  const char* fun = "BumperProxy::BumperProxy";
  Attach(PLAYER_BUMPER_CODE, aIndex, fun);
  const scoped_lock_t lock(LockData(fun));
  for (const player_pose3d_t& pose : detail::element_poses(mLink->info().properties)) {
    const std::string number = std::to_string(mPoses.size());
    mPoses.push_back({pose, static_cast<float>(mLink->property("length_" + number, 0.0)),
                      static_cast<float>(mLink->property("radius_" + number, 0.0))});
  }
}

void BumperProxy::Unsubscribe() { ClientProxy::Unsubscribe(); }

void BumperProxy::HandleReading(const detail::Reading& aReading) {
  const auto* reading = dynamic_cast<const sim::BumperReading*>(&aReading.measured);
  if (reading != nullptr) mPressed = reading->pressed;
}

bool BumperProxy::IsCapable(uint32_t aType, uint32_t aSubtype) const {
  return (aType == PLAYER_MSGTYPE_DATA && aSubtype == PLAYER_BUMPER_DATA_STATE) ||
         (aType == PLAYER_MSGTYPE_REQ && aSubtype == PLAYER_BUMPER_REQ_GET_GEOM);
}

uint32_t BumperProxy::GetCount() const {
  const scoped_lock_t lock(LockData("BumperProxy::GetCount"));
  return static_cast<uint32_t>(mPressed.size());
}

uint32_t BumperProxy::IsBumped(uint32_t aIndex) const {
  const char* fun = "BumperProxy::IsBumped";
  const scoped_lock_t lock(LockData(fun));
  return detail::element_or_zero(fun, "segment", aIndex, mPressed);
}

bool BumperProxy::IsAnyBumped() {
  const scoped_lock_t lock(LockData("BumperProxy::IsAnyBumped"));
  return std::any_of(mPressed.begin(), mPressed.end(), [](uint8_t pressed) { return pressed; });
}

void BumperProxy::RequestBumperConfig() {
  const scoped_lock_t lock(LockData("BumperProxy::RequestBumperConfig"));
}

uint32_t BumperProxy::GetPoseCount() const {
  const scoped_lock_t lock(LockData("BumperProxy::GetPoseCount"));
  return static_cast<uint32_t>(mPoses.size());
}

player_bumper_define_t BumperProxy::GetPose(uint32_t aIndex) const {
  const char* fun = "BumperProxy::GetPose";
  const scoped_lock_t lock(LockData(fun));
  detail::require_index(fun, "segment", aIndex, mPoses.size());
  return mPoses[aIndex];
}

bool BumperProxy::operator[](uint32_t aIndex) const { return IsBumped(aIndex) != 0; }

}  // namespace PlayerCc

namespace std {

std::ostream& operator<<(std::ostream& os, const PlayerCc::BumperProxy& c) {
  os << '#' << static_cast<const PlayerCc::ClientProxy&>(c)
     << "\n#x [m]\ty [m]\tyaw [rad]\tlength [m]\tradius [m]\tpressed\n";
  for (uint32_t i = 0; i < c.GetPoseCount(); ++i) {
    const player_bumper_define_t segment = c.GetPose(i);
    PlayerCc::detail::print_pose(os, segment.pose);
    os << '\t' << segment.length << '\t' << segment.radius << '\t' << c.IsBumped(i) << '\n';
  }
  return os;
}

}  // namespace std
