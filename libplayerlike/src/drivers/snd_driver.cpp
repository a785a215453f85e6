// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include <string>
#include <variant>

#include "core/client_core.h"
#include "core/errors.h"
#include "drivers/local_driver_start.h"
#include "libCCMorse/SndDriver.h"

namespace CCMorse {

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

// Default settings for a robot; null: unknown.
SndSettings of_robot(const playerlike::RobotInfo* robot) {
  return in_players_form(robot == nullptr
                             ? playerlike::SndSettings{}
                             : playerlike::snd_settings_for(robot->radius_m, robot->max_speed_mps,
                                                            robot->max_turn_rate_radps));
}

}  // namespace

SndDriver::SndDriver(PlayerClient* aClient, uint32_t aPosition, uint32_t aLaser,
                     const SndSettings& aSettings)
    : LocalDriver("SndDriver", aClient, aPosition, aLaser,
                  {[&](const playerlike::RobotInfo* robot) {
                    return playerlike::GoalDriverSettings(
                        checked("SndDriver::SndDriver", filled(aSettings, of_robot(robot))));
                  }}) {}

SndSettings SndDriver::GetSettings() const {
  return in_players_form(std::get<playerlike::SndSettings>(mThread->settings()));
}

void SndDriver::SetSettings(const SndSettings& aSettings) {
  translated("SndDriver::SetSettings", [&] {
    Apply(filled(aSettings, of_robot(playerlike::robot_of_position(*mCore, mPosition))));
  });
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
