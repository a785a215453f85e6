// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "sim/core/fields.h"
#include "sim/world/description.h"

/// @file
/// Settings of the drivers that a world's `drivers` table can name. Each struct lists its fields
/// once, with units, ranges and meanings; world files, checks, the schema and the pages in docs
/// follow from that table. Angles are in degrees in world files, under keys that end in "_deg".
namespace playerlike {

struct RobotInfo;

/// What all drivers that drive to goals have in common.
struct DrivingLimits {
  double robot_radius_m = 0.0;  ///< of the disc around the axle's centre that contains the robot
  double max_speed_mps = 0.0;
  double max_turn_rate_radps = 0.0;
  double goal_distance_m = 0.0;  ///< tolerance of the goal's position
  double goal_angle_rad = 0.0;   ///< tolerance of the goal's heading
  double patience_s = 0.0;       ///< blocked after this time without progress
};

/// Settings of Smooth Nearness-Diagram navigation (docs/snd.md).
struct SndSettings {
  double robot_radius_m = 0.1;      ///< radius of a disc about the axle's centre that holds the
                                    ///< robot
  double safety_distance_m = 0.15;  ///< nearer obstacles deflect and slow the robot
  double max_speed_mps = 0.3;
  double max_turn_rate_radps = 1.5;
  double goal_distance_m = 0.05;  ///< tolerance of the goal's position
  double goal_angle_rad = 0.1;    ///< tolerance of the goal's heading
  double patience_s = 20.0;       ///< the goal counts as blocked after this time without progress

  [[nodiscard]] DrivingLimits limits() const;
  /// Lowers the limits of speed.
  void slow_down(double max_speed_mps, double max_turn_rate_radps);
};

/// Settings of VFH+ (docs/vfh.md), with the names and defaults of Player's driver `vfh`. Pairs
/// "0ms", "1ms" are values at 0 and at 1 m/s, between which the driver interpolates.
struct VfhSettings {
  double robot_radius_m = 0.1;
  double cell_size_m = 0.1;                       ///< of the local map
  int window_diameter = 61;                       ///< of the local map [cells]
  double sector_angle_rad = 0.08726646259971647;  ///< of the histogram; 5 degrees
  double safety_dist_0ms_m = 0.1;
  std::optional<double> safety_dist_1ms_m;  ///< none: as at 0 m/s
  double max_speed_mps = 0.2;
  std::optional<double> max_speed_narrow_opening_mps;  ///< none: max_speed
  std::optional<double> max_speed_wide_opening_mps;    ///< none: max_speed
  double max_acceleration_mps2 = 0.2;
  double min_turnrate_radps = 0.17453292519943295;     ///< 10 degrees/s
  double max_turnrate_0ms_radps = 0.6981317007977318;  ///< 40 degrees/s
  std::optional<double> max_turnrate_1ms_radps;        ///< none: as at 0 m/s
  double min_turn_radius_safety_factor = 1.0;
  double free_space_cutoff_0ms = 2e6;
  std::optional<double> free_space_cutoff_1ms;  ///< none: as at 0 m/s
  std::optional<double> obs_cutoff_0ms;         ///< none: free_space_cutoff_0ms
  std::optional<double> obs_cutoff_1ms;         ///< none: free_space_cutoff_1ms
  double weight_desired_dir = 5.0;
  double weight_current_dir = 3.0;
  double distance_epsilon_m = 0.5;
  double angle_epsilon_rad = 0.17453292519943295;  ///< 10 degrees
  double patience_s = 20.0;

  [[nodiscard]] DrivingLimits limits() const;
  void slow_down(double max_speed_mps, double max_turn_rate_radps);
};

/// Settings of Nearness-Diagram navigation (docs/nd.md), with the names and defaults of Player's
/// driver `nd`.
struct NdSettings {
  double robot_radius_m = 0.1;
  double goal_tol_m = 0.5;
  double goal_tol_angle_rad = 0.17453292519943295;  ///< 10 degrees
  double max_speed_mps = 0.3;
  double max_turnrate_radps = 0.7853981633974483;  ///< 45 degrees/s
  double min_speed_mps = 0.05;
  double min_turnrate_radps = 0.17453292519943295;  ///< 10 degrees/s
  double avoid_dist_m = 0.5;
  double safety_dist_m = 0.0;
  double rotate_stuck_time_s = 2.0;
  double translate_stuck_time_s = 2.0;
  double translate_stuck_dist_m = 0.25;
  double translate_stuck_angle_rad = 0.3490658503988659;  ///< 20 degrees
  double patience_s = 20.0;

  [[nodiscard]] DrivingLimits limits() const;
  void slow_down(double max_speed_mps, double max_turn_rate_radps);
};

/// Settings of the driver that drives straight to goals (docs/drivers.md), with the names and
/// defaults of Player's driver `goto`.
struct GotoSettings {
  double dist_tol_m = 0.04;
  double angle_tol_rad = 0.05235987755982989;  ///< 3 degrees
  double max_vel_mps = 0.7;
  double min_vel_mps = 0.1;
  double max_angular_vel_radps = 0.7853981633974483;   ///< 45 degrees/s
  double min_angular_vel_radps = 0.17453292519943295;  ///< 10 degrees/s
  double patience_s = 20.0;

  [[nodiscard]] DrivingLimits limits() const;
  void slow_down(double max_speed_mps, double max_turn_rate_radps);
};

/// Settings of any driver that drives to goals.
using GoalDriverSettings = std::variant<SndSettings, VfhSettings, NdSettings, GotoSettings>;
using GoalDriverKind = sim::AlternativeKind<GoalDriverSettings>;  ///< a type of goal driver

/// The drivers that drive to goals, in the order of GoalDriverSettings: type in world files and
/// table of settings.
[[nodiscard]] const std::array<GoalDriverKind, std::variant_size_v<GoalDriverSettings>>&
goal_driver_kinds();

/// Returns the default settings of a kind of driver for a robot. SND: see snd_settings_for(). VFH+
/// and ND: the robot radius is the radius of the footprint, rounded up to whole centimetres.
/// @param radius_m  radius of the footprint around the middle of the axle [m]; 0 (unknown): the
///     S1R's.
/// @param max_speed_mps, max_turn_rate_radps  limits of the robot's drive; 0 (unknown): the S1R's.
template <typename Settings>
[[nodiscard]] Settings default_settings(double radius_m, double max_speed_mps,
                                        double max_turn_rate_radps);
template <>
[[nodiscard]] SndSettings default_settings<SndSettings>(double, double, double);  ///< of snd
template <>
[[nodiscard]] VfhSettings default_settings<VfhSettings>(double, double, double);  ///< of vfh
template <>
[[nodiscard]] NdSettings default_settings<NdSettings>(double, double, double);  ///< of nd
template <>
[[nodiscard]] GotoSettings default_settings<GotoSettings>(double, double, double);  ///< of goto

/// Returns the default settings of SND for a robot. The robot radius is the radius of the
/// footprint, rounded up to whole centimetres. The safety distance is 1.5 times the robot radius.
/// The maximum speed is 0.6 times the maximum speed of the drive; the maximum turn rate is half of
/// the drive's. All other settings have the defaults of SndSettings. For an S1R the result equals
/// SndSettings{}. Parameters as of default_settings().
[[nodiscard]] inline SndSettings snd_settings_for(double radius_m, double max_speed_mps,
                                                  double max_turn_rate_radps) {
  return default_settings<SndSettings>(radius_m, max_speed_mps, max_turn_rate_radps);
}

/// The unit of a setting in world files, in SI units: that of angles is a degree.
[[nodiscard]] double unit_of_setting(const sim::Field& field);

/// Returns the faults of settings, e.g. "robot_radius must be greater than 0 and at most 10 m, but
/// is -1"; empty if the settings are valid.
/// @param settings  a struct with the fields of `table`.
[[nodiscard]] std::string fault_of(const sim::FieldTable& table, const void* settings);
template <typename Settings>
[[nodiscard]] std::string fault_of(const Settings& settings) {  ///< the same for a struct
  return fault_of(sim::fields_of<Settings>(), &settings);
}

/// A driver of a world's `drivers` table that drives to goals: a further position2d.
struct GoalDriverInfo {
  GoalDriverSettings settings;
  int index = -1;    ///< index of its position2d on the robot's port
  int position = 0;  ///< index of the position2d that measures the robot's pose
  int laser = 0;     ///< index of the laser

  /// Its type in world files, e.g. "snd".
  [[nodiscard]] const char* type() const { return goal_driver_kinds()[settings.index()].name; }
};

/// Settings of the path planner `wavefront` (docs/wavefront.md), with the names and defaults of
/// Player's driver of that name.
struct WavefrontSettings {
  double robot_radius_m = 0.1;
  double safety_dist_m = 0.25;
  double max_radius_m = 1.0;
  double dist_penalty = 1.0;
  double distance_epsilon_m = 0.5;
  double angle_epsilon_rad = 0.17453292519943295;  ///< 10 degrees
  double replan_dist_thresh_m = 2.0;               ///< negative: plans once only
  double replan_min_time_s = 2.0;                  ///< negative: plans once only
  double cell_size_m = 0.05;                       ///< of the map
  int position = 0;   ///< index of the position2d whose pose is in the world's frame
  int localize = -1;  ///< index of the localize used instead; negative: none
  int output = -1;    ///< index of the position2d that gets the waypoints; negative: the robot's
                      ///< first driver, else `position`
  bool draw = true;   ///< whether the path is drawn on a layer
};
/// Of wavefront.
template <>
[[nodiscard]] WavefrontSettings default_settings<WavefrontSettings>(double, double, double);

/// A planner of a world's `drivers` table.
struct PlannerInfo {
  WavefrontSettings settings;
  int index = -1;  ///< index of its planner on the robot's port

  [[nodiscard]] static const char* type() { return "wavefront"; }
};

/// Settings of `lasercspace` (docs/lasercspace.md), with the names and defaults of Player's driver.
struct CspaceSettings {
  double radius_m = 0.5;  ///< of the robot
  int step = 1;           ///< every n-th beam counts as an obstacle
};

/// Settings of `laserposeinterpolator` (docs/drivers.md), with the names and defaults of Player's
/// driver.
struct PoseInterpolatorSettings {
  int position = 0;         ///< index of the position2d that gives the poses
  bool interpolate = true;  ///< false: each scan has the newest pose
};

/// Settings of any driver that makes other scans of a laser's.
using ScanDriverSettings = std::variant<CspaceSettings, PoseInterpolatorSettings>;
using ScanDriverKind = sim::AlternativeKind<ScanDriverSettings>;  ///< a type of such a driver

/// The drivers that make scans, in the order of ScanDriverSettings.
[[nodiscard]] const std::array<ScanDriverKind, std::variant_size_v<ScanDriverSettings>>&
scan_driver_kinds();

/// A driver of a world's `drivers` table that makes scans: a further laser.
struct ScanDriverInfo {
  ScanDriverSettings settings;
  int index = -1;  ///< index of its laser on the robot's port
  int laser = 0;   ///< index of the laser that measures

  /// Its type in world files, e.g. "lasercspace".
  [[nodiscard]] const char* type() const { return scan_driver_kinds()[settings.index()].name; }
};

/// Parses the drivers of one robot: fills `goal_drivers`, `planners` and `scan_drivers` from
/// `drivers`.
/// @param robot    its devices, drivers, radius and speeds are set.
/// @param file     as messages call the world.
/// @param pointer  JSON pointer of the robot, e.g. "/robots/0".
/// @throws sim::ConfigError with all that is wrong.
void read_drivers(RobotInfo& robot, const std::string& file, const std::string& pointer);

/// Checks the drivers of all robots.
/// @throws sim::ConfigError with all that is wrong.
void check_drivers(const sim::WorldDescription& world);

/// What a driver gives its robot.
enum class DriverUse {
  kDrives,    ///< a position2d that drives to goals; further settings: index, position, laser
  kPlans,     ///< a planner; further setting: index
  kScans,     ///< a laser; further settings: index, laser
  kConverts,  ///< nothing: every robot has both interfaces; further setting: laser
};

/// The types of drivers that a world can name, with their tables of settings.
struct DriverType {
  std::string name;
  const sim::FieldTable* settings;
  DriverUse use;
};
[[nodiscard]] const std::vector<DriverType>& driver_types();  ///< all types of drivers

}  // namespace playerlike
