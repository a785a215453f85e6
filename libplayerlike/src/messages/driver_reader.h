// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "playerlike/messages/driver_settings.h"
#include "playerlike/messages/messages.h"
#include "sim/core/error.h"
#include "sim/core/number_text.h"
#include "sim/io/player_options.h"

/// @file
/// Reads the entries of a robot's `drivers` table and collects their errors.
namespace playerlike {

inline constexpr int kMaxIndex = 65535;
inline constexpr const char* kNoDevice = "none";

inline std::string number_text(double value) { return sim::rounded_text(value, 6); }

inline std::string range_of(const sim::Field& field) {
  const sim::NumberRange& range = field.range;
  const std::string unit = *range.unit == '\0' ? "" : std::string(" ") + range.unit;
  const std::string most = number_text(range.max) + unit;
  return range.min_exclusive ? "greater than " + number_text(range.min) + " and at most " + most
                             : "from " + number_text(range.min) + " to " + most;
}

inline bool is_in_range(const sim::Field& field, double value) {
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

/// What the drivers of a robot depend on.
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

/// Reads one driver and collects its errors.
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
      std::string hint = sim::hint_for_player_option(driver_.type, key);
      if (const std::string near = sim::nearest_word(key, known_); hint.empty() && !near.empty()) {
        hint = "did you mean \"" + near + "\"?";
      }
      complain("world/unknown-key", key, "one of the settings of \"" + driver_.type + "\": " + list,
               "the unknown key \"" + key + '"', hint);
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

/// The indices of an interface on a robot's port.
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

}  // namespace playerlike
