// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "io/stage/report.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include "io/document.h"

namespace sim::io::stage {

void Report::error(const Place& place, std::string id, std::string expected, std::string found,
                   std::string hint) {
  if (errors_.size() >= kMaxIssues) return;
  errors_.push_back(
      issue_at(place, std::move(id), std::move(expected), std::move(found), std::move(hint)));
}

void Report::note(const std::string& topic, const Place& place, const std::string& text) {
  const auto [known, is_new] = topics_.emplace(topic, notes_.size());
  if (is_new) {
    notes_.push_back({place, text});
  } else {
    ++notes_[known->second].more;
  }
}

void Report::look(const std::string& name, const Place& place) {
  if (look_.empty()) look_place_ = place;
  if (std::find(look_.begin(), look_.end(), name) == look_.end()) look_.push_back(name);
}

std::vector<std::string> Report::notes() const {
  const auto line = [](const Place& place, const std::string& text) {
    return (place.file ? *place.file : "") + ":" + std::to_string(place.line) + ": " + text;
  };
  std::vector<std::string> all;
  for (const Note& note : notes_) {
    all.push_back(line(note.place, note.text));
    if (note.more > 0) all.back() += " (and " + std::to_string(note.more) + " more)";
  }
  if (!look_.empty()) {
    all.push_back(
        line(look_place_, "the look of Stage's window is left out: " + list_text(look_, " and ")));
  }
  return all;
}

namespace {

/// The number that a value is: one without quotes, or as in Stage a text of digits.
std::optional<double> number_of(const Value& value) {
  if (!value.is_text) return value.number;
  std::string_view text = value.text;
  while (text.starts_with(' ')) text.remove_prefix(1);
  while (text.ends_with(' ')) text.remove_suffix(1);
  if (text.starts_with('+')) text.remove_prefix(1);
  double number = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  const bool whole = error == std::errc() && end == text.data() + text.size();
  return whole && std::isfinite(number) ? std::optional(number) : std::nullopt;
}

std::string described(const Property& property) {
  if (property.is_tuple) return "a tuple of " + std::to_string(property.values.size());
  const Value& value = property.values.front();
  return value.is_text ? in_quotes(value.text) : value.text;
}

}  // namespace

const Place& Properties::place_of(std::string_view name) const {
  const Property* property = entity_.find(name);
  return property == nullptr ? entity_.place : property->place;
}

double Properties::unit(char kind) const {
  if (kind == 'l') return units_.length_m;
  return kind == 'a' ? units_.angle_rad : 1.0;
}

void Properties::wrong_type(const Property& property, const char* expected) const {
  report_.error(property.place, "stage/wrong-type",
                std::string(expected) + " for " + in_quotes(property.name), described(property));
}

std::optional<double> Properties::single(std::string_view name, const char* expected) const {
  const Property* property = entity_.find(name);
  if (property == nullptr) return std::nullopt;
  // Stage takes the first number of a tuple for a number.
  std::optional<double> number;
  if (!property->values.empty()) number = number_of(property->values.front());
  if (!number) wrong_type(*property, expected);
  return number;
}

double Properties::number(std::string_view name, double fallback) const {
  return single(name, "a number").value_or(fallback);
}

double Properties::length_m(std::string_view name, double fallback_m) const {
  const std::optional<double> value = single(name, "a length");
  return value ? *value * units_.length_m : fallback_m;
}

double Properties::angle_rad(std::string_view name, double fallback_rad) const {
  const std::optional<double> value = single(name, "an angle");
  return value ? *value * units_.angle_rad : fallback_rad;
}

int Properties::integer(std::string_view name, int fallback) const {
  const std::optional<double> value = single(name, "a whole number");
  return value ? static_cast<int>(std::clamp(std::trunc(*value), -2e9, 2e9)) : fallback;
}

bool Properties::flag(std::string_view name, bool fallback) const {
  const Property* property = entity_.find(name);
  if (property == nullptr) return fallback;
  if (!property->values.empty() && property->values.front().is_text) {
    // Stage 2 has "visible"; Player has true, false, yes and no.
    const std::string& text = property->values.front().text;
    if (text == "true" || text == "yes" || text == "visible") return true;
    if (text == "false" || text == "no" || text == "invisible") return false;
  }
  const std::optional<double> value = single(name, "0 or 1");
  return value ? *value != 0.0 : fallback;
}

std::string Properties::text(std::string_view name, const std::string& fallback) const {
  const Property* property = entity_.find(name);
  if (property == nullptr) return fallback;
  if (!property->values.empty()) return property->values.front().text;  // of a number its digits
  wrong_type(*property, "a text in double quotes");
  return fallback;
}

std::vector<std::string> Properties::texts(std::string_view name) const {
  std::vector<std::string> all;
  const Property* property = entity_.find(name);
  if (property == nullptr) return all;
  for (const Value& value : property->values) all.push_back(value.text);
  return all;
}

std::vector<double> Properties::numbers(std::string_view name, std::size_t most) const {
  std::vector<double> all;
  const Property* property = entity_.find(name);
  if (property == nullptr) return all;
  for (const Value& value : property->values) {
    if (all.size() >= most) break;
    const std::optional<double> number = number_of(value);
    if (!number) {
      report_.error(value.place, "stage/wrong-type", "a number in the tuple " + in_quotes(name),
                    in_quotes(value.text));
      return {};
    }
    all.push_back(*number);
  }
  return all;
}

Pose3 Properties::pose(std::string_view name, const Pose3& fallback) const {
  const std::vector<double> given = numbers(name, 4);
  Pose3 result = fallback;
  if (!given.empty()) result.pose.x_m = given[0] * units_.length_m;
  if (given.size() > 1) result.pose.y_m = given[1] * units_.length_m;
  if (given.size() == 3 && units_.three_number_poses_turn) {
    result.pose.yaw_rad = normalize_angle(given[2] * units_.angle_rad);
    return result;
  }
  if (given.size() > 2) result.z_m = given[2] * units_.length_m;
  if (given.size() > 3) result.pose.yaw_rad = normalize_angle(given[3] * units_.angle_rad);
  return result;
}

std::size_t Properties::choice(std::string_view name, std::size_t fallback,
                               const std::vector<std::string>& words) const {
  if (!has(name)) return fallback;
  const std::string given = text(name, "");
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (words[i] == given) return i;
  }
  report_.note(std::string(name) + " " + given, place_of(name),
               std::string(name) + " " + in_quotes(given) + " is not one of " + list_text(words) +
                   "; " + in_quotes(words[fallback]) + " is used, as in Stage");
  return fallback;
}

}  // namespace sim::io::stage
