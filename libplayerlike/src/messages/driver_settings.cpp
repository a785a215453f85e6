// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "playerlike/messages/driver_settings.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>
#include <set>
#include <string_view>
#include <utility>

#include "playerlike/messages/messages.h"
#include "sim/core/error.h"
#include "sim/core/number_text.h"

namespace sim {
namespace {

using playerlike::GotoSettings;
using playerlike::NdSettings;
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
        "rotate_stuck_time", "s",
        "blocked after turning on the spot at the goal for this time in vain")
        .above(0, kMostTime_s),
    field<&NdSettings::translate_stuck_time_s>(
        "translate_stuck_time", "s",
        "blocked after driving for this time without the next two settings")
        .above(0, kMostTime_s),
    field<&NdSettings::translate_stuck_dist_m>("translate_stuck_dist", "m",
                                               "distance that counts as driving")
        .within(0, kMostMetres),
    field<&NdSettings::translate_stuck_angle_rad>("translate_stuck_angle_deg", "degrees",
                                                  "turn that counts as driving")
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

}  // namespace

SIM_FIELDS(SndSettings, kSndFields)
SIM_FIELDS(VfhSettings, kVfhFields)
SIM_FIELDS(NdSettings, kNdFields)
SIM_FIELDS(GotoSettings, kGotoFields)
SIM_FIELDS(WavefrontSettings, kWavefrontFields)

}  // namespace sim

namespace playerlike {
namespace {

constexpr double kDegree_rad = std::numbers::pi / 180.0;
constexpr int kMaxIndex = 65535;
constexpr const char* kNoDevice = "none";

std::string number_text(double value) { return sim::rounded_text(value, 6); }

std::string range_of(const sim::Field& field) {
  const sim::NumberRange& range = field.range;
  const std::string unit = *range.unit == '\0' ? "" : std::string(" ") + range.unit;
  const std::string most = number_text(range.max) + unit;
  return range.min_exclusive ? "greater than " + number_text(range.min) + " and at most " + most
                             : "from " + number_text(range.min) + " to " + most;
}

bool is_in_range(const sim::Field& field, double value) {
  const double shown = value / unit_of_setting(field);
  // An angle of the greatest number of degrees may be a little greater after the conversion.
  const double most = field.range.max * (1.0 + 1e-15);
  return (field.range.min_exclusive ? shown > field.range.min : shown >= field.range.min) &&
         shown <= most;
}

template <typename Number>
std::optional<Number> parsed(const std::string& text) {
  Number value{};
  const char* end = text.data() + text.size();
  const auto [at, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || at != end) return std::nullopt;
  return value;
}

// What the drivers of a robot depend on.
struct RobotParts {
  std::vector<std::string> types;  // of its devices
  const std::vector<sim::DriverDescription>& drivers;
  double radius_m = 0.0;
  double max_speed_mps = 0.0;
  double max_turn_rate_radps = 0.0;

  [[nodiscard]] int count_of(std::string_view interface) const {
    return static_cast<int>(std::ranges::count_if(
        types, [&](const std::string& type) { return carries(type, interface); }));
  }
  [[nodiscard]] bool has_motors() const {
    return std::ranges::find(types, "motion") != types.end();
  }
};

struct Drivers {
  std::vector<GoalDriverInfo> goal_drivers;
  std::vector<PlannerInfo> planners;
};

// Reads one driver and collects its errors.
class DriverReader {
 public:
  DriverReader(const sim::DriverDescription& driver, std::string file, std::string pointer,
               std::vector<sim::ConfigIssue>& issues)
      : driver_(driver), file_(std::move(file)), pointer_(std::move(pointer)), issues_(issues) {}

  void complain(const std::string& id, const std::string& key, const std::string& expected,
                const std::string& found, const std::string& hint = "") {
    issues_.push_back(
        {id, file_, key.empty() ? pointer_ : pointer_ + '/' + key, expected, found, hint});
  }

  void index(const std::string& key, int& index) {
    known_.push_back(key);
    if (const std::string* text = find(key)) whole_number(key, *text, 0, kMaxIndex, "", index);
  }

  void settings(const sim::FieldTable& table, void* object) {
    for (const sim::Field& field : table.fields) {
      known_.emplace_back(field.name);
      if (const std::string* text = find(field.name)) setting(field, *text, object);
    }
  }

  void refuse_unknown_keys() {
    for (const auto& [key, text] : driver_.settings) {
      if (std::ranges::find(known_, key) != known_.end()) continue;
      std::string list;
      for (const std::string& name : known_) list += (list.empty() ? "" : ", ") + name;
      const std::string near = sim::nearest_word(key, known_);
      complain("world/unknown-key", key, "one of the settings of \"" + driver_.type + "\": " + list,
               "the unknown key \"" + key + '"',
               near.empty() ? "" : "did you mean \"" + near + "\"?");
    }
  }

  // A device of the robot that the driver uses.
  void need(const char* key, int index, int count, const char* what) {
    if (index < count) return;
    complain("world/driver-device", key,
             count == 0 ? std::string("a robot with a ") + what
                        : std::string("the index of one of the robot's ") + std::to_string(count) +
                              " devices that are a " + what,
             count == 0 ? kNoDevice : std::to_string(index));
  }

  void need_motors(const RobotParts& robot) {
    if (robot.has_motors()) return;
    complain("world/driver-device", "", "a robot with motors (a device \"motion\")", kNoDevice);
  }

 private:
  [[nodiscard]] const std::string* find(const std::string& key) const {
    const auto it = driver_.settings.find(key);
    return it == driver_.settings.end() ? nullptr : &it->second;
  }

  void setting(const sim::Field& field, const std::string& text, void* object) {
    const char* const key = field.name;
    if (field.type == sim::FieldType::kInt) {
      int value = 0;
      if (whole_number(key, text, field.least, field.greatest, field.range.unit, value)) {
        sim::set_integer(field, field.set(object), value);
      }
      return;
    }
    if (field.type == sim::FieldType::kBool) {
      if (text != "true" && text != "false") {
        complain("world/wrong-type", key, "true or false", '"' + text + '"');
      } else {
        *static_cast<bool*>(field.set(object)) = text == "true";
      }
      return;
    }
    const std::string expected = "a number " + range_of(field);
    const std::optional<double> value = parsed<double>(text);
    if (!value) {
      complain("world/wrong-type", key, expected, '"' + text + '"');
    } else if (!is_in_range(field, *value * unit_of_setting(field))) {
      complain("world/out-of-range", key, expected, text);
    } else {
      *static_cast<double*>(field.set(object)) = *value * unit_of_setting(field);
    }
  }

  bool whole_number(const std::string& key, const std::string& text, std::int64_t least,
                    std::int64_t greatest, const std::string& unit, int& number) {
    const std::string expected = "a whole number from " + std::to_string(least) + " to " +
                                 std::to_string(greatest) + (unit.empty() ? "" : " " + unit);
    const std::optional<int> value = parsed<int>(text);
    if (!value) {
      complain("world/wrong-type", key, expected, '"' + text + '"');
    } else if (*value < least || *value > greatest) {
      complain("world/out-of-range", key, expected, text);
    } else {
      number = *value;
      return true;
    }
    return false;
  }

  const sim::DriverDescription& driver_;
  std::string file_;
  std::string pointer_;
  std::vector<sim::ConfigIssue>& issues_;
  std::vector<std::string> known_;
};

// The indices of an interface on a robot's port.
class Indices {
 public:
  Indices(const char* interface, int devices) : interface_(interface), devices_(devices) {
    for (int i = 0; i < devices; ++i) taken_.insert(i);
  }
  void take(DriverReader& reader, int index) {
    if (index < 0 || taken_.insert(index).second) return;
    reader.complain("world/driver-index", "index",
                    std::string("an index that no other ") + interface_ + " of the robot has",
                    std::to_string(index),
                    (devices_ == 0 ? std::string()
                                   : "devices have 0 to " + std::to_string(devices_ - 1) + "; ") +
                        "without an index a driver takes the first free one");
  }
  // Gives the first free indices to drivers without an index.
  template <typename Driver>
  void fill(std::vector<Driver>& drivers) {
    int next = 0;
    for (Driver& driver : drivers) {
      if (driver.index >= 0) continue;
      while (!taken_.insert(next).second) ++next;
      driver.index = next;
    }
  }

 private:
  const char* interface_;
  int devices_;
  std::set<int> taken_;
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
    } else {
      std::string list;
      for (const DriverType& type : driver_types()) {
        list += (list.empty() ? "\"" : ", \"") + type.name + '"';
      }
      reader.complain("world/unknown-driver", "type", "a driver that there is: " + list,
                      '"' + driver.type + '"');
    }
  }
  positions.fill(drivers.goal_drivers);
  planners.fill(drivers.planners);
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

const std::vector<DriverType>& driver_types() {
  static const auto* const types = [] {
    auto* made = new std::vector<DriverType>;
    for (const GoalDriverKind& kind : goal_driver_kinds()) {
      made->push_back({kind.name, &kind.fields(), true});
    }
    made->push_back({PlannerInfo::type(), &sim::fields_of<WavefrontSettings>(), false});
    return made;
  }();
  return *types;
}

double unit_of_setting(const sim::Field& field) { return field.is_angle ? kDegree_rad : 1.0; }

std::string fault_of(const sim::FieldTable& table, const void* settings) {
  for (const sim::Field& field : table.fields) {
    const void* const value = field.get(settings);
    if (value == nullptr || field.type == sim::FieldType::kBool) continue;
    if (field.type == sim::FieldType::kInt) {
      const std::int64_t number = sim::integer_at(field, value);
      if (number >= field.least && number <= field.greatest) continue;
      return std::string(field.name) + " must be " + range_of(field) + ", but is " +
             std::to_string(number);
    }
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
