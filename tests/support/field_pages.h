// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cctype>
#include <fstream>
#include <nlohmann/json.hpp>
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
    const std::string unit = field.range.unit;
    rows += "| `" + std::string(field.name) + "` | " + (unit.empty() ? "–" : unit) + " | " +
            range_text(field) + " | `" + line_of_json(value_json(field, defaults)) + "` | " +
            field.meaning + " |\n";
  });
  if (rows.empty()) return "";
  return "| key | unit | range | default | meaning |\n|---|---|---|---|---|\n" + rows;
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

/// Turns a phrase into a sentence without Markdown: "above the floor" -> "Above the floor [m]."
[[nodiscard]] inline std::string sentence(std::string phrase, const std::string& unit) {
  std::erase(phrase, '`');
  if (!phrase.empty()) {
    phrase[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(phrase[0])));
  }
  return phrase + (unit.empty() ? "." : " [" + unit + "].");
}

[[nodiscard]] Json object_schema(const FieldTable& table);

/// Adds the schema of a field, or of its parts if it has no name, to the properties of an object.
inline void add_schema(const Field& field, const void* defaults, Json& properties) {
  Json schema = {{"description", sentence(field.meaning, field.range.unit)}};
  const auto add_range = [&field](Json& number) {
    number[field.range.min_exclusive ? "exclusiveMinimum" : "minimum"] = rounded(field.range.min);
    number["maximum"] = rounded(field.range.max);
  };
  switch (field.type) {
    case FieldType::kNumber:
    case FieldType::kInt:
      if (range_text(field) == "–") {
        schema["$ref"] = "#/$defs/angle";
        break;
      }
      schema["type"] = field.type == FieldType::kInt ? "integer" : "number";
      add_range(schema);
      break;
    case FieldType::kBool:
      schema["type"] = "boolean";
      break;
    case FieldType::kText:
      schema.update(field.needed_for == nullptr ? Json{{"type", "string"}}
                                                : Json{{"$ref", "#/$defs/name"}});
      break;
    case FieldType::kChoice:
      schema["enum"] = std::vector<std::string>(field.words.begin(), field.words.end());
      break;
    case FieldType::kColour:
      schema["type"] = "string";
      schema["pattern"] = "^#([0-9A-Fa-f]{3}|[0-9A-Fa-f]{6}|[0-9A-Fa-f]{8})$";
      break;
    case FieldType::kVec2: {
      Json part = {{"type", "number"}};
      add_range(part);
      if (*field.name == '\0') {
        for (const char* key : {"x", "y"}) {
          properties[key] = {{"description", schema["description"]}};
          properties[key].update(part);
          properties[key]["default"] = 0;
        }
        return;
      }
      schema.update({{"type", "array"}, {"items", part}, {"minItems", 2}, {"maxItems", 2}});
      break;
    }
    case FieldType::kPose:
      schema["$ref"] = "#/$defs/pose";
      break;
    case FieldType::kPoses:
    case FieldType::kList:
      schema["type"] = "array";
      if (field.min_count > 0) schema["minItems"] = field.min_count;
      schema["maxItems"] = field.max_count;
      schema["items"] = field.element != nullptr          ? Json::parse(field.element->schema)
                        : field.type == FieldType::kPoses ? Json{{"$ref", "#/$defs/pose"}}
                                                          : object_schema(field.table());
      break;
    default:
      schema.update(Json::parse("{" + std::string(field.custom->schema) + "}"));
  }
  if (defaults != nullptr && field.get(defaults) != nullptr) {
    schema["default"] = value_json(field, defaults);
  }
  properties[field.name] = schema;
}

/// The schema of an object with these fields.
inline Json object_schema(const FieldTable& table) {
  Json schema = {{"type", "object"}, {"properties", Json::object()}};
  for (const Field& field : table.fields) {
    add_schema(field, nullptr, schema["properties"]);
    if (field.needed_for != nullptr) schema["required"].push_back(field.name);
  }
  schema["additionalProperties"] = false;
  return schema;
}

/// The schema of the object under a device's name in a world file.
[[nodiscard]] inline Json device_schema(const DeviceKind& kind) {
  Json properties = {{"type", {{"$ref", "#/$defs/device_type"}}}};
  for_each_setting(kind, [&properties](const Field& field, const void* defaults) {
    add_schema(field, defaults, properties);
  });
  const Json settings = {
      {"type", "object"}, {"properties", properties}, {"additionalProperties", false}};
  return {{"description", "Settings of a device of type " + kind.name +
                              "; those left out keep the model's, or have their defaults."},
          {"oneOf", {settings, {{"$ref", "#/$defs/removed"}}}}};
}

/// The schema of worlds with a newly generated part for devices.
[[nodiscard]] inline Json with_devices(Json schema) {
  Json& definitions = schema.at("$defs");
  std::vector<std::string> names;
  for (const DeviceKind& kind : device_kinds()) names.push_back(kind.name);
  std::sort(names.begin(), names.end());
  std::vector<std::string> old;
  for (const auto& [key, value] : definitions.items()) {
    if (key.starts_with("device_") && key != "device_type") old.push_back(key);
  }
  for (const std::string& key : old) definitions.erase(key);
  Json devices = Json::object();
  for (const std::string& name : names) {
    devices[name] = {{"$ref", "#/$defs/device_" + name}};
    definitions["device_" + name] = device_schema(*find_device_kind(name));
  }
  definitions.at("robot").at("properties").at("devices").at("properties") = devices;
  return schema;
}

/// Whether the test writes the files instead of comparing them: PLAYPEN_WRITE_PAGES=1.
[[nodiscard]] inline bool writes_pages() { return std::getenv("PLAYPEN_WRITE_PAGES") != nullptr; }

inline void write_page(const std::string& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
}

}  // namespace sim::test
