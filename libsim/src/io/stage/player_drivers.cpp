// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "io/stage/player_drivers.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <string>
#include <vector>

#include "io/document.h"
#include "sim/io/player_options.h"

namespace sim::io::stage {
namespace {

enum class Unit : char {
  kLength = 'l',
  kAngle = 'a',   ///< degrees in worlds
  kNumber = 'f',  ///< also an angle that Player reads as a plain number of degrees
  kWhole = 'i',
  kFlag = 'b',     ///< 0 or 1 in Player
  kHeading = 'h',  ///< a difference of headings, in degrees: 180 is any
};

/// An option of Player's driver and the setting of Playpen's that means the same.
struct Option {
  std::string_view driver;
  std::string_view name;  ///< Player's
  std::size_t element;    ///< of a tuple; 0 also for a single number
  const char* setting;
  Unit unit;
};

// From the documentation of Player 3's drivers.
constexpr Option kOptions[] = {
    {"snd", "robot_radius", 0, "robot_radius", Unit::kLength},
    {"snd", "obstacle_avoid_dist", 0, "safety_distance", Unit::kLength},
    {"snd", "max_speed", 0, "max_speed", Unit::kLength},
    {"snd", "max_turn_rate", 0, "max_turn_rate_deg", Unit::kAngle},
    {"snd", "goal_position_tol", 0, "goal_distance", Unit::kLength},
    {"snd", "goal_angle_tol", 0, "goal_angle_deg", Unit::kHeading},
    {"vfh", "robot_radius", 0, "robot_radius", Unit::kLength},
    {"vfh", "cell_size", 0, "cell_size", Unit::kLength},
    {"vfh", "window_diameter", 0, "window_diameter", Unit::kWhole},
    {"vfh", "sector_angle", 0, "sector_angle_deg", Unit::kNumber},
    {"vfh", "safety_dist_0ms", 0, "safety_dist_0ms", Unit::kLength},
    {"vfh", "safety_dist_1ms", 0, "safety_dist_1ms", Unit::kLength},
    {"vfh", "max_speed", 0, "max_speed", Unit::kLength},
    {"vfh", "max_speed_narrow_opening", 0, "max_speed_narrow_opening", Unit::kLength},
    {"vfh", "max_speed_wide_opening", 0, "max_speed_wide_opening", Unit::kLength},
    {"vfh", "max_acceleration", 0, "max_acceleration", Unit::kLength},
    {"vfh", "min_turnrate", 0, "min_turnrate_deg", Unit::kAngle},
    {"vfh", "max_turnrate_0ms", 0, "max_turnrate_0ms_deg", Unit::kAngle},
    {"vfh", "max_turnrate_1ms", 0, "max_turnrate_1ms_deg", Unit::kAngle},
    {"vfh", "min_turn_radius_safety_factor", 0, "min_turn_radius_safety_factor", Unit::kNumber},
    {"vfh", "free_space_cutoff_0ms", 0, "free_space_cutoff_0ms", Unit::kNumber},
    {"vfh", "free_space_cutoff_1ms", 0, "free_space_cutoff_1ms", Unit::kNumber},
    {"vfh", "obs_cutoff_0ms", 0, "obs_cutoff_0ms", Unit::kNumber},
    {"vfh", "obs_cutoff_1ms", 0, "obs_cutoff_1ms", Unit::kNumber},
    {"vfh", "weight_desired_dir", 0, "weight_desired_dir", Unit::kNumber},
    {"vfh", "weight_current_dir", 0, "weight_current_dir", Unit::kNumber},
    {"vfh", "distance_epsilon", 0, "distance_epsilon", Unit::kLength},
    {"vfh", "angle_epsilon", 0, "angle_epsilon_deg", Unit::kHeading},
    {"nd", "goal_tol", 0, "goal_tol", Unit::kLength},
    {"nd", "goal_tol", 1, "goal_tol_angle_deg", Unit::kHeading},
    {"nd", "max_speed", 0, "max_speed", Unit::kLength},
    {"nd", "max_speed", 1, "max_turnrate_deg", Unit::kAngle},
    {"nd", "min_speed", 0, "min_speed", Unit::kLength},
    {"nd", "min_speed", 1, "min_turnrate_deg", Unit::kAngle},
    {"nd", "avoid_dist", 0, "avoid_dist", Unit::kLength},
    {"nd", "safety_dist", 0, "safety_dist", Unit::kLength},
    {"nd", "rotate_stuck_time", 0, "rotate_stuck_time", Unit::kNumber},
    {"nd", "translate_stuck_time", 0, "translate_stuck_time", Unit::kNumber},
    {"nd", "translate_stuck_dist", 0, "translate_stuck_dist", Unit::kLength},
    {"nd", "translate_stuck_angle", 0, "translate_stuck_angle_deg", Unit::kAngle},
    {"goto", "dist_tol", 0, "dist_tol", Unit::kNumber},
    {"goto", "angle_tol", 0, "angle_tol_deg", Unit::kHeading},
    {"goto", "max_vel", 0, "max_vel", Unit::kNumber},
    {"goto", "min_vel", 0, "min_vel", Unit::kNumber},
    {"goto", "max_angular_vel", 0, "max_angular_vel_deg", Unit::kNumber},
    {"goto", "min_angular_vel", 0, "min_angular_vel_deg", Unit::kNumber},
    {"wavefront", "safety_dist", 0, "safety_dist", Unit::kLength},
    {"wavefront", "max_radius", 0, "max_radius", Unit::kLength},
    {"wavefront", "dist_penalty", 0, "dist_penalty", Unit::kNumber},
    {"wavefront", "distance_epsilon", 0, "distance_epsilon", Unit::kLength},
    {"wavefront", "angle_epsilon", 0, "angle_epsilon_deg", Unit::kHeading},
    {"wavefront", "replan_dist_thresh", 0, "replan_dist_thresh", Unit::kLength},
    {"wavefront", "replan_min_time", 0, "replan_min_time", Unit::kNumber},
    {"amcl", "update_thresh", 0, "update_thresh", Unit::kLength},
    {"amcl", "update_thresh", 1, "update_thresh_yaw_deg", Unit::kAngle},
    {"amcl", "pf_min_samples", 0, "pf_min_samples", Unit::kWhole},
    {"amcl", "pf_max_samples", 0, "pf_max_samples", Unit::kWhole},
    {"amcl", "pf_err", 0, "pf_err", Unit::kNumber},
    {"amcl", "pf_z", 0, "pf_z", Unit::kNumber},
    {"amcl", "laser_max_beams", 0, "laser_max_beams", Unit::kWhole},
    {"amcl", "laser_range_var", 0, "laser_range_var", Unit::kLength},
    {"amcl", "laser_range_bad", 0, "laser_range_bad", Unit::kNumber},
    {"amcl", "init_pose_var", 2, "init_pose_var_yaw_deg", Unit::kAngle},
    {"lasercspace", "radius", 0, "radius", Unit::kLength},
    {"lasercspace", "step", 0, "step", Unit::kWhole},
    {"laserposeinterpolator", "interpolate", 0, "interpolate", Unit::kFlag},
};

/// An option of Player's driver, or of all drivers, that does not exist here.
struct Absent {
  std::string_view driver;  ///< "": all
  std::string_view name;
  const char* instead;
};

constexpr const char* kIndices =
    "the indexes of devices are \"index\", \"position\", \"laser\" and \"output\"";
constexpr const char* kPatience = "the driver stops after \"patience\"";
constexpr const char* kLaserOnly = "the driver uses a laser only";
constexpr const char* kLocalDriver = "the driver of \"output\" drives and avoids obstacles";
constexpr const char* kAllScans = "all scans are sent";
constexpr const char* kNothing = "";

constexpr Absent kAbsent[] = {
    {"", "provides", kIndices},
    {"", "requires", kIndices},
    {"", "alwayson", "drivers start when a program uses them"},
    {"snd", "min_gap_width", "the driver fits \"robot_radius\" through gaps"},
    {"vfh", "escape_speed", kPatience},
    {"vfh", "escape_time", kPatience},
    {"vfh", "escape_max_turnrate", kPatience},
    {"vfh", "synchronous", "the driver uses each scan"},
    {"nd", "wait_on_stall", kNothing},
    {"nd", "laser_buffer", "points of earlier scans are kept for 60 s"},
    {"nd", "sonar_buffer", kLaserOnly},
    {"nd", "sonar_bad_transducers", kLaserOnly},
    {"goto", "reactive", kPatience},
    {"goto", "reaction_turn_vel", kPatience},
    {"goto", "reaction_time", kPatience},
    {"goto", "forward_enabled", "commands are always forwarded"},
    {"goto", "max_dist", kNothing},
    {"goto", "early_check", kNothing},
    {"goto", "send_everything", kNothing},
    {"goto", "debug", kNothing},
    {"wavefront", "cspace_file", "planning takes milliseconds"},
    {"wavefront", "add_rotational_waypoints", "drivers turn on the spot by themselves"},
    {"wavefront", "force_map_refresh", "the map is read once"},
    {"wavefront", "request_map", "the map is read once"},
    {"wavefront", "update_rate", "the planner uses each pose"},
    {"wavefront", "velocity_control", kLocalDriver},
    {"wavefront", "control_tv", kLocalDriver},
    {"wavefront", "control_av", kLocalDriver},
    {"wavefront", "control_a", kLocalDriver},
    {"amcl", "odom_drift", "the odometry model is \"odom_alpha1\" to \"odom_alpha4\""},
    {"amcl", "odom_init", "\"odometry\" names the device"},
    {"amcl", "laser_pose", "it is the mount of the laser"},
    {"amcl", "laser_range_max", "it is the range of the laser"},
    {"amcl", "enable_gui", "pictures show the particles"},
    {"laserposeinterpolator", "max_scans", "at most 100 scans wait"},
    {"laserposeinterpolator", "update_thresh", kAllScans},
    {"laserposeinterpolator", "update_interval", kAllScans},
    {"laserposeinterpolator", "send_all_scans", kAllScans},
};

constexpr std::string_view kGoalDrivers[] = {"snd", "vfh", "nd", "goto"};

/// Options without an effect on what a driver does here.
bool is_ignored(std::string_view name) {
  constexpr std::string_view kNames[] = {"name",        "provides",   "requires", "plugin",
                                         "alwayson",    "enable_gui", "scount",   "laser_pose",
                                         "request_map", "model"};
  return name.starts_with("spose[") ||
         std::find(std::begin(kNames), std::end(kNames), name) != std::end(kNames);
}

Json value_of(double given, Unit unit, const Units& units) {
  if (unit == Unit::kFlag) return given != 0.0;
  if (unit == Unit::kLength) given *= units.length_m;
  if (unit == Unit::kAngle || unit == Unit::kHeading) {
    // Exact where the file has degrees.
    constexpr double kDegree_rad = std::numbers::pi / 180.0;
    if (units.angle_rad != kDegree_rad) given *= units.angle_rad / kDegree_rad;
  }
  if (unit == Unit::kHeading) return neat(std::clamp(given, -180.0, 180.0));
  if (unit == Unit::kWhole) return std::lround(std::clamp(given, -1e9, 1e9));
  return neat(given);  // lengths in m, angles in degrees, both here and in worlds
}

/// `init_pose [x y yaw]` and `init_pose_var [x y yaw]` of amcl.
void add_start(const Properties& driver, Json& settings) {
  // Player's driver starts at the origin if there is no pose.
  const auto pose = driver.tuple<3>("init_pose", "lla", {0.0, 0.0, 0.0});
  settings["init_pose"] = pose_json({pose[0], pose[1], normalize_angle(pose[2])});
  const auto deviation = driver.tuple<3>("init_pose_var", "lla", {1.0, 1.0, 0.0});
  if (driver.has("init_pose_var")) {
    settings["init_pose_var"] = Json::array({neat(deviation[0]), neat(deviation[1])});
  }
  constexpr double kAnyHeading_deg = 360.0;  // Player's default
  if (!settings.contains("init_pose_var_yaw_deg")) {
    settings["init_pose_var_yaw_deg"] = kAnyHeading_deg;
  }
}

}  // namespace

bool is_goal_driver(std::string_view name) {
  return std::find(std::begin(kGoalDrivers), std::end(kGoalDrivers), name) !=
         std::end(kGoalDrivers);
}

bool is_scan_driver(std::string_view name) {
  return name == "lasercspace" || name == "laserposeinterpolator";
}

Json driver_settings(std::string_view name, const Properties& driver, const Units& units,
                     Report& report) {
  Json settings = {{"type", std::string(name)}};
  std::vector<std::string> left_out;
  for (const Property& property : driver.entity().properties) {
    bool known =
        is_ignored(property.name) || (name == "amcl" && property.name.starts_with("init_pose"));
    for (const Option& option : kOptions) {
      if (option.driver != name || option.name != property.name) continue;
      known = true;
      const std::vector<double> given = driver.numbers(property.name, option.element + 1);
      if (option.element < given.size()) {
        settings[option.setting] = value_of(given[option.element], option.unit, units);
      }
    }
    if (!known) left_out.push_back(property.name);
  }
  if (name == "amcl") add_start(driver, settings);
  if (!left_out.empty()) {
    report.note("options of " + std::string(name), driver.place_of(left_out.front()),
                "options of the driver " + in_quotes(std::string(name)) +
                    " are left out: " + list_text(left_out, " and "));
  }
  return settings;
}

}  // namespace sim::io::stage

namespace sim {

std::string hint_for_player_option(std::string_view driver, std::string_view option) {
  const std::string of_player = "Player's " + io::in_quotes(std::string(option));
  std::vector<std::string> settings;
  for (const io::stage::Option& known : io::stage::kOptions) {
    if (known.driver != driver || known.name != option) continue;
    if (known.element > 0 && settings.empty()) settings.emplace_back(option);
    settings.emplace_back(known.setting);
  }
  if (settings.size() > 1) {
    return "the numbers of " + of_player + " are the settings " + io::list_text(settings, " and ") +
           " here";
  }
  if (!settings.empty()) {
    return settings.front() == option
               ? ""
               : of_player + " is " + io::in_quotes(settings.front()) + " here";
  }
  for (const io::stage::Absent& known : io::stage::kAbsent) {
    if ((known.driver != driver && !known.driver.empty()) || known.name != option) continue;
    const std::string instead = known.instead;
    return of_player + " does not exist here" + (instead.empty() ? "" : ": " + instead);
  }
  return "";
}

}  // namespace sim
