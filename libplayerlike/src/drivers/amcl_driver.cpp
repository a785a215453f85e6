// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <string_view>

#include "core/errors.h"
#include "drivers/amcl_thread.h"
#include "drivers/named_settings.h"
#include "libCCMorse/AmclDriver.h"
#include "playerlike/messages/driver_settings.h"
#include "proxies/link.h"
#include "session/player_values/localize.h"

namespace CCMorse {

using playerlike::AmclState;
using playerlike::translated;

namespace {

constexpr std::string_view kDeviationOfBoth = "init_pose_var";  // two numbers in world files

bool is_amcl_setting(const sim::Field& field) {
  const std::string_view name = field.name;
  return playerlike::is_number(field) && name != "frequency" && name != "map_resolution";
}

void require_possible(const char* fun, const sim::SetPoseCommand& command) {
  if (const auto fault = sim::fault_of(command)) playerlike::refuse(fun, *fault);
}

// The state, or an empty one before the first round.
const AmclState& known(const std::shared_ptr<const AmclState>& state) {
  static const AmclState kNothing;
  return state ? *state : kNothing;
}

}  // namespace

AmclDriver::AmclDriver(PlayerClient* aClient, uint32_t aOdometry, uint32_t aLaser,
                       double aMapResolution) {
  const char* fun = "AmclDriver::AmclDriver";
  if (aClient == nullptr) {
    playerlike::refuse(fun, "a driver needs a client, but it is a null pointer");
  }
  playerlike::require_finite(fun, {{"the map's resolution", aMapResolution}});
  mCore = PlayerCc::detail::CoreAccess::get(*aClient);
  translated(fun, [&] {
    mCore->require_usable();
    sim::AmclParams params;
    params.map_resolution_m = aMapResolution;
    mThread = std::make_unique<playerlike::AmclThread>(mCore->session().open_follower(),
                                                       static_cast<int>(aOdometry),
                                                       static_cast<int>(aLaser), params, fun);
  });
}

AmclDriver::~AmclDriver() = default;

void AmclDriver::SetPose(double aX, double aY, double aYaw) {
  const char* fun = "AmclDriver::SetPose";
  require_possible(fun, {{aX, aY, aYaw}});
  translated(fun, [&] {
    mCore->require_usable();
    mThread->set_pose({aX, aY, sim::normalize_angle(aYaw)}, {});
  });
}

void AmclDriver::SetPose(double aX, double aY, double aYaw, double aDeviation,
                         double aYawDeviation) {
  const char* fun = "AmclDriver::SetPose";
  playerlike::require_finite(
      fun, {{"the deviation of the position", aDeviation}, {"that of the yaw", aYawDeviation}});
  if (aDeviation < 0.0 || aYawDeviation < 0.0) {
    playerlike::refuse(fun, "a standard deviation must not be negative");
  }
  if (std::max(aDeviation, aYawDeviation) > sim::kFarthestPose) {
    playerlike::refuse(fun, "a standard deviation must be at most 1e9 m or rad");
  }
  const double variance_m2 = aDeviation * aDeviation;
  const std::array variance{variance_m2, variance_m2, aYawDeviation * aYawDeviation};
  require_possible(fun, {{aX, aY, aYaw}, variance});
  translated(fun, [&] {
    mCore->require_usable();
    mThread->set_pose({aX, aY, sim::normalize_angle(aYaw)}, sim::PoseCovariance{variance, {}});
  });
}

void AmclDriver::Spread() {
  translated("AmclDriver::Spread", [&] {
    mCore->require_usable();
    mThread->spread();
  });
}

uint32_t AmclDriver::GetHypothCount() const {
  return translated("AmclDriver::GetHypothCount", [&] {
    mCore->require_usable();
    return static_cast<uint32_t>(known(mThread->state()).hypotheses.size());
  });
}

player_localize_hypoth_t AmclDriver::GetHypoth(uint32_t aIndex) const {
  return translated("AmclDriver::GetHypoth", [&]() -> player_localize_hypoth_t {
    mCore->require_usable();
    const std::shared_ptr<const AmclState> state = mThread->state();
    if (aIndex >= known(state).hypotheses.size()) return {};
    return playerlike::hypothesis_of<player_localize_hypoth_t>(state->hypotheses[aIndex]);
  });
}

uint32_t AmclDriver::GetNumParticles() const {
  return translated("AmclDriver::GetNumParticles", [&] {
    mCore->require_usable();
    return static_cast<uint32_t>(known(mThread->state()).particles.size());
  });
}

player_pose2d_t AmclDriver::GetParticlePose(uint32_t aIndex) const {
  return translated("AmclDriver::GetParticlePose", [&]() -> player_pose2d_t {
    mCore->require_usable();
    const std::shared_ptr<const AmclState> state = mThread->state();
    if (aIndex >= known(state).particles.size()) return {};
    const sim::Pose& pose = state->particles[aIndex].pose;
    return {pose.x_m, pose.y_m, pose.yaw_rad};
  });
}

double AmclDriver::GetParticleWeight(uint32_t aIndex) const {
  return translated("AmclDriver::GetParticleWeight", [&] {
    mCore->require_usable();
    const std::shared_ptr<const AmclState> state = mThread->state();
    return aIndex < known(state).particles.size() ? state->particles[aIndex].weight : 0.0;
  });
}

uint64_t AmclDriver::GetUpdates() const {
  return translated("AmclDriver::GetUpdates", [&]() -> uint64_t {
    mCore->require_usable();
    return known(mThread->state()).updates;
  });
}

void AmclDriver::Set(const std::string& aName, double aValue) {
  const std::string fun = "AmclDriver::Set";
  const sim::FieldTable& table = sim::fields_of<sim::AmclParams>();
  sim::AmclParams params = mThread->params();
  if (aName == kDeviationOfBoth) {
    params.init_pose_deviation_m = {aValue, aValue};
    if (!(aValue >= 0.0 && aValue <= 1000.0)) {
      playerlike::refuse(fun, aName + " must be from 0 to 1000 m");
    }
  } else {
    playerlike::set_named(fun, table, is_amcl_setting, &params, aName, aValue);
  }
  const std::string fault = playerlike::fault_of(table, &params);
  if (!fault.empty()) playerlike::refuse(fun, fault);
  if (const auto error = sim::check_amcl(params)) {
    playerlike::refuse(fun,
                       "pf_max_samples must be " + error->expected + ", but is " + error->found);
  }
  translated(fun.c_str(), [&] {
    mCore->require_usable();
    mThread->set_params(params);
  });
}

double AmclDriver::Get(const std::string& aName) const {
  const sim::AmclParams params = mThread->params();
  if (aName == kDeviationOfBoth) return params.init_pose_deviation_m.x();
  return playerlike::get_named("AmclDriver::Get", sim::fields_of<sim::AmclParams>(),
                               is_amcl_setting, &params, aName);
}

}  // namespace CCMorse
