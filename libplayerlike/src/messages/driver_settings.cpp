// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "playerlike/messages/driver_settings.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>

#include "messages/driver_reader.h"

namespace sim {
namespace {

using playerlike::CspaceSettings;
using playerlike::GotoSettings;
using playerlike::NdSettings;
using playerlike::PoseInterpolatorSettings;
using playerlike::SndSettings;
using playerlike::VfhSettings;
using playerlike::WavefrontSettings;

constexpr double kMostMetres = 10.0;
constexpr double kMostSpeed_mps = 10.0;
constexpr double kMostTurnRate_degps = 3600.0;
constexpr double kMostTime_s = 1e6;
constexpr double kMostCutoff = 1e12;
constexpr double kMostIndex = 65535.0;

constexpr const char* kRadiusMeaning =
    "radius of the disc around the axle's middle that contains the robot";
constexpr const char* kPatienceMeaning =
    "blocked after this time without coming 2 cm nearer to the goal";

constexpr Field kSndFields[] = {
    field<&SndSettings::robot_radius_m>("robot_radius", "m", kRadiusMeaning).above(0, kMostMetres),
    field<&SndSettings::safety_distance_m>(
        "safety_distance", "m", "points nearer to the disc than this deflect and slow the robot")
        .above(0, kMostMetres),
    field<&SndSettings::max_speed_mps>("max_speed", "m/s", "the motors' own limit also holds")
        .above(0, kMostSpeed_mps),
    field<&SndSettings::max_turn_rate_radps>("max_turn_rate_deg", "degrees/s",
                                             "the motors' own limit also holds")
        .above(0, kMostTurnRate_degps),
    field<&SndSettings::goal_distance_m>("goal_distance", "m", "tolerance of a goal's position")
        .above(0, kMostMetres),
    field<&SndSettings::goal_angle_rad>("goal_angle_deg", "degrees",
                                        "tolerance of a goal's heading")
        .above(0, 180),
    field<&SndSettings::patience_s>("patience", "s", kPatienceMeaning).above(0, kMostTime_s),
};

constexpr Field kVfhFields[] = {
    field<&VfhSettings::robot_radius_m>("robot_radius", "m", kRadiusMeaning).above(0, kMostMetres),
    field<&VfhSettings::cell_size_m>("cell_size", "m", "side of a cell of the local map")
        .within(0.005, 1),
    field<&VfhSettings::window_diameter>("window_diameter", "cells",
                                         "side of the local map, which has the robot in its middle")
        .within(3, 401),
    field<&VfhSettings::sector_angle_rad>("sector_angle_deg", "degrees",
                                          "width of a sector of the histogram")
        .within(1, 30),
    field<&VfhSettings::safety_dist_0ms_m>("safety_dist_0ms", "m",
                                           "distance that the disc keeps from obstacles, at 0 m/s")
        .within(0, kMostMetres),
    field<&VfhSettings::safety_dist_1ms_m>("safety_dist_1ms", "m", "the same at 1 m/s")
        .within(0, kMostMetres),
    field<&VfhSettings::max_speed_mps>("max_speed", "m/s", "the motors' own limit also holds")
        .above(0, kMostSpeed_mps),
    field<&VfhSettings::max_speed_narrow_opening_mps>(
        "max_speed_narrow_opening", "m/s", "limit through an opening of less than 80 degrees")
        .above(0, kMostSpeed_mps),
    field<&VfhSettings::max_speed_wide_opening_mps>(
        "max_speed_wide_opening", "m/s",
        "limit along the border of, or to a goal in, a wider opening")
        .above(0, kMostSpeed_mps),
    field<&VfhSettings::max_acceleration_mps2>("max_acceleration", "m/s^2",
                                               "how fast the commanded speed grows")
        .above(0, 100),
    field<&VfhSettings::min_turnrate_radps>("min_turnrate_deg", "degrees/s",
                                            "slowest turn on the spot at the goal")
        .within(0, kMostTurnRate_degps),
    field<&VfhSettings::max_turnrate_0ms_radps>("max_turnrate_0ms_deg", "degrees/s",
                                                "fastest turn at 0 m/s")
        .above(0, kMostTurnRate_degps),
    field<&VfhSettings::max_turnrate_1ms_radps>("max_turnrate_1ms_deg", "degrees/s",
                                                "fastest turn at 1 m/s")
        .above(0, kMostTurnRate_degps),
    field<&VfhSettings::min_turn_radius_safety_factor>("min_turn_radius_safety_factor", "",
                                                       "factor of the smallest radius of turns")
        .within(0, 100),
    field<&VfhSettings::free_space_cutoff_0ms>(
        "free_space_cutoff_0ms", "", "sectors of a smaller magnitude become free, at 0 m/s")
        .above(0, kMostCutoff),
    field<&VfhSettings::free_space_cutoff_1ms>("free_space_cutoff_1ms", "", "the same at 1 m/s")
        .above(0, kMostCutoff),
    field<&VfhSettings::obs_cutoff_0ms>("obs_cutoff_0ms", "",
                                        "sectors of a greater magnitude become blocked, at 0 m/s")
        .above(0, kMostCutoff),
    field<&VfhSettings::obs_cutoff_1ms>("obs_cutoff_1ms", "", "the same at 1 m/s")
        .above(0, kMostCutoff),
    field<&VfhSettings::weight_desired_dir>("weight_desired_dir", "",
                                            "cost of a radian between direction and goal")
        .within(0, 1e6),
    field<&VfhSettings::weight_current_dir>(
        "weight_current_dir", "", "cost of a radian between direction and the previous direction")
        .within(0, 1e6),
    field<&VfhSettings::distance_epsilon_m>("distance_epsilon", "m",
                                            "tolerance of a goal's position")
        .above(0, kMostMetres),
    field<&VfhSettings::angle_epsilon_rad>("angle_epsilon_deg", "degrees",
                                           "tolerance of a goal's heading")
        .above(0, 180),
    field<&VfhSettings::patience_s>("patience", "s", kPatienceMeaning).above(0, kMostTime_s),
};

constexpr Field kNdFields[] = {
    field<&NdSettings::robot_radius_m>("robot_radius", "m", kRadiusMeaning).above(0, kMostMetres),
    field<&NdSettings::goal_tol_m>("goal_tol", "m", "tolerance of a goal's position")
        .above(0, kMostMetres),
    field<&NdSettings::goal_tol_angle_rad>("goal_tol_angle_deg", "degrees",
                                           "tolerance of a goal's heading")
        .above(0, 180),
    field<&NdSettings::max_speed_mps>("max_speed", "m/s", "the motors' own limit also holds")
        .above(0, kMostSpeed_mps),
    field<&NdSettings::max_turnrate_radps>("max_turnrate_deg", "degrees/s",
                                           "the motors' own limit also holds")
        .above(0, kMostTurnRate_degps),
    field<&NdSettings::min_speed_mps>("min_speed", "m/s", "slowest speed other than 0")
        .within(0, kMostSpeed_mps),
    field<&NdSettings::min_turnrate_radps>("min_turnrate_deg", "degrees/s",
                                           "slowest turn on the spot at the goal")
        .within(0, kMostTurnRate_degps),
    field<&NdSettings::avoid_dist_m>("avoid_dist", "m",
                                     "obstacles nearer to the disc than this are avoided")
        .above(0, kMostMetres),
    field<&NdSettings::safety_dist_m>("safety_dist", "m", "added to the radius of the disc")
        .within(0, kMostMetres),
    field<&NdSettings::rotate_stuck_time_s>(
        "rotate_stuck_time", "s", "turning on the spot at the goal for this time counts as blocked")
        .above(0, kMostTime_s),
    field<&NdSettings::translate_stuck_time_s>(
        "translate_stuck_time", "s",
        "less movement than the next two settings in this time counts as blocked")
        .above(0, kMostTime_s),
    field<&NdSettings::translate_stuck_dist_m>("translate_stuck_dist", "m",
                                               "distance that counts as movement")
        .within(0, kMostMetres),
    field<&NdSettings::translate_stuck_angle_rad>("translate_stuck_angle_deg", "degrees",
                                                  "turn that counts as movement")
        .within(0, 180),
    field<&NdSettings::patience_s>("patience", "s", kPatienceMeaning).above(0, kMostTime_s),
};

constexpr Field kGotoFields[] = {
    field<&GotoSettings::dist_tol_m>("dist_tol", "m", "tolerance of a goal's position")
        .above(0, kMostMetres),
    field<&GotoSettings::angle_tol_rad>("angle_tol_deg", "degrees", "tolerance of a goal's heading")
        .above(0, 180),
    field<&GotoSettings::max_vel_mps>("max_vel", "m/s", "the motors' own limit also holds")
        .above(0, kMostSpeed_mps),
    field<&GotoSettings::min_vel_mps>("min_vel", "m/s", "slowest speed other than 0")
        .within(0, kMostSpeed_mps),
    field<&GotoSettings::max_angular_vel_radps>("max_angular_vel_deg", "degrees/s",
                                                "the motors' own limit also holds")
        .above(0, kMostTurnRate_degps),
    field<&GotoSettings::min_angular_vel_radps>("min_angular_vel_deg", "degrees/s",
                                                "slowest turn on the spot")
        .within(0, kMostTurnRate_degps),
    field<&GotoSettings::patience_s>("patience", "s", kPatienceMeaning).above(0, kMostTime_s),
};

constexpr Field kWavefrontFields[] = {
    field<&WavefrontSettings::robot_radius_m>("robot_radius", "m", kRadiusMeaning)
        .above(0, kMostMetres),
    field<&WavefrontSettings::safety_dist_m>(
        "safety_dist", "m", "the path keeps the disc this far from the map's obstacles")
        .within(0, kMostMetres),
    field<&WavefrontSettings::max_radius_m>(
        "max_radius", "m", "cells farther than this from all obstacles have no extra cost")
        .within(0, 100),
    field<&WavefrontSettings::dist_penalty>("dist_penalty", "",
                                            "extra cost of cells near obstacles")
        .within(0, 1e6),
    field<&WavefrontSettings::distance_epsilon_m>("distance_epsilon", "m",
                                                  "tolerance of the goal's position")
        .above(0, kMostMetres),
    field<&WavefrontSettings::angle_epsilon_rad>("angle_epsilon_deg", "degrees",
                                                 "tolerance of the goal's heading")
        .above(0, 180),
    field<&WavefrontSettings::replan_dist_thresh_m>(
        "replan_dist_thresh", "m", "plans again after this distance; negative: never")
        .within(-1, 1e6),
    field<&WavefrontSettings::replan_min_time_s>(
        "replan_min_time", "s", "least time between plans; negative: never plans again")
        .within(-1, kMostTime_s),
    field<&WavefrontSettings::cell_size_m>("cell_size", "m", "side of a cell of the map")
        .within(0.005, 1),
    field<&WavefrontSettings::position>(
        "position", "", "index of the `position2d` that gives the pose in the world's frame")
        .within(0, kMostIndex),
    field<&WavefrontSettings::localize>("localize", "",
                                        "index of the `localize` that gives the pose instead")
        .within(0, kMostIndex),
    field<&WavefrontSettings::output>("output", "",
                                      "index of the driver's `position2d` that gets the waypoints")
        .within(0, kMostIndex),
    field<&WavefrontSettings::draw>("draw", "", "whether the path is drawn on a layer"),
};

constexpr Field kCspaceFields[] = {
    field<&CspaceSettings::radius_m>("radius", "m", "radius of the disc around the laser")
        .above(0, kMostMetres),
    field<&CspaceSettings::step>("step", "", "every n-th beam counts as an obstacle")
        .within(1, 8192),
};

constexpr Field kPoseInterpolatorFields[] = {
    field<&PoseInterpolatorSettings::position>("position", "",
                                               "index of the `position2d` that gives the poses")
        .within(0, kMostIndex),
    field<&PoseInterpolatorSettings::interpolate>(
        "interpolate", "", "whether the pose is that of the scan's time, or the newest one"),
};

}  // namespace

SIM_FIELDS(CspaceSettings, kCspaceFields)
SIM_FIELDS(PoseInterpolatorSettings, kPoseInterpolatorFields)
SIM_FIELDS(SndSettings, kSndFields)
SIM_FIELDS(VfhSettings, kVfhFields)
SIM_FIELDS(NdSettings, kNdFields)
SIM_FIELDS(GotoSettings, kGotoFields)
SIM_FIELDS(WavefrontSettings, kWavefrontFields)

}  // namespace sim

namespace playerlike {
namespace {

constexpr double kDegree_rad = std::numbers::pi / 180.0;

constexpr const char* kBlackboardDriver = "localbb";
constexpr const char* kConverters[] = {"lasertoranger", "rangertolaser", kBlackboardDriver};

struct Drivers {
  std::vector<GoalDriverInfo> goal_drivers;
  std::vector<PlannerInfo> planners;
  std::vector<ScanDriverInfo> scan_drivers;
};
template <std::size_t... kIndex>
GoalDriverSettings settings_of_kind(std::size_t kind, const RobotParts& robot,
                                    std::index_sequence<kIndex...> /*kinds*/) {
  GoalDriverSettings settings;
  const auto use = [&]<typename Settings>(std::type_identity<Settings> /*type*/) {
    settings =
        default_settings<Settings>(robot.radius_m, robot.max_speed_mps, robot.max_turn_rate_radps);
  };
  ((kIndex == kind
        ? use(std::type_identity<std::variant_alternative_t<kIndex, GoalDriverSettings>>{})
        : void()),
   ...);
  return settings;
}

GoalDriverInfo read_goal_driver(DriverReader& reader, std::size_t kind, const RobotParts& robot) {
  GoalDriverInfo read;
  read.settings = settings_of_kind(
      kind, robot, std::make_index_sequence<std::variant_size_v<GoalDriverSettings>>());
  reader.index("index", read.index);
  reader.index("position", read.position);
  reader.index("laser", read.laser);
  reader.settings(goal_driver_kinds()[kind].fields(), sim::object_in(read.settings));
  reader.refuse_unknown_keys();
  reader.need("position", read.position, robot.count_of("position2d"), "position2d");
  if (!std::holds_alternative<GotoSettings>(read.settings)) {
    reader.need("laser", read.laser, robot.count_of("laser"), "laser");
  }
  reader.need_motors(robot);
  return read;
}

PlannerInfo read_planner(DriverReader& reader, const RobotParts& robot) {
  PlannerInfo read;
  read.settings = default_settings<WavefrontSettings>(robot.radius_m, robot.max_speed_mps,
                                                      robot.max_turn_rate_radps);
  reader.index("index", read.index);
  reader.settings(sim::fields_of<WavefrontSettings>(), &read.settings);
  reader.refuse_unknown_keys();
  reader.need("position", read.settings.position, robot.count_of("position2d"), "position2d");
  if (read.settings.localize >= 0) {
    reader.need("localize", read.settings.localize, robot.count_of("localize"), "localize");
  }
  return read;
}

ScanDriverInfo read_scan_driver(DriverReader& reader, std::size_t kind, const RobotParts& robot) {
  ScanDriverInfo read;
  read.settings = scan_driver_kinds()[kind].make();
  reader.index("index", read.index);
  reader.index("laser", read.laser);
  reader.settings(scan_driver_kinds()[kind].fields(), sim::object_in(read.settings));
  reader.refuse_unknown_keys();
  reader.need("laser", read.laser, robot.count_of("laser"), "laser");
  if (const auto* stamped = std::get_if<PoseInterpolatorSettings>(&read.settings)) {
    reader.need("position", stamped->position, robot.count_of("position2d"), "position2d");
  }
  return read;
}

// An entry for a driver of Player that converts between interfaces: every robot has both.
void read_converter(DriverReader& reader, const std::string& type, const RobotParts& robot) {
  int laser = 0;
  const bool is_of_laser = type != kBlackboardDriver;
  if (is_of_laser) reader.index("laser", laser);
  reader.refuse_unknown_keys();
  if (is_of_laser) reader.need("laser", laser, robot.count_of("laser"), "laser");
}

// Chooses the driver that gets a planner's waypoints.
void find_output(DriverReader& reader, const std::vector<GoalDriverInfo>& drivers, int& output) {
  if (drivers.empty()) {
    reader.complain("world/driver-device", "",
                    "a robot with a driver that drives to goals, for example {\"type\": \"snd\"}",
                    kNoDevice);
  } else if (output < 0) {
    output = drivers.front().index;
  } else if (std::ranges::find(drivers, output, &GoalDriverInfo::index) == drivers.end()) {
    std::string list;
    for (const GoalDriverInfo& driver : drivers) {
      list +=
          (list.empty() ? "" : ", ") + std::to_string(driver.index) + " (" + driver.type() + ')';
    }
    reader.complain("world/driver-device", "output",
                    "the index of one of the robot's drivers that drive to goals: " + list,
                    std::to_string(output));
  }
}

Drivers read_all(const RobotParts& robot, const std::string& file, const std::string& pointer,
                 std::vector<sim::ConfigIssue>& issues) {
  Drivers drivers;
  Indices positions("position2d", robot.count_of("position2d"));
  Indices planners("planner", 0);
  Indices lasers("laser", robot.count_of("laser"));
  std::vector<DriverReader> of_planners;
  const auto& kinds = goal_driver_kinds();
  for (std::size_t d = 0; d < robot.drivers.size(); ++d) {
    const sim::DriverDescription& driver = robot.drivers[d];
    DriverReader reader(driver, file, pointer + "/drivers/" + std::to_string(d), issues);
    const auto kind = std::ranges::find_if(
        kinds, [&](const GoalDriverKind& known) { return driver.type == known.name; });
    if (kind != kinds.end()) {
      const auto number = static_cast<std::size_t>(kind - kinds.begin());
      drivers.goal_drivers.push_back(read_goal_driver(reader, number, robot));
      positions.take(reader, drivers.goal_drivers.back().index);
    } else if (driver.type == PlannerInfo::type()) {
      drivers.planners.push_back(read_planner(reader, robot));
      planners.take(reader, drivers.planners.back().index);
      of_planners.push_back(reader);
    } else if (const auto scans = std::ranges::find_if(
                   scan_driver_kinds(),
                   [&](const ScanDriverKind& known) { return driver.type == known.name; });
               scans != scan_driver_kinds().end()) {
      const auto number = static_cast<std::size_t>(scans - scan_driver_kinds().begin());
      drivers.scan_drivers.push_back(read_scan_driver(reader, number, robot));
      lasers.take(reader, drivers.scan_drivers.back().index);
    } else if (std::ranges::find(kConverters, driver.type) != std::end(kConverters)) {
      read_converter(reader, driver.type, robot);
    } else {
      std::string list = "\"amcl\"";  // a device of libsim
      std::vector<std::string> known = {"amcl"};
      for (const DriverType& type : driver_types()) {
        list += ", \"" + type.name + '"';
        known.push_back(type.name);
      }
      std::string hint;
      if (driver.type == "mapfile" || driver.type == "mapscale") {
        hint = "not needed: map:0 is the map of the world's floor";
      } else if (const std::string near = sim::nearest_word(driver.type, known); !near.empty()) {
        hint = "did you mean \"" + near + "\"?";
      }
      reader.complain("world/unknown-driver", "type", "a driver that there is: " + list,
                      '"' + driver.type + '"', hint);
    }
  }
  positions.fill(drivers.goal_drivers);
  planners.fill(drivers.planners);
  lasers.fill(drivers.scan_drivers);
  for (std::size_t p = 0; p < of_planners.size(); ++p) {
    find_output(of_planners[p], drivers.goal_drivers, drivers.planners[p].settings.output);
  }
  return drivers;
}

// The radius of a robot's disc in whole centimetres; 0: unknown.
double rounded_up_cm(double radius_m) {
  constexpr double kRounding = 1e-6;  // a radius of whole centimetres is not rounded up
  return radius_m > 0.0 ? std::max(1.0, std::ceil(100.0 * radius_m - kRounding)) : 0.0;
}

// The defaults of settings whose only setting that depends on the robot is its radius.
template <typename Settings>
Settings with_radius(double radius_m) {
  Settings settings;
  if (radius_m > 0.0) settings.robot_radius_m = std::min(10.0, rounded_up_cm(radius_m) / 100.0);
  return settings;
}

}  // namespace

// --- Settings

DrivingLimits SndSettings::limits() const {
  return {robot_radius_m,  max_speed_mps,  max_turn_rate_radps,
          goal_distance_m, goal_angle_rad, patience_s};
}
void SndSettings::slow_down(double speed_mps, double turn_rate_radps) {
  max_speed_mps = std::min(max_speed_mps, speed_mps);
  max_turn_rate_radps = std::min(max_turn_rate_radps, turn_rate_radps);
}

DrivingLimits VfhSettings::limits() const {
  return {robot_radius_m,     max_speed_mps,     max_turnrate_0ms_radps,
          distance_epsilon_m, angle_epsilon_rad, patience_s};
}
void VfhSettings::slow_down(double speed_mps, double turn_rate_radps) {
  max_speed_mps = std::min(max_speed_mps, speed_mps);
  max_turnrate_1ms_radps =
      std::min(max_turnrate_1ms_radps.value_or(max_turnrate_0ms_radps), turn_rate_radps);
  max_turnrate_0ms_radps = std::min(max_turnrate_0ms_radps, turn_rate_radps);
}

DrivingLimits NdSettings::limits() const {
  return {robot_radius_m + safety_dist_m,
          max_speed_mps,
          max_turnrate_radps,
          goal_tol_m,
          goal_tol_angle_rad,
          patience_s};
}
void NdSettings::slow_down(double speed_mps, double turn_rate_radps) {
  // A robot that has to be slower is not stuck earlier.
  translate_stuck_dist_m *= std::min(1.0, speed_mps / max_speed_mps);
  translate_stuck_angle_rad *= std::min(1.0, turn_rate_radps / max_turnrate_radps);
  max_speed_mps = std::min(max_speed_mps, speed_mps);
  max_turnrate_radps = std::min(max_turnrate_radps, turn_rate_radps);
}

DrivingLimits GotoSettings::limits() const {
  return {0.0, max_vel_mps, max_angular_vel_radps, dist_tol_m, angle_tol_rad, patience_s};
}
void GotoSettings::slow_down(double speed_mps, double turn_rate_radps) {
  max_vel_mps = std::min(max_vel_mps, speed_mps);
  max_angular_vel_radps = std::min(max_angular_vel_radps, turn_rate_radps);
}

template <>
SndSettings default_settings<SndSettings>(double radius_m, double max_speed_mps,
                                          double max_turn_rate_radps) {
  constexpr double kSpeedShare = 0.6;
  constexpr double kTurnShare = 0.5;
  SndSettings settings;
  if (radius_m > 0.0) {
    const double radius_cm = rounded_up_cm(radius_m);
    settings.robot_radius_m = radius_cm / 100.0;
    settings.safety_distance_m = 1.5 * radius_cm / 100.0;
  }
  if (max_speed_mps > 0.0) settings.max_speed_mps = kSpeedShare * max_speed_mps;
  if (max_turn_rate_radps > 0.0) settings.max_turn_rate_radps = kTurnShare * max_turn_rate_radps;
  for (const sim::Field& field : sim::fields_of<SndSettings>().fields) {
    double& value = *static_cast<double*>(field.set(&settings));
    value = std::min(value, field.range.max * unit_of_setting(field));
  }
  return settings;
}

template <>
VfhSettings default_settings<VfhSettings>(double radius_m, double /*max_speed_mps*/,
                                          double /*max_turn_rate_radps*/) {
  return with_radius<VfhSettings>(radius_m);
}

template <>
NdSettings default_settings<NdSettings>(double radius_m, double /*max_speed_mps*/,
                                        double /*max_turn_rate_radps*/) {
  return with_radius<NdSettings>(radius_m);
}

template <>
GotoSettings default_settings<GotoSettings>(double /*radius_m*/, double /*max_speed_mps*/,
                                            double /*max_turn_rate_radps*/) {
  return {};
}

template <>
WavefrontSettings default_settings<WavefrontSettings>(double radius_m, double /*max_speed_mps*/,
                                                      double /*max_turn_rate_radps*/) {
  return with_radius<WavefrontSettings>(radius_m);
}

const std::array<GoalDriverKind, std::variant_size_v<GoalDriverSettings>>& goal_driver_kinds() {
  static constexpr auto kKinds =
      sim::alternative_kinds<GoalDriverSettings>({"snd", "vfh", "nd", "goto"});
  return kKinds;
}

const std::array<ScanDriverKind, std::variant_size_v<ScanDriverSettings>>& scan_driver_kinds() {
  static constexpr auto kKinds =
      sim::alternative_kinds<ScanDriverSettings>({"lasercspace", "laserposeinterpolator"});
  return kKinds;
}

const std::vector<DriverType>& driver_types() {
  static const auto* const types = [] {
    auto* made = new std::vector<DriverType>;
    for (const GoalDriverKind& kind : goal_driver_kinds()) {
      made->push_back({kind.name, &kind.fields(), DriverUse::kDrives});
    }
    made->push_back({PlannerInfo::type(), &sim::fields_of<WavefrontSettings>(), DriverUse::kPlans});
    for (const ScanDriverKind& kind : scan_driver_kinds()) {
      made->push_back({kind.name, &kind.fields(), DriverUse::kScans});
    }
    static const sim::FieldTable kNone{};
    for (const char* converter : kConverters) {
      made->push_back({converter, &kNone, DriverUse::kConverts});
    }
    return made;
  }();
  return *types;
}

double unit_of_setting(const sim::Field& field) { return field.is_angle ? kDegree_rad : 1.0; }

std::string fault_of(const sim::FieldTable& table, const void* settings) {
  for (const sim::Field& field : table.fields) {
    const void* const value = field.get(settings);
    if (value == nullptr) continue;
    if (field.type == sim::FieldType::kInt) {
      const std::int64_t number = sim::integer_at(field, value);
      if (number >= field.least && number <= field.greatest) continue;
      return std::string(field.name) + " must be " + range_of(field) + ", but is " +
             std::to_string(number);
    }
    if (field.type != sim::FieldType::kNumber) continue;
    const double number = *static_cast<const double*>(value);
    if (is_in_range(field, number)) continue;
    return std::string(field.name) + " must be " + range_of(field) + ", but is " +
           number_text(number / unit_of_setting(field));
  }
  return "";
}

// --- Drivers of robots

void read_drivers(RobotInfo& robot, const std::string& file, const std::string& pointer) {
  std::vector<sim::ConfigIssue> issues;
  RobotParts parts{
      {}, robot.drivers, robot.radius_m, robot.max_speed_mps, robot.max_turn_rate_radps};
  for (const DeviceInfo& device : robot.devices) parts.types.push_back(device.type);
  Drivers read = read_all(parts, file, pointer, issues);
  if (!issues.empty()) throw sim::ConfigError(std::move(issues));
  robot.goal_drivers = std::move(read.goal_drivers);
  robot.planners = std::move(read.planners);
  robot.scan_drivers = std::move(read.scan_drivers);
}

void check_drivers(const sim::WorldDescription& world) {
  std::vector<sim::ConfigIssue> issues;
  for (std::size_t r = 0; r < world.robots.size(); ++r) {
    const sim::RobotDescription& robot = world.robots[r];
    RobotParts parts{{}, robot.drivers};
    for (const sim::DeviceDescription& device : robot.devices) parts.types.push_back(device.type);
    read_all(parts, world.file, "/robots/" + std::to_string(r), issues);
  }
  if (!issues.empty()) throw sim::ConfigError(std::move(issues));
}

}  // namespace playerlike
