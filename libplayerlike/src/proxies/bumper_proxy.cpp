// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <ostream>
#include <vector>

#include "libplayerc++/bumperproxy.h"
#include "proxies/link.h"
#include "proxies/sensor_support.h"
#include "session/player_values/bumper.h"

namespace PlayerCc {

using sim::BumperReading;

namespace {

constexpr ElementWords kSegments{"segment", "segments"};

}  // namespace

BumperProxy::BumperProxy(PlayerClient* aPc, uint32_t aIndex) : ClientProxy(aPc, aIndex) {
  const char* fun = "BumperProxy::BumperProxy";
  Attach(PLAYER_BUMPER_CODE, aIndex, fun);
  const scoped_lock_t lock(LockData(fun));
  mPoses = playerlike::translated("", [&] {
    return playerlike::bumper_segments<player_bumper_define_t>(mLink->info().properties);
  });
}

BumperProxy::~BumperProxy() { ClientProxy::Unsubscribe(); }

uint32_t BumperProxy::GetCount() const {
  return static_cast<uint32_t>(Look(&BumperReading::pressed, "BumperProxy::GetCount").size());
}

uint32_t BumperProxy::IsBumped(uint32_t aIndex) const {
  const char* fun = "BumperProxy::IsBumped";
  return Look<BumperReading>(
      [&](const auto& r) { return mLink->element_or_zero(fun, kSegments, aIndex, r.pressed); },
      fun);
}

bool BumperProxy::IsAnyBumped() {
  const std::vector<uint8_t> pressed = Look(&BumperReading::pressed, "BumperProxy::IsAnyBumped");
  return std::find(pressed.begin(), pressed.end(), 1) != pressed.end();
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
  return mLink->element_or_zero(fun, kSegments, aIndex, mPoses);
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
