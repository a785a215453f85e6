// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sim/core/degrees.h"
#include "sim/core/fields.h"
#include "sim/core/number_text.h"
#include "sim/core/time.h"
#include "sim/devices/builtin.h"
#include "sim/io/field_reader.h"

/// Documents generated from the tables of fields: tables of settings in Markdown for users, and
/// JSON schemas for editors.
namespace sim::test {

using Json = nlohmann::ordered_json;

/// A number with at most 12 digits, so that 171.88733853924697 degrees look like 171.887338539.
[[nodiscard]] inline Json rounded(double value) {
  return Json::parse(rounded_text(value + 0.0, 12));
}

/// A pose in the format of world files.
[[nodiscard]] inline Json pose_json(const Pose& pose, bool with_zeros) {
  Json out = Json::object();
  if (with_zeros || pose.x_m != 0.0) out["x"] = rounded(pose.x_m);
  if (with_zeros || pose.y_m != 0.0) out["y"] = rounded(pose.y_m);
  if (with_zeros || pose.yaw_rad != 0.0) out["yaw_deg"] = rounded(pose.yaw_rad / kDegrees);
  return out;
}

[[nodiscard]] inline Json vec2_json(const Vec2& point) {
  return Json::array({rounded(point.x()), rounded(point.y())});
}

[[nodiscard]] Json object_json(const FieldTable& table, const void* object);

/// An element of a list, or the value of a key of a list by names.
[[nodiscard]] inline Json element_json(const Field& field, const void* element) {
  if (field.type == FieldType::kPoses) return pose_json(*static_cast<const Pose*>(element), false);
  if (field.element != nullptr) return Json::parse(field.element->text(element));
  if (field.kinds.empty()) return object_json(field.table(), element);
  for (const Kind& kind : field.kinds) {
    const void* const object = kind.find(element);
    if (object == nullptr) continue;
    Json value = object_json(kind.table(), object);
    return kind.is_bare ? value : Json{{kind.word, value}};
  }
  return nullptr;
}

[[nodiscard]] inline Json list_json(const Field& field, const void* list) {
  Json all = field.is_keyed ? Json::object() : Json::array();
  for (std::size_t i = 0; i < field.list->size(list); ++i) {
    const void* element = field.list->at(list, i);
    if (field.is_keyed) {
      const auto* name = static_cast<const std::string*>(field.table().fields[0].get(element));
      all[*name] = element_json(field, element);
    } else {
      all.push_back(element_json(field, element));
    }
  }
  return all;
}

/// The value of a setting in the format of world files.
[[nodiscard]] inline Json value_json(const Field& field, const void* object) {
  const void* value = field.get(object);
  if (value == nullptr) return Json::object();
  switch (field.type) {
    case FieldType::kNumber:
      return rounded(*static_cast<const double*>(value) / (field.is_angle ? kDegrees : 1.0));
    case FieldType::kInt:
      return integer_at(field, value);
    case FieldType::kInt64:
      return rounded(to_seconds(*static_cast<const SimTime*>(value)));
    case FieldType::kUint64:
      return *static_cast<const std::uint64_t*>(value);
    case FieldType::kBool: {
      const bool is_set = *static_cast<const bool*>(value);
      if (field.words.empty()) return is_set;
      return field.words[is_set == field.first_word ? 0 : 1];
    }
    case FieldType::kTexts:
      return *static_cast<const std::vector<std::string>*>(value);
    case FieldType::kPoints: {
      Json list = Json::array();
      for (const Vec2& point : *static_cast<const std::vector<Vec2>*>(value)) {
        list.push_back(vec2_json(point));
      }
      return list;
    }
    case FieldType::kStruct:
      return object_json(field.table(), value);
    case FieldType::kText:
      return *static_cast<const std::string*>(value);
    case FieldType::kChoice:
      return field.words[static_cast<std::size_t>(integer_at(field, value))];
    case FieldType::kColour:
      return to_string(*static_cast<const Colour*>(value));
    case FieldType::kVec2:
      return vec2_json(*static_cast<const Vec2*>(value));
    case FieldType::kPose:
      return pose_json(*static_cast<const Pose*>(value), true);
    case FieldType::kPoses:
    case FieldType::kList:
      return list_json(field, value);
    default:
      return Json::parse(field.custom->text(value));
  }
}

/// The fields of a struct as read_fields() reads them, without those that have a format of their
/// own.
[[nodiscard]] inline Json object_json(const FieldTable& table, const void* object) {
  Json made = Json::object();
  for_each_field(table, object, [&made](const Field& field, const void* owner) {
    if (field.read_only || field.custom != nullptr || field.get(owner) == nullptr) return;
    const Json value = value_json(field, owner);
    if (*field.name == '\0') {
      made.update(value);
    } else {
      made[field.name] = value;
    }
  });
  return made;
}

/// JSON in lines of at most 200 characters, where its structure allows it.
[[nodiscard]] inline std::string json_text(const Json& value, std::size_t indent = 0,
                                           std::size_t before = 0) {
  constexpr std::size_t kWidth = 200;
  if (!value.is_structured() || value.empty()) return value.dump();
  const char* const brackets = value.is_object() ? "{}" : "[]";
  const auto joined = [&](const std::string& separator, std::size_t inner, bool nested) {
    std::string text;
    for (const auto& [key, member] : value.items()) {
      const std::string name = value.is_object() ? Json(key).dump() + ": " : "";
      text += (text.empty() ? "" : "," + separator) + name +
              json_text(member, inner, nested ? inner + name.size() : kWidth);
    }
    return text;
  };
  // Members that do not fit separately do not fit together either.
  std::string line =
      value.dump().size() > kWidth ? "" : brackets[0] + joined(" ", 0, false) + brackets[1];
  line = line.find('\n') == std::string::npos ? line : "";
  if (!line.empty() && before + line.size() <= kWidth) return line;
  const std::string margin = "\n" + std::string(indent + 2, ' ');
  return brackets[0] + margin + joined(margin, indent + 2, true) + "\n" + std::string(indent, ' ') +
         brackets[1];
}

/// JSON in one line: {"x": 1, "y": 2}.
[[nodiscard]] inline std::string line_of_json(const Json& value) {
  if (!value.is_structured()) return value.dump();
  std::string text;
  for (const auto& [key, member] : value.items()) {
    text += text.empty() ? "" : ", ";
    if (value.is_object()) text += Json(key).dump() + ": ";
    text += line_of_json(member);
  }
  return value.is_object() ? "{" + text + "}" : "[" + text + "]";
}

/// "(0, 1000]", or a dash if the field has no numeric range.
[[nodiscard]] inline std::string range_text(const Field& field) {
  const bool has_range = field.type == FieldType::kInt ||
                         (field.type == FieldType::kNumber && field.range.min > NumberRange{}.min);
  if (!has_range) return "–";
  return std::string(field.range.min_exclusive ? "(" : "[") + rounded_text(field.range.min, 12) +
         ", " + rounded_text(field.range.max, 12) + "]";
}

/// The default of a field of a world; nullopt if it has none, or if it depends on others.
[[nodiscard]] inline std::optional<Json> default_json(const Field& field, const void* object) {
  if (field.set == nullptr || *field.default_text != '\0' || field.needed_for != nullptr) return {};
  const void* const value = field.get(object);
  if (value == nullptr) return field.may_be_null ? std::optional<Json>(nullptr) : std::nullopt;
  switch (field.type) {
    case FieldType::kMap:
    case FieldType::kStruct:
    case FieldType::kVariant:
      return {};
    case FieldType::kNumber: {
      const double number = *static_cast<const double*>(value) / (field.is_angle ? kDegrees : 1.0);
      if (!std::isfinite(number) || number < field.range.min) return {};
      return Json::parse(rounded_text(number, 9));
    }
    case FieldType::kInt:
      if (integer_at(field, value) < field.least) return {};
      break;
    default:
      break;
  }
  Json json = value_json(field, object);
  if (json.is_structured() ? json.empty() : json == "") return {};
  return json;
}

/// The values that a field of a world may have: "(0, 1000]", or the words of a choice, or the
/// number of elements.
[[nodiscard]] inline std::string values_text(const Field& field) {
  const auto counted = [&field](const std::string& what) -> std::string {
    constexpr std::size_t kAny = Field{"", FieldType::kList}.max_count;
    if (field.max_count == kAny) return "–";
    return (field.min_count > 0 ? std::to_string(field.min_count) + " to " : "at most ") +
           std::to_string(field.max_count) + what;
  };
  Json words = std::vector<std::string>(field.words.begin(), field.words.end());
  if (field.custom != nullptr) {
    const Json schema = Json::parse("{" + std::string(field.custom->schema) + "}");
    if (schema.contains("enum")) words = schema["enum"];
  }
  std::string text;
  for (const Json& word : words) text += (text.empty() ? "`" : ", `") + word.dump() + "`";
  if (!text.empty()) return text;
  switch (field.type) {
    case FieldType::kText:
      return counted(" bytes");
    case FieldType::kTexts:
    case FieldType::kPoints:
    case FieldType::kList:
      return counted("");
    case FieldType::kVec2:
    case FieldType::kInt64: {
      Field number = field;
      number.type = FieldType::kNumber;
      return range_text(number);
    }
    default:
      return range_text(field);
  }
}

/// A row of a table of fields.
[[nodiscard]] inline std::string field_row(const Field& field, const std::string& range,
                                           const std::string& default_value) {
  const std::string unit = field.range.unit;
  return "| `" + std::string(field.name) + "` | " + (unit.empty() ? "–" : unit) + " | " + range +
         " | " + default_value + " | " + field.meaning + " |\n";
}
inline constexpr const char* kFieldTableHead =
    "| key | unit | range | default | meaning |\n|---|---|---|---|---|\n";

/// The table of the fields of a part of worlds.
/// @param only  its keys; empty: all.
[[nodiscard]] inline std::string fields_table(const FieldTable& table, const void* defaults,
                                              std::span<const std::string> only = {}) {
  std::string rows = kFieldTableHead;
  for_each_field(table, defaults, [&](const Field& field, const void* owner) {
    if (field.custom != nullptr && field.custom->keys != nullptr) {
      rows += fields_table(field.custom->keys(), field.get(owner))
                  .substr(std::string(kFieldTableHead).size());
      return;
    }
    if (field.read_only && !field.is_read_apart) return;
    if (!only.empty() && std::find(only.begin(), only.end(), field.name) == only.end()) return;
    const std::optional<Json> value = default_json(field, owner);
    const std::string words = field.needed_for != nullptr ? "**needed**" : field.default_text;
    rows += field_row(field, values_text(field),
                      value           ? "`" + line_of_json(*value) + "`"
                      : words.empty() ? "–"
                                      : words);
    for (const Kind& kind : field.kinds) {
      if (!kind.is_beside) continue;
      rows += "| `" + std::string(kind.word) + "` | – | – | – | " + kind.meaning + " |\n";
    }
  });
  return rows;
}

/// Visits each setting of a device kind, with the object that holds its default.
template <typename Visit>
void for_each_setting(const DeviceKind& kind, const Visit& visit) {
  const std::any defaults = kind.defaults();
  for_each_field(*kind.settings, kind.settings_in(defaults),
                 [&](const Field& field, const void* owner) {
                   if (!field.read_only) visit(field, owner);
                 });
}

/// The table of settings on a device kind's page; empty if it has none.
[[nodiscard]] inline std::string settings_table(const DeviceKind& kind) {
  std::string rows;
  for_each_setting(kind, [&](const Field& field, const void* defaults) {
    rows +=
        field_row(field, range_text(field), "`" + line_of_json(value_json(field, defaults)) + "`");
  });
  return rows.empty() ? "" : kFieldTableHead + rows;
}

/// The table of docs/realism.md: the figures of all settings that the level of realism changes.
[[nodiscard]] inline std::string realism_table() {
  std::string rows;
  for (const DeviceKind& kind : device_kinds()) {
    for_each_setting(kind, [&](const Field& field, const void*) {
      if (!field.realism) return;
      const std::string unit = field.range.unit;
      rows += "| [" + kind.name + "](devices/" + kind.name + ".md) | `" + field.name + "` | " +
              (unit.empty() ? "–" : unit) + " | " + rounded_text(field.realism->ideal, 12) + " | " +
              rounded_text(field.realism->real, 12) + " |\n";
    });
  }
  return "| device | setting | unit | ideal | real |\n|---|---|---|---|---|\n" + rows;
}

/// The keys of a field in messages: `"x", "y"` if it has no name.
[[nodiscard]] inline std::string keys_text(const Field& field, const char* quote) {
  const auto quoted = [quote](const std::string& key) { return quote + key + quote; };
  if (*field.name != '\0') return quoted(field.name);
  const std::string yaw = field.type == FieldType::kPose ? ", " + quoted("yaw") : "";
  return quoted("x") + ", " + quoted("y") + yaw;
}

/// What messages have as the value of a field.
[[nodiscard]] inline std::string message_value_text(const Field& field) {
  const std::string pose = R"(`{"x", "y", "yaw"}`)";
  std::string list;
  switch (field.type) {
    case FieldType::kNumber:
      return "number";
    case FieldType::kBool:
      return "`true`, `false`";
    case FieldType::kChoice:
      for (const char* word : field.words) {
        list += (list.empty() ? "`\"" : ", `\"") + std::string(word) + "\"`";
      }
      return list;
    case FieldType::kText:
    case FieldType::kColour:
      return "text";
    case FieldType::kVec3:
      return R"(`{"x", "y", "z"}`)";
    case FieldType::kBytes:
      return "bytes";
    case FieldType::kOctets:
    case FieldType::kNumbers:
      return "doubles";
    case FieldType::kTexts:
      return "list of texts";
    case FieldType::kVec2:
      return "numbers";
    case FieldType::kPose:
      return *field.name == '\0' ? "numbers" : pose;
    case FieldType::kPoses:
      return "list of " + pose;
    case FieldType::kList:
      for (const Field& member : field.table().fields) {
        list += (list.empty() ? "" : ", ") + keys_text(member, "\"");
      }
      return "list of `{" + list + "}`";
    default:
      return "whole number";
  }
}

/// The table of readings in docs/protocol.md. Types with equal readings share their rows.
[[nodiscard]] inline std::string readings_table() {
  std::string rows;
  std::vector<const FieldTable*> shown;
  for (const DeviceKind& kind : device_kinds()) {
    const FieldTable* const table = kind.reading.fields;
    if (table == nullptr || std::find(shown.begin(), shown.end(), table) != shown.end()) continue;
    shown.push_back(table);
    std::string types;
    for (const DeviceKind& other : device_kinds()) {
      if (other.reading.fields != table) continue;
      types += (types.empty() ? "`" : ", `") + other.name + "`";
    }
    if (table->fields.empty()) rows += "| " + types + " | | | | only the time |\n";
    for (const Field& field : table->fields) {
      const std::string unit = field.range.unit;
      rows += "| " + types + " | " + keys_text(field, "`") + " | " + message_value_text(field) +
              " | " + (unit.empty() ? "–" : unit) + " | " + field.meaning + " |\n";
      types.clear();
    }
  }
  return "| type | key | value | unit | meaning |\n|---|---|---|---|---|\n" + rows;
}

/// Whether the test writes the files instead of comparing them: PLAYPEN_WRITE_PAGES=1.
[[nodiscard]] inline bool writes_pages() { return std::getenv("PLAYPEN_WRITE_PAGES") != nullptr; }

inline void write_page(const std::string& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
}

/// Whether the first table under a heading of a page is `made`; if the test writes pages, it is
/// written.
[[nodiscard]] inline bool is_table_of_page(const std::string& file, const std::string& heading,
                                           const std::string& made) {
  std::ifstream stream(file, std::ios::binary);
  const std::string page(std::istreambuf_iterator<char>(stream), {});
  const std::size_t section = page.find("\n" + heading + "\n");
  const std::size_t before = page.find("\n| key |", section);
  if (section == std::string::npos || before == std::string::npos) return false;
  const std::size_t first = before + 1;
  const std::size_t end = page.find("\n\n", first);
  const std::size_t last = end == std::string::npos ? page.size() : end + 1;
  if (!writes_pages()) return page.substr(first, last - first) == made;
  write_page(file, page.substr(0, first) + made + page.substr(last));
  return true;
}

}  // namespace sim::test
