// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cstddef>
#include <ostream>
#include <string>

#include "core/errors.h"
#include "libplayerc++/localizeproxy.h"
#include "proxies/link.h"
#include "session/player_values/localize.h"
#include "sim/devices/amcl.h"
#include "sim/devices/localization.h"

namespace PlayerCc {

namespace {

using sim::AmclReading;
using sim::PoseReading;

/// Number of hypotheses in the newest reading, which is that of a filter or a measured pose.
uint32_t count_of(const playerlike::Newest& newest) {
  if (const auto* reading = newest.find<AmclReading>()) {
    return static_cast<uint32_t>(reading->hypotheses.size());
  }
  return newest.find<PoseReading>() == nullptr ? 0 : 1;
}

}  // namespace

LocalizeProxy::LocalizeProxy(PlayerClient* aPc, uint32_t aIndex) : ClientProxy(aPc, aIndex) {
  Attach(PLAYER_LOCALIZE_CODE, aIndex, "LocalizeProxy::LocalizeProxy");
}

LocalizeProxy::~LocalizeProxy() { ClientProxy::Unsubscribe(); }

uint32_t LocalizeProxy::GetMapSizeX() const { return Look(&AmclReading::map_width); }
uint32_t LocalizeProxy::GetMapSizeY() const { return Look(&AmclReading::map_height); }
uint32_t LocalizeProxy::GetMapTileX() const { return GetVar(0U); }
uint32_t LocalizeProxy::GetMapTileY() const { return GetVar(0U); }
double LocalizeProxy::GetMapScale() const { return Look(&AmclReading::map_resolution_m); }
uint32_t LocalizeProxy::GetPendingCount() const { return Look(&AmclReading::pending); }

uint32_t LocalizeProxy::GetHypothCount() const {
  const scoped_lock_t lock(LockData("LocalizeProxy::GetHypothCount"));
  return count_of(mLink->newest);
}

uint32_t LocalizeProxy::GetNumHypoths() const { return GetHypothCount(); }

player_localize_hypoth_t LocalizeProxy::GetHypoth(uint32_t aIndex) const {
  const char* fun = "LocalizeProxy::GetHypoth";
  const scoped_lock_t lock(LockData(fun));
  constexpr ElementWords kHypotheses{"hypothesis", "hypotheses"};
  if (!mLink->has_element(fun, kHypotheses, aIndex, count_of(mLink->newest))) return {};
  if (const auto* reading = mLink->newest.find<AmclReading>()) {
    return playerlike::hypothesis_of<player_localize_hypoth_t>(reading->hypotheses[aIndex]);
  }
  return playerlike::hypothesis_of<player_localize_hypoth_t>(*mLink->newest.find<PoseReading>(),
                                                             mLink->info().properties);
}

int LocalizeProxy::GetParticles() {
  const char* fun = "LocalizeProxy::GetParticles";
  const scoped_lock_t lock(LockData(fun));
  if (const auto* reading = mLink->newest.find<PoseReading>()) {
    mParticles.assign(1, playerlike::to_players<player_pose2d_t>(reading->pose));
    mWeights.assign(1, 1.0);
    return 0;
  }
  if (mLink->newest.find<AmclReading>() == nullptr) return -1;
  playerlike::translated(fun, [&] {
    const auto particles =
        mLink->core->session().request(playerlike::ParticlesRequest{mLink->binding.reading});
    mParticles.clear();
    mWeights.clear();
    for (const playerlike::LocalizationParticle& particle : particles) {
      mParticles.push_back(playerlike::to_players<player_pose2d_t>(particle.pose));
      mWeights.push_back(particle.weight);
    }
  });
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

double LocalizeProxy::GetParticleWeight(int index) const {
  const char* fun = "LocalizeProxy::GetParticleWeight";
  const scoped_lock_t lock(LockData(fun));
  return mLink->element_or_zero(fun, {"particle", "particles"}, index, mWeights);
}

void LocalizeProxy::TellPose(const double* aPose, const double* aCovariance, std::size_t aCount) {
  const char* fun = "LocalizeProxy::SetPose";
  if (aPose == nullptr) playerlike::refuse(fun, "the pose is a null pointer");
  playerlike::require_finite(
      fun, {{"the pose's x", aPose[0]}, {"the pose's y", aPose[1]}, {"the pose's yaw", aPose[2]}});
  const bool has_variances = aCovariance != nullptr;
  if (has_variances && aCount < 3) {
    playerlike::refuse(
        fun, "the covariance must have 3 or 6 numbers, but has " + std::to_string(aCount));
  }
  const scoped_lock_t lock(mLink->lock_for_command(fun));
  if (mLink->info().type != "amcl") return;  // the arena's localisation knows the pose
  const sim::Pose pose{aPose[0], aPose[1], sim::normalize_angle(aPose[2])};
  if (!has_variances) return mLink->send(fun, sim::SetPoseCommand{pose});
  std::array<double, 6> covariance{};
  std::copy_n(aCovariance, aCount < covariance.size() ? 3 : covariance.size(), covariance.begin());
  const sim::SetPoseCommand command = playerlike::set_pose_command(pose, covariance);
  if (const auto fault = sim::fault_of(command)) {
    playerlike::refuse(
        fun,
        *fault + "; the first three numbers of a covariance are the variances of x, y and yaw");
  }
  mLink->send(fun, command);
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
