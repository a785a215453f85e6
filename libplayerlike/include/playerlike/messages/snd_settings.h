// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "sim/world/description.h"

namespace playerlike {

/// Settings of Smooth Nearness-Diagram navigation (docs/snd.md); ranges in snd_setting_table().
struct SndSettings {
  double robot_radius_m = 0.1;      ///< radius of a disc about the axle's centre that holds the
                                    ///< robot
  double safety_distance_m = 0.15;  ///< nearer obstacles deflect and slow the robot
  double max_speed_mps = 0.3;
  double max_turn_rate_radps = 1.5;
  double goal_distance_m = 0.05;  ///< tolerance of the goal's position
  double goal_angle_rad = 0.1;    ///< tolerance of the goal's heading
  double patience_s = 20.0;       ///< the goal counts as blocked after this time without progress
};

/// Returns the default settings of a driver for a robot. The robot radius is the radius of the
/// footprint, rounded up to whole centimetres. The safety distance is 1.5 times the robot radius.
/// The maximum speed is 0.6 times the maximum speed of the drive; the maximum turn rate is half of
/// the drive's. All other settings have the defaults of SndSettings. For an S1R the result equals
/// SndSettings{}.
/// @param radius_m  radius of the footprint around the middle of the axle [m]; 0 (unknown): the
///     S1R's.
/// @param max_speed_mps, max_turn_rate_radps  limits of the robot's drive; 0 (unknown): the S1R's.
[[nodiscard]] SndSettings snd_settings_for(double radius_m, double max_speed_mps,
                                           double max_turn_rate_radps);

/// Description of a setting: name and range.
struct SndSettingRow {
  const char* key;   ///< key in world files; a value whose key ends in "_deg" is in degrees there
  const char* unit;  ///< unit in world files, "m", "m/s", ...
  double SndSettings::*value;
  double above;    ///< exclusive lower bound [SI]
  double at_most;  ///< [SI]
};
/// Returns all settings, in the order of docs/snd.md.
[[nodiscard]] const std::vector<SndSettingRow>& snd_setting_table();

/// Returns the faults of settings, e.g. "robot_radius must be greater than 0 and at most 10 m, but
/// is -1"; empty if the settings are valid.
[[nodiscard]] std::string fault_of(const SndSettings& settings);

/// A driver of type "snd" in a world's `drivers` table.
struct SndDriverDescription {
  SndSettings settings;
  int index = -1;    ///< index of its position2d on the robot's port
  int position = 0;  ///< index of the position2d that measures the robot's pose
  int laser = 0;     ///< index of the laser
};

/// Reads the `drivers` of one robot; no other type than "snd" is known.
/// @param robot    in the world.
/// @param file     as messages call the world.
/// @param pointer  JSON pointer of the robot, e.g. "/robots/0".
/// @param defaults  values of the settings that the world omits, see snd_settings_for().
/// @throws sim::ConfigError with all that is wrong.
[[nodiscard]] std::vector<SndDriverDescription> read_drivers(const sim::RobotDescription& robot,
                                                             const std::string& file,
                                                             const std::string& pointer,
                                                             const SndSettings& defaults = {});

/// Checks the drivers of all robots.
/// @throws sim::ConfigError with all that is wrong.
void check_drivers(const sim::WorldDescription& world);

}  // namespace playerlike
