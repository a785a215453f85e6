// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "io/stage/report.h"

#include <algorithm>
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

const Value* Properties::single(std::string_view name, bool text, const char* expected) const {
  const Property* property = entity_.find(name);
  if (property == nullptr) return nullptr;
  // Stage takes the first number of a tuple for a number.
  if (property->values.empty() || property->values.front().is_text != text) {
    report_.error(property->place, "stage/wrong-type",
                  std::string(expected) + " for " + in_quotes(name), described(*property));
    return nullptr;
  }
  return &property->values.front();
}

double Properties::number(std::string_view name, double fallback) const {
  const Value* value = single(name, false, "a number");
  return value == nullptr ? fallback : value->number;
}

double Properties::length_m(std::string_view name, double fallback_m) const {
  const Value* value = single(name, false, "a length");
  return value == nullptr ? fallback_m : value->number * units_.length_m;
}

double Properties::angle_rad(std::string_view name, double fallback_rad) const {
  const Value* value = single(name, false, "an angle");
  return value == nullptr ? fallback_rad : value->number * units_.angle_rad;
}

int Properties::integer(std::string_view name, int fallback) const {
  const Value* value = single(name, false, "a whole number");
  if (value == nullptr) return fallback;
  return static_cast<int>(std::clamp(std::trunc(value->number), -2e9, 2e9));
}

bool Properties::flag(std::string_view name, bool fallback) const {
  const Property* property = entity_.find(name);
  if (property == nullptr) return fallback;
  if (!property->values.empty() && property->values.front().is_text) {  // Stage 2 has "visible"
    const std::string& text = property->values.front().text;
    if (text == "true" || text == "visible") return true;
    if (text == "false" || text == "invisible") return false;
  }
  const Value* value = single(name, false, "0 or 1");
  return value == nullptr ? fallback : value->number != 0.0;
}

std::string Properties::text(std::string_view name, const std::string& fallback) const {
  const Value* value = single(name, true, "a text in double quotes");
  return value == nullptr ? fallback : value->text;
}

std::vector<std::string> Properties::texts(std::string_view name) const {
  std::vector<std::string> all;
  const Property* property = entity_.find(name);
  if (property == nullptr) return all;
  for (const Value& value : property->values) {
    if (value.is_text) {
      all.push_back(value.text);
    } else {
      report_.error(value.place, "stage/wrong-type", "a text in double quotes", value.text);
    }
  }
  return all;
}

std::vector<double> Properties::numbers(std::string_view name, std::size_t most) const {
  std::vector<double> all;
  const Property* property = entity_.find(name);
  if (property == nullptr) return all;
  for (const Value& value : property->values) {
    if (all.size() >= most) break;
    if (value.is_text) {
      report_.error(value.place, "stage/wrong-type", "a number in the tuple " + in_quotes(name),
                    in_quotes(value.text));
      return {};
    }
    all.push_back(value.number);
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
  const Value* value = single(name, true, "a text in double quotes");
  if (value == nullptr) return fallback;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (words[i] == value->text) return i;
  }
  report_.error(value->place, "stage/wrong-type", list_text(words) + " for " + in_quotes(name),
                in_quotes(value->text));
  return fallback;
}

}  // namespace sim::io::stage
