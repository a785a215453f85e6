// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <cstddef>
#include <ostream>
#include <string>

#include "devices/errors.h"
#include "libplayerc++/localizeproxy.h"
#include "proxies/link.h"
#include "session/player_values.h"
#include "sim/devices/localization.h"

namespace PlayerCc {

namespace {

player_pose2d_t mean_of(const sim::PoseReading& reading) {
  return {reading.pose.x_m, reading.pose.y_m, reading.pose.yaw_rad};
}

}  // namespace

LocalizeProxy::LocalizeProxy(PlayerClient* aPc, uint32_t aIndex) : ClientProxy(aPc, aIndex) {
  Attach(PLAYER_LOCALIZE_CODE, aIndex, "LocalizeProxy::LocalizeProxy");
}

LocalizeProxy::~LocalizeProxy() { ClientProxy::Unsubscribe(); }

uint32_t LocalizeProxy::GetMapSizeX() const { return GetVar(0U); }
uint32_t LocalizeProxy::GetMapSizeY() const { return GetVar(0U); }
uint32_t LocalizeProxy::GetMapTileX() const { return GetVar(0U); }
uint32_t LocalizeProxy::GetMapTileY() const { return GetVar(0U); }
double LocalizeProxy::GetMapScale() const { return GetVar(0.0); }
uint32_t LocalizeProxy::GetPendingCount() const { return GetVar(0U); }

uint32_t LocalizeProxy::GetHypothCount() const {
  const scoped_lock_t lock(LockData("LocalizeProxy::GetHypothCount"));
  return mLink->newest.find<sim::PoseReading>() == nullptr ? 0 : 1;
}

uint32_t LocalizeProxy::GetNumHypoths() const { return GetHypothCount(); }

player_localize_hypoth_t LocalizeProxy::GetHypoth(uint32_t aIndex) const {
  const char* fun = "LocalizeProxy::GetHypoth";
  const scoped_lock_t lock(LockData(fun));
  const auto* reading = mLink->newest.find<sim::PoseReading>();
  constexpr ElementWords kHypotheses{"hypothesis", "hypotheses"};
  if (!mLink->has_element(fun, kHypotheses, aIndex, reading == nullptr ? 0 : 1)) return {};
  return playerlike::hypothesis_of<player_localize_hypoth_t>(*reading, mLink->info().properties);
}

int LocalizeProxy::GetParticles() {
  const scoped_lock_t lock(LockData("LocalizeProxy::GetParticles"));
  const auto* reading = mLink->newest.find<sim::PoseReading>();
  if (reading == nullptr) return -1;
  mParticles.assign(1, mean_of(*reading));
  return 0;
}

player_pose2d_t LocalizeProxy::GetParticlePose(int index) const {
  const char* fun = "LocalizeProxy::GetParticlePose";
  const scoped_lock_t lock(LockData(fun));
  return mLink->element_or_zero(fun, {"particle", "particles"}, index, mParticles);
}

uint32_t LocalizeProxy::GetNumParticles() const {
  const scoped_lock_t lock(LockData("LocalizeProxy::GetNumParticles"));
  return static_cast<uint32_t>(mParticles.size());
}

void LocalizeProxy::SetPose(double pose[3], double cov[6]) {
  static_cast<void>(cov);
  const char* fun = "LocalizeProxy::SetPose";
  if (pose == nullptr) {
    playerlike::refuse(fun, "the pose is a null pointer");
  }
  playerlike::require_finite(
      fun, {{"the pose's x", pose[0]}, {"the pose's y", pose[1]}, {"the pose's yaw", pose[2]}});
  const scoped_lock_t lock(LockData(fun));
  // Simulated localisation knows the pose.
  if (mLink->property("accepts_pose", 0.0) == 0.0) return;
  mLink->send(fun, sim::SetPoseCommand{{pose[0], pose[1], sim::normalize_angle(pose[2])}});
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
