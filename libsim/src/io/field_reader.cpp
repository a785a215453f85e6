// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "sim/io/field_reader.h"

#include <algorithm>
#include <string>
#include <vector>

#include "io/document.h"
#include "sim/core/assert.h"
#include "sim/core/time.h"

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
  const bool is_bool = field.type == FieldType::kBool;
  const std::size_t now = is_bool ? (*static_cast<bool*>(value) == field.first_word ? 0 : 1)
                                  : static_cast<std::size_t>(integer_at(field, value));
  const std::string word = settings.choice(field.name, words.at(now), words);
  const auto index = std::find(words.begin(), words.end(), word) - words.begin();
  if (is_bool) {
    *static_cast<bool*>(value) = (index == 0) == field.first_word;
  } else {
    set_integer(field, value, index);
  }
}

std::string read_name(Reader& element) {
  if (element.is_string()) return *element.scalar_text();
  element.issue("world/wrong-type", "a name in double quotes", element.description_for_message());
  return {};
}

void read_names(Reader& settings, const Field& field, std::vector<std::string>& names) {
  if (!settings.has(field.name)) return;
  names.clear();
  for (Reader& element : settings.array(field.name, field.max_count)) {
    names.push_back(read_name(element));
  }
}

/// A list of some of the words of a field, each once.
void read_words(Reader& settings, const Field& field, std::vector<std::string>& words) {
  const std::optional<Reader> list = settings.child(field.name);
  if (!list) return;
  const std::vector<std::string> known(field.words.begin(), field.words.end());
  std::vector<std::string> known_in_quotes;
  for (const std::string& word : known) known_in_quotes.push_back(in_quotes(word));
  words.clear();
  for (Reader& element : settings.array(field.name)) {
    const std::string word = read_name(element);
    if (!element.is_string()) continue;
    if (std::ranges::find(known, word) == known.end()) {
      const std::string near = nearest_word(word, known);
      element.issue("world/unknown-value", list_text(known_in_quotes), in_quotes(word),
                    near.empty() ? "" : "did you mean " + in_quotes(near) + '?');
    } else if (std::ranges::find(words, word) != words.end()) {
      element.issue("world/unknown-value", "each word once", in_quotes(word) + " again");
    } else {
      words.push_back(word);
    }
  }
  if (list->is_array() && list->elements().size() < field.min_count) {
    settings.issue("world/out-of-range", "at least one of " + list_text(known_in_quotes), "none",
                   "", field.name);
  }
}

void read_points(Reader& settings, const Field& field, std::vector<Vec2>& points) {
  const std::optional<Reader> list = settings.child(field.name);
  if (!list) return;
  points.clear();
  for (Reader& point : settings.array(field.name, field.max_count)) {
    points.push_back(point.as_vec2({0.0, 0.0}, field.range));
  }
  if (field.issue_id == nullptr || !list->is_array() || points.size() >= field.min_count) return;
  settings.issue(field.issue_id, field.issue_expected, list->description_for_message(), "",
                 field.name);
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
    if (!field.kinds.empty()) {
      read_kind(element, field.kinds, field.issue_expected, made);
    } else {
      read_fields(element, field.table(), made);
    }
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

/// An object of elements by name.
void read_keyed_list(Reader& settings, const Field& field, void* list) {
  std::optional<Reader> all = settings.object(field.name);
  if (!all) return;
  field.list->clear(list);
  const Field& name_field = field.table().fields.front();
  for (const std::string& name : all->keys()) {
    if (field.list->size(list) == field.max_count) {
      settings.issue("world/too-many", "at most " + std::to_string(field.max_count), "more", "",
                     field.name);
      return;
    }
    std::optional<Reader> one = all->object(name);
    if (name_field.is_name && !is_valid_name(name)) {
      all->issue("world/bad-name", "a name of 1 to 64 letters, digits, _ or -", in_quotes(name),
                 "English letters only, no blanks", name);
    }
    if (!one) continue;
    void* const made = field.list->append(list);
    *static_cast<std::string*>(name_field.set(made)) = name;
    read_fields(*one, field.table(), made);
    one->finish();
  }
}

/// A struct, as an object of its own, or with its keys among those of its owner.
void read_struct(Reader& settings, const Field& field, void* object) {
  if (*field.name != '\0') {
    std::optional<Reader> own = settings.object(field.name);
    if (!own) return;
    read_fields(*own, field.table(), field.set(object));
    own->finish();
    return;
  }
  bool is_given = field.drop == nullptr;
  for (const Field& one : field.table().fields) is_given |= settings.has(one.name);
  if (is_given) read_fields(settings, field.table(), field.set(object));
}

/// Whether the file leaves a field out. @param object  in which null drops an optional member.
bool is_left_out(Reader& settings, const Field& field, void* object) {
  if (field.needed_for != nullptr) return !settings.require(field.name, field.needed_for);
  if (field.drop == nullptr || *field.name == '\0') return false;
  const std::optional<Reader> value = settings.child(field.name);
  if (!value || !field.may_be_null || !value->is_null()) return !value;
  field.drop(object);
  return true;
}

void read_field(Reader& settings, const Field& field, void* object) {
  if (field.custom != nullptr) {
    field.custom->read(settings, field, object);
  } else {
    read_as_usual(settings, field, object);
  }
}

}  // namespace

void read_as_usual(Reader& settings, const Field& field, void* object) {
  if (field.type == FieldType::kPose && field.drop != nullptr) {
    return read_optional_pose(settings, field, object);
  }
  if (is_left_out(settings, field, object)) return;
  if (field.type == FieldType::kStruct) return read_struct(settings, field, object);
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
    case FieldType::kInt64: {
      auto& time_ns = *static_cast<SimTime*>(value);
      time_ns = from_seconds(settings.number(field.name, to_seconds(time_ns), field.range));
      return;
    }
    case FieldType::kUint64: {
      auto& number = *static_cast<std::uint64_t*>(value);
      number = settings.unsigned_integer(field.name, number);
      return;
    }
    case FieldType::kBool:
      if (!field.words.empty()) return read_choice(settings, field, value);
      *static_cast<bool*>(value) = settings.boolean(field.name, *static_cast<bool*>(value));
      return;
    case FieldType::kText: {
      auto& text = *static_cast<std::string*>(value);
      text = field.is_name ? settings.name(field.name, text) : settings.string(field.name, text);
      return;
    }
    case FieldType::kTexts:
      if (!field.words.empty()) {
        return read_words(settings, field, *static_cast<std::vector<std::string>*>(value));
      }
      return read_names(settings, field, *static_cast<std::vector<std::string>*>(value));
    case FieldType::kPoints:
      return read_points(settings, field, *static_cast<std::vector<Vec2>*>(value));
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
    case FieldType::kPose: {
      auto& pose = *static_cast<Pose*>(value);
      pose = *field.name != '\0' ? settings.pose(field.name, pose) : settings.as_pose(pose);
      return;
    }
    case FieldType::kPoses:
    case FieldType::kList:
      if (field.is_keyed) return read_keyed_list(settings, field, value);
      return read_list(settings, field, value);
    case FieldType::kInclude:
      return read_fields(settings, field.table(), value);
    default:
      SIM_ASSERT(false);  // other types occur in messages only, or have a format of their own
  }
}

std::optional<std::string> only_key(Reader& object, const std::vector<std::string>& keys,
                                    const char* what, bool has_other_keys) {
  std::vector<std::string> found;
  for (const std::string& key : keys) {
    if (object.has(key)) found.push_back(key);
  }
  if (found.size() == 1) return found.front();
  if (found.size() > 1) {
    object.issue("world/conflicting-keys",
                 std::string(what) + " with one of the keys " + list_text(keys),
                 list_text(found, " and "),
                 has_other_keys ? "leave one of them out" : "write an object for each of them");
  } else if (has_other_keys || object.keys().empty()) {
    object.issue("world/missing-key", std::string(what) + ": one of the keys " + list_text(keys),
                 "none");
  }
  return std::nullopt;
}

void read_kind(Reader& object, std::span<const Kind> kinds, const char* what, void* value) {
  std::vector<std::string> keys;
  for (const Kind& kind : kinds) keys.emplace_back(kind.word);
  const std::optional<std::string> key = only_key(object, keys, what);
  if (!key) return;
  const Kind& kind = *std::find_if(kinds.begin(), kinds.end(),
                                   [&key](const Kind& one) { return one.word == *key; });
  void* const made = kind.make(value);
  if (kind.is_bare) return read_fields(object, kind.table(), made);
  std::optional<Reader> own = object.object(kind.word);
  if (!own) return;
  read_fields(*own, kind.table(), made);
  own->finish();
}

void read_typed(Reader& object, const char* key, std::span<const Kind> kinds, void* value) {
  std::vector<std::string> words;
  for (const Kind& kind : kinds) words.emplace_back(kind.word);
  const std::string word = object.choice(key, words.front(), words);
  const Kind& kind = *std::find_if(kinds.begin(), kinds.end(),
                                   [&word](const Kind& one) { return one.word == word; });
  read_fields(object, kind.table(), kind.make(value));
}

void read_named(Reader& settings, const FieldTable& table,
                std::initializer_list<std::string_view> keys, void* object) {
  for (const std::string_view key : keys) read_field(settings, field_named(table, key), object);
}

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
