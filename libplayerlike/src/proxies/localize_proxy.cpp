// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <cstddef>
#include <ostream>
#include <string>

#include "devices/errors.h"
#include "libplayerc++/localizeproxy.h"
#include "proxies/link.h"
#include "sim/devices/localization.h"

namespace PlayerCc {

namespace {

// What an index beyond the end is answered with.
PlayerError no_such(const char* fun, const std::string& what, const std::string& index,
                    std::size_t count, const char* call) {
  return {fun,
          "there is no " + what + ' ' + index + ": there are " + std::to_string(count) +
              (count == 0 ? std::string(" (call ") + call + " first)" : ", counted from 0"),
          PlayerError::kBadArgument};
}

}  // namespace

LocalizeProxy::LocalizeProxy(PlayerClient* aPc, uint32_t aIndex) : ClientProxy(aPc, aIndex) {
  LocalizeProxy::Subscribe(aIndex);
}

LocalizeProxy::~LocalizeProxy() { LocalizeProxy::Unsubscribe(); }

void LocalizeProxy::Subscribe(uint32_t aIndex) {
  const char* fun = "LocalizeProxy::LocalizeProxy";
  Attach(PLAYER_LOCALIZE_CODE, aIndex, fun);
  const scoped_lock_t lock(LockData(fun));
  mNoise_m = mLink->property("noise", 0.0);
  mNoiseYaw_rad = mLink->property("noise_yaw", 0.0);
}

void LocalizeProxy::Unsubscribe() { ClientProxy::Unsubscribe(); }

void LocalizeProxy::HandleReading(const detail::Reading& aReading) {
  const auto* reading = dynamic_cast<const sim::PoseReading*>(&aReading.measured);
  if (reading == nullptr) return;
  player_localize_hypoth_t hypoth = {};
  hypoth.mean = {reading->pose.x_m, reading->pose.y_m, reading->pose.yaw_rad};
  hypoth.cov[0] = mNoise_m * mNoise_m;
  hypoth.cov[1] = mNoise_m * mNoise_m;
  hypoth.cov[2] = mNoiseYaw_rad * mNoiseYaw_rad;
  hypoth.alpha = 1.0;
  mHypoths.assign(1, hypoth);
}

bool LocalizeProxy::IsCapable(uint32_t aType, uint32_t aSubtype) const {
  if (aType == PLAYER_MSGTYPE_DATA) return aSubtype == PLAYER_LOCALIZE_DATA_HYPOTHS;
  return aType == PLAYER_MSGTYPE_REQ && (aSubtype == PLAYER_LOCALIZE_REQ_SET_POSE ||
                                         aSubtype == PLAYER_LOCALIZE_REQ_GET_PARTICLES);
}

uint32_t LocalizeProxy::GetMapSizeX() const { return GetVar(0U); }
uint32_t LocalizeProxy::GetMapSizeY() const { return GetVar(0U); }
uint32_t LocalizeProxy::GetMapTileX() const { return GetVar(0U); }
uint32_t LocalizeProxy::GetMapTileY() const { return GetVar(0U); }
double LocalizeProxy::GetMapScale() const { return GetVar(0.0); }
uint32_t LocalizeProxy::GetPendingCount() const { return GetVar(0U); }

uint32_t LocalizeProxy::GetHypothCount() const {
  const scoped_lock_t lock(LockData("LocalizeProxy::GetHypothCount"));
  return static_cast<uint32_t>(mHypoths.size());
}

uint32_t LocalizeProxy::GetNumHypoths() const { return GetHypothCount(); }

player_localize_hypoth_t LocalizeProxy::GetHypoth(uint32_t aIndex) const {
  const char* fun = "LocalizeProxy::GetHypoth";
  const scoped_lock_t lock(LockData(fun));
  if (aIndex >= mHypoths.size()) {
    throw no_such(fun, "hypothesis", std::to_string(aIndex), mHypoths.size(), "Read()");
  }
  return mHypoths[aIndex];
}

int LocalizeProxy::GetParticles() {
  const scoped_lock_t lock(LockData("LocalizeProxy::GetParticles"));
  if (mHypoths.empty()) return -1;
  mParticles.assign(1, mHypoths.front().mean);
  return 0;
}

player_pose2d_t LocalizeProxy::GetParticlePose(int index) const {
  const char* fun = "LocalizeProxy::GetParticlePose";
  const scoped_lock_t lock(LockData(fun));
  if (index < 0 || static_cast<std::size_t>(index) >= mParticles.size()) {
    throw no_such(fun, "particle", std::to_string(index), mParticles.size(), "GetParticles()");
  }
  return mParticles[static_cast<std::size_t>(index)];
}

uint32_t LocalizeProxy::GetNumParticles() const {
  const scoped_lock_t lock(LockData("LocalizeProxy::GetNumParticles"));
  return static_cast<uint32_t>(mParticles.size());
}

void LocalizeProxy::SetPose(double pose[3], double cov[6]) {
  static_cast<void>(cov);
  const char* fun = "LocalizeProxy::SetPose";
  if (pose == nullptr) {
    throw PlayerError(fun, "the pose is a null pointer", PlayerError::kBadArgument);
  }
  playerlike::require_finite(
      fun, {{"the pose's x", pose[0]}, {"the pose's y", pose[1]}, {"the pose's yaw", pose[2]}});
  const scoped_lock_t lock(LockData(fun));
}

}  // namespace PlayerCc

namespace std {

std::ostream& operator<<(std::ostream& os, const PlayerCc::LocalizeProxy& c) {
  os << '#' << static_cast<const PlayerCc::ClientProxy&>(c)
     << "\n#weight\tx [m]\ty [m]\tyaw [rad]\n";
  for (uint32_t i = 0; i < c.GetHypothCount(); ++i) {
    const player_localize_hypoth_t hypoth = c.GetHypoth(i);
    os << hypoth.alpha << '\t' << hypoth.mean.px << '\t' << hypoth.mean.py << '\t' << hypoth.mean.pa
       << '\n';
  }
  return os;
}

}  // namespace std
