// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <cstddef>
#include <string>
#include <vector>

#include "devices/errors.h"
#include "drivers/snd_thread.h"
#include "libCCMorse/SndDriver.h"
#include "proxies/link.h"

namespace CCMorse {

using playerlike::SndState;
using playerlike::translated;

namespace {

playerlike::SndSettings checked(const char* fun, const SndSettings& s) {
  const playerlike::SndSettings settings{.robot_radius_m = s.robot_radius,
                                         .safety_distance_m = s.safety_distance,
                                         .max_speed_mps = s.max_speed,
                                         .max_turn_rate_radps = s.max_turn_rate,
                                         .goal_distance_m = s.goal_distance,
                                         .goal_angle_rad = s.goal_angle,
                                         .patience_s = s.patience};
  const std::string fault = playerlike::fault_of(settings);
  if (!fault.empty()) playerlike::refuse(fun, fault);
  return settings;
}

// Replaces the settings that are SND_FROM_ROBOT by values from the robot's model.
SndSettings filled(SndSettings settings, const SndSettings& of_robot) {
  for (double SndSettings::*value : {&SndSettings::robot_radius, &SndSettings::safety_distance,
                                     &SndSettings::max_speed, &SndSettings::max_turn_rate}) {
    if (settings.*value == SND_FROM_ROBOT) settings.*value = of_robot.*value;
  }
  return settings;
}

SndSettings in_players_form(const playerlike::SndSettings& s) {
  SndSettings settings;
  settings.robot_radius = s.robot_radius_m;
  settings.safety_distance = s.safety_distance_m;
  settings.max_speed = s.max_speed_mps;
  settings.max_turn_rate = s.max_turn_rate_radps;
  settings.goal_distance = s.goal_distance_m;
  settings.goal_angle = s.goal_angle_rad;
  settings.patience = s.patience_s;
  return settings;
}

// Default settings for the robot of a position2d device.
SndSettings of_robot(playerlike::ClientCore& core, uint32_t position) {
  const std::vector<playerlike::RobotInfo>& robots = core.session().robots();
  const playerlike::InterfaceBinding binding = playerlike::find_interface(
      robots, core.session().port(), "position2d", static_cast<int>(position));
  if (binding.robot < 0) return in_players_form({});
  const playerlike::RobotInfo& robot = robots.at(static_cast<std::size_t>(binding.robot));
  return in_players_form(
      playerlike::snd_settings_for(robot.radius_m, robot.max_speed_mps, robot.max_turn_rate_radps));
}

}  // namespace

SndDriver::SndDriver(PlayerClient* aClient, uint32_t aPosition, uint32_t aLaser,
                     const SndSettings& aSettings)
    : mPosition(aPosition) {
  const char* fun = "SndDriver::SndDriver";
  if (aClient == nullptr) {
    playerlike::refuse(fun, "a driver needs a client, but it is a null pointer");
  }
  mCore = PlayerCc::detail::CoreAccess::get(*aClient);
  translated(fun, [&] {
    mCore->require_usable();
    const playerlike::SndSettings settings =
        checked(fun, filled(aSettings, of_robot(*mCore, aPosition)));
    mThread = std::make_unique<playerlike::SndThread>(mCore->session().open_follower(),
                                                      static_cast<int>(aPosition),
                                                      static_cast<int>(aLaser), settings);
  });
}

SndDriver::~SndDriver() = default;

void SndDriver::SetGoal(double aX, double aY) {
  const char* fun = "SndDriver::SetGoal";
  playerlike::require_finite(fun, {{"the goal's x", aX}, {"the goal's y", aY}});
  translated(fun, [&] {
    mCore->require_usable();
    mThread->go_to({{aX, aY}, {}, {}, {}});
  });
}

void SndDriver::SetGoal(double aX, double aY, double aYaw) {
  const char* fun = "SndDriver::SetGoal";
  playerlike::require_finite(
      fun, {{"the goal's x", aX}, {"the goal's y", aY}, {"the goal's heading", aYaw}});
  translated(fun, [&] {
    mCore->require_usable();
    mThread->go_to({{aX, aY}, sim::normalize_angle(aYaw), {}, {}});
  });
}

void SndDriver::Cancel() {
  translated("SndDriver::Cancel", [&] {
    mCore->require_usable();
    mThread->cancel();
    playerlike::Session& session = mCore->session();
    const playerlike::InterfaceBinding binding = playerlike::find_interface(
        session.robots(), session.port(), "position2d", static_cast<int>(mPosition));
    session.send(binding.motion.value(), sim::TwistCommand{});
  });
}

SndDriver::Status SndDriver::GetStatus() const {
  return translated("SndDriver::GetStatus", [&] {
    mCore->require_usable();
    switch (mThread->state()) {
      case SndState::kIdle:
        break;
      case SndState::kMoving:
        return MOVING;
      case SndState::kReached:
        return REACHED;
      case SndState::kBlocked:
        return BLOCKED;
    }
    return IDLE;
  });
}

SndDriver::Status SndDriver::WaitForGoal(double aTimeout) {
  const char* fun = "SndDriver::WaitForGoal";
  playerlike::require_finite(fun, {{"the timeout", aTimeout}});
  return translated(fun, [&] {
    const auto now_s = [&] {
      return sim::to_seconds(mCore->session().request(playerlike::TimeRequest{}).sim_time_ns);
    };
    const double start_s = now_s();
    Status status = GetStatus();
    while (status == MOVING && (aTimeout < 0.0 || now_s() - start_s < aTimeout)) {
      mCore->read();
      status = GetStatus();
    }
    return status;
  });
}

SndSettings SndDriver::GetSettings() const { return in_players_form(mThread->settings()); }

void SndDriver::SetSettings(const SndSettings& aSettings) {
  translated("SndDriver::SetSettings",
             [&] { Apply(filled(aSettings, of_robot(*mCore, mPosition))); });
}

// Each setting must be in its range.
void SndDriver::Apply(const SndSettings& aSettings) {
  const char* fun = "SndDriver::SetSettings";
  const playerlike::SndSettings settings = checked(fun, aSettings);
  translated(fun, [&] {
    mCore->require_usable();
    mThread->set_settings(settings);
  });
}

void SndDriver::SetRobotRadius(double aRadius) {
  SndSettings settings = GetSettings();
  settings.robot_radius = aRadius;
  Apply(settings);
}

void SndDriver::SetSafetyDistance(double aDistance) {
  SndSettings settings = GetSettings();
  settings.safety_distance = aDistance;
  Apply(settings);
}

void SndDriver::SetSpeedLimits(double aSpeed, double aTurnRate) {
  SndSettings settings = GetSettings();
  settings.max_speed = aSpeed;
  settings.max_turn_rate = aTurnRate;
  Apply(settings);
}

void SndDriver::SetGoalTolerances(double aDistance, double aAngle) {
  SndSettings settings = GetSettings();
  settings.goal_distance = aDistance;
  settings.goal_angle = aAngle;
  Apply(settings);
}

void SndDriver::SetPatience(double aSeconds) {
  SndSettings settings = GetSettings();
  settings.patience = aSeconds;
  Apply(settings);
}

}  // namespace CCMorse
