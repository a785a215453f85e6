// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/io/field_reader.h"

#include <algorithm>
#include <string>
#include <vector>

#include "sim/core/assert.h"

namespace sim::io {
namespace {

double read_number(Reader& settings, const Field& field, double fallback) {
  if (!field.is_angle) return settings.number(field.name, fallback, field.range);
  const bool is_bounded = field.range.min > NumberRange{}.min;
  if (is_bounded) return settings.angle_deg(field.name, fallback, field.range);
  return normalize_angle(settings.angle_deg(field.name, fallback));  // a direction
}

void read_choice(Reader& settings, const Field& field, void* value) {
  const std::vector<std::string> words(field.words.begin(), field.words.end());
  const auto now = static_cast<std::size_t>(integer_at(field, value));
  const std::string word = settings.choice(field.name, words.at(now), words);
  set_integer(field, value, std::find(words.begin(), words.end(), word) - words.begin());
}

void read_text(Reader& settings, const Field& field, std::string& text) {
  if (field.needed_for == nullptr) {
    text = settings.string(field.name, text);
  } else if (settings.require(field.name, field.needed_for)) {
    text = settings.name(field.name, "");
  }
}

void read_optional_pose(Reader& settings, const Field& field, void* object) {
  std::optional<Reader> place = settings.child(field.name);
  if (!place) return;
  const Pose pose = settings.pose(field.name, {});
  if (place->has("x") || place->has("y") || place->has("yaw_deg")) {
    *static_cast<Pose*>(field.set(object)) = pose;
  } else {
    field.drop(object);
  }
}

void read_element(Reader& element, const Field& field, void* list) {
  if (field.type == FieldType::kPoses) {
    static_cast<std::vector<Pose>*>(list)->push_back(element.as_pose({}));
  } else if (field.element == nullptr) {
    void* const made = field.list->append(list);
    if (!element.expect_object()) return;
    read_fields(element, field.table(), made);
    element.finish();
  } else if (!field.element->read(element, field.list->append(list))) {
    element.issue(field.issue_id, field.issue_expected, element.description_for_message());
  }
}

/// A list in the file replaces the default list as a whole.
void read_list(Reader& settings, const Field& field, void* list) {
  std::optional<Reader> place = settings.child(field.name);
  if (!place) return;
  const bool has_min_count = field.min_count > 0;
  std::vector<Reader> elements =
      has_min_count ? settings.array(field.name) : settings.array(field.name, field.max_count);
  if (!place->is_array()) return;
  if (elements.size() < field.min_count || elements.size() > field.max_count) {
    place->issue(field.issue_id, field.issue_expected,
                 "a list of " + std::to_string(elements.size()));
    return;
  }
  field.list->clear(list);
  for (Reader& element : elements) read_element(element, field, list);
}

void read_field(Reader& settings, const Field& field, void* object) {
  if (field.type == FieldType::kPose && field.drop != nullptr) {
    return read_optional_pose(settings, field, object);
  }
  if (field.drop != nullptr && !settings.has(field.name)) return;
  void* const value = field.set(object);
  switch (field.type) {
    case FieldType::kNumber:
      *static_cast<double*>(value) = read_number(settings, field, *static_cast<double*>(value));
      return;
    case FieldType::kInt:
      set_integer(
          field, value,
          settings.integer(field.name, integer_at(field, value), field.least, field.greatest));
      return;
    case FieldType::kBool:
      *static_cast<bool*>(value) = settings.boolean(field.name, *static_cast<bool*>(value));
      return;
    case FieldType::kText:
      return read_text(settings, field, *static_cast<std::string*>(value));
    case FieldType::kChoice:
      return read_choice(settings, field, value);
    case FieldType::kColour:
      *static_cast<Colour*>(value) = settings.colour(field.name, *static_cast<Colour*>(value));
      return;
    case FieldType::kVec2: {
      auto& point = *static_cast<Vec2*>(value);
      point = field.name[0] != '\0' ? settings.vec2(field.name, point, field.range)
                                    : Vec2(settings.number("x", point.x(), field.range),
                                           settings.number("y", point.y(), field.range));
      return;
    }
    case FieldType::kPose:
      *static_cast<Pose*>(value) = settings.pose(field.name, *static_cast<Pose*>(value));
      return;
    case FieldType::kPoses:
    case FieldType::kList:
      return read_list(settings, field, value);
    case FieldType::kInclude:
      return read_fields(settings, field.table(), value);
    case FieldType::kCustom:
      return field.custom->read(settings, field, value);
    default:
      SIM_ASSERT(false);  // other types occur in messages only
  }
}

}  // namespace

void read_fields(Reader& settings, const FieldTable& table, void* object) {
  for (const Field& field : table.fields) {
    if (!field.read_only) read_field(settings, field, object);
  }
  if (table.check == nullptr) return;
  if (std::optional<FieldError> error = table.check(object)) {
    settings.issue(error->id, error->expected, error->found, error->hint, error->key);
  }
}

}  // namespace sim::io
