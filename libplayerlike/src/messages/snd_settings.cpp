// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "playerlike/messages/snd_settings.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>
#include <optional>
#include <set>
#include <sstream>
#include <string_view>

#include "playerlike/messages/messages.h"
#include "sim/core/error.h"
#include "sim/core/number_text.h"

namespace playerlike {
namespace {

constexpr double kDegree_rad = std::numbers::pi / 180.0;
constexpr int kMaxIndex = 65535;

std::string number_text(double value) { return sim::rounded_text(value, 6); }

// The unit of a setting in a world file, in SI units.
double unit_of(const SndSettingRow& row) {
  return std::string_view(row.key).ends_with("_deg") ? kDegree_rad : 1.0;
}

std::string range_of(const SndSettingRow& row) {
  return "greater than " + number_text(row.above / unit_of(row)) + " and at most " +
         number_text(row.at_most / unit_of(row)) + " " + row.unit;
}

bool is_in_range(const SndSettingRow& row, double value) {
  return value > row.above && value <= row.at_most;
}

template <typename Number>
std::optional<Number> parsed(const std::string& text) {
  Number value{};
  const char* end = text.data() + text.size();
  const auto [at, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || at != end) return std::nullopt;
  return value;
}

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

  [[nodiscard]] SndDriverDescription read(const SndSettings& defaults) {
    SndDriverDescription read;
    read.settings = defaults;
    std::vector<std::string> known{"index", "position", "laser"};
    for (const SndSettingRow& row : snd_setting_table()) {
      known.emplace_back(row.key);
      number(row, read.settings);
    }
    index("index", read.index);
    index("position", read.position);
    index("laser", read.laser);
    for (const auto& [key, text] : driver_.settings) {
      if (std::find(known.begin(), known.end(), key) != known.end()) continue;
      std::string list;
      for (const std::string& name : known) list += (list.empty() ? "" : ", ") + name;
      const std::string near = sim::nearest_word(key, known);
      complain("world/unknown-key", key, "one of the settings of \"snd\": " + list,
               "the unknown key \"" + key + '"',
               near.empty() ? "" : "did you mean \"" + near + "\"?");
    }
    return read;
  }

 private:
  [[nodiscard]] const std::string* find(const std::string& key) const {
    const auto it = driver_.settings.find(key);
    return it == driver_.settings.end() ? nullptr : &it->second;
  }

  void number(const SndSettingRow& row, SndSettings& settings) {
    const std::string* text = find(row.key);
    if (text == nullptr) return;
    const std::string expected = "a number " + range_of(row);
    const std::optional<double> value = parsed<double>(*text);
    if (!value) {
      complain("world/wrong-type", row.key, expected, '"' + *text + '"');
    } else if (!is_in_range(row, *value * unit_of(row))) {
      complain("world/out-of-range", row.key, expected, *text);
    } else {
      settings.*row.value = *value * unit_of(row);
    }
  }

  void index(const std::string& key, int& index) {
    const std::string* text = find(key);
    if (text == nullptr) return;
    const std::string expected = "a whole number from 0 to " + std::to_string(kMaxIndex);
    const std::optional<int> value = parsed<int>(*text);
    if (!value) {
      complain("world/wrong-type", key, expected, '"' + *text + '"');
    } else if (*value < 0 || *value > kMaxIndex) {
      complain("world/out-of-range", key, expected, *text);
    } else {
      index = *value;
    }
  }

  const sim::DriverDescription& driver_;
  std::string file_;
  std::string pointer_;
  std::vector<sim::ConfigIssue>& issues_;
};

int count_of(const sim::RobotDescription& robot, std::string_view interface) {
  return static_cast<int>(
      std::count_if(robot.devices.begin(), robot.devices.end(),
                    [&](const auto& device) { return carries(device.type, interface); }));
}

std::vector<SndDriverDescription> read_all(const sim::RobotDescription& robot,
                                           const std::string& file, const std::string& pointer,
                                           const SndSettings& defaults,
                                           std::vector<sim::ConfigIssue>& issues) {
  std::vector<SndDriverDescription> drivers;
  const int positions = count_of(robot, "position2d");
  const int lasers = count_of(robot, "laser");
  const bool has_motors = std::any_of(robot.devices.begin(), robot.devices.end(),
                                      [](const auto& device) { return device.type == "motion"; });
  std::set<int> taken;
  for (int i = 0; i < positions; ++i) taken.insert(i);
  for (std::size_t d = 0; d < robot.drivers.size(); ++d) {
    const sim::DriverDescription& driver = robot.drivers[d];
    DriverReader reader(driver, file, pointer + "/drivers/" + std::to_string(d), issues);
    if (driver.type != "snd") {
      reader.complain("world/unknown-driver", "type", "a driver that there is: \"snd\"",
                      '"' + driver.type + '"');
      drivers.emplace_back();
      continue;
    }
    SndDriverDescription read = reader.read(defaults);
    const auto need = [&](const char* key, int index, int count, const char* what) {
      if (index < count) return;
      reader.complain("world/driver-device", key,
                      count == 0 ? std::string("a robot with a ") + what
                                 : std::string("the index of one of the robot's ") +
                                       std::to_string(count) + " devices that are a " + what,
                      count == 0 ? "none" : std::to_string(index));
    };
    need("position", read.position, positions, "position2d");
    need("laser", read.laser, lasers, "laser");
    if (!has_motors) {
      reader.complain("world/driver-device", "", "a robot with motors (a device \"motion\")",
                      "none");
    }
    if (read.index >= 0 && !taken.insert(read.index).second) {
      reader.complain("world/driver-index", "index",
                      "an index that no other position2d of the robot has",
                      std::to_string(read.index),
                      "devices have 0 to " + std::to_string(positions - 1) +
                          "; without an index a driver takes the first free one");
    }
    drivers.push_back(read);
  }
  int next = 0;
  for (SndDriverDescription& driver : drivers) {
    if (driver.index >= 0) continue;
    while (!taken.insert(next).second) ++next;
    driver.index = next;
  }
  return drivers;
}

}  // namespace

const std::vector<SndSettingRow>& snd_setting_table() {
  static const std::vector<SndSettingRow> kTable = {
      {"robot_radius", "m", &SndSettings::robot_radius_m, 0.0, 10.0},
      {"safety_distance", "m", &SndSettings::safety_distance_m, 0.0, 10.0},
      {"max_speed", "m/s", &SndSettings::max_speed_mps, 0.0, 10.0},
      {"max_turn_rate_deg", "degrees/s", &SndSettings::max_turn_rate_radps, 0.0,
       3600.0 * kDegree_rad},
      {"goal_distance", "m", &SndSettings::goal_distance_m, 0.0, 10.0},
      {"goal_angle_deg", "degrees", &SndSettings::goal_angle_rad, 0.0, std::numbers::pi},
      {"patience", "s", &SndSettings::patience_s, 0.0, 1e6},
  };
  return kTable;
}

SndSettings snd_settings_for(double radius_m, double max_speed_mps, double max_turn_rate_radps) {
  constexpr double kRounding = 1e-6;  // a radius of whole centimetres is not rounded up
  constexpr double kSpeedShare = 0.6;
  constexpr double kTurnShare = 0.5;
  SndSettings settings;
  if (radius_m > 0.0) {
    const double radius_cm = std::max(1.0, std::ceil(100.0 * radius_m - kRounding));
    settings.robot_radius_m = radius_cm / 100.0;
    settings.safety_distance_m = 1.5 * radius_cm / 100.0;
  }
  if (max_speed_mps > 0.0) settings.max_speed_mps = kSpeedShare * max_speed_mps;
  if (max_turn_rate_radps > 0.0) settings.max_turn_rate_radps = kTurnShare * max_turn_rate_radps;
  for (const SndSettingRow& row : snd_setting_table()) {
    settings.*row.value = std::min(settings.*row.value, row.at_most);
  }
  return settings;
}

std::string fault_of(const SndSettings& settings) {
  for (const SndSettingRow& row : snd_setting_table()) {
    const double value = settings.*row.value;
    if (is_in_range(row, value)) continue;
    return std::string(row.key) + " must be " + range_of(row) + ", but is " +
           number_text(value / unit_of(row));
  }
  return "";
}

std::vector<SndDriverDescription> read_drivers(const sim::RobotDescription& robot,
                                               const std::string& file, const std::string& pointer,
                                               const SndSettings& defaults) {
  std::vector<sim::ConfigIssue> issues;
  std::vector<SndDriverDescription> drivers = read_all(robot, file, pointer, defaults, issues);
  if (!issues.empty()) throw sim::ConfigError(std::move(issues));
  return drivers;
}

void check_drivers(const sim::WorldDescription& world) {
  std::vector<sim::ConfigIssue> issues;
  for (std::size_t r = 0; r < world.robots.size(); ++r) {
    read_all(world.robots[r], world.file, "/robots/" + std::to_string(r), {}, issues);
  }
  if (!issues.empty()) throw sim::ConfigError(std::move(issues));
}

}  // namespace playerlike
