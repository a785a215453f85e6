// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#include "playerlike/host/reading_json.h"

#include <initializer_list>

#include "protocol/field_codec.h"

namespace playerlike {
namespace {

using protocol::json;
using sim::Field;
using sim::FieldType;

std::string dumped(const json& value) {
  return value.dump(-1, ' ', false, json::error_handler_t::replace);
}

json typed(const char* type) { return {{"type", type}}; }

json coordinates(std::initializer_list<const char*> names) {
  json out = {{"type", "object"}, {"properties", json::object()}};
  for (const char* name : names) out["properties"][name] = typed("number");
  return out;
}

json schema_of_table(const sim::FieldTable& table);

json schema_of_list(const Field& field) {
  if (!field.is_keyed) return {{"type", "array"}, {"items", schema_of_table(field.table())}};
  return typed("object");  // its keys are data
}

/// The schema of a field that has a name, see protocol::write_fields().
json schema_of_field(const Field& field) {
  switch (field.type) {
    case FieldType::kNumber:
      return typed("number");
    case FieldType::kInt:
    case FieldType::kInt64:
    case FieldType::kUint32:
    case FieldType::kUint64:
      return typed("integer");
    case FieldType::kBool:
      return typed("boolean");
    case FieldType::kChoice: {
      json out = typed("string");
      for (const char* word : field.words) out["enum"].push_back(word);
      return out;
    }
    case FieldType::kBytes:
      return {{"type", "string"}, {"contentEncoding", "base64"}};
    case FieldType::kVec2:
      return coordinates({"x", "y"});
    case FieldType::kPose:
      return coordinates({"x", "y", "yaw"});
    case FieldType::kVec3:
      return coordinates({"x", "y", "z"});
    case FieldType::kOctets:
    case FieldType::kNumbers:
      return {{"type", "array"}, {"items", typed("number")}};
    case FieldType::kTexts:
      return {{"type", "array"}, {"items", typed("string")}};
    case FieldType::kPoses:
      return {{"type", "array"}, {"items", coordinates({"x", "y", "yaw"})}};
    case FieldType::kList:
      return schema_of_list(field);
    case FieldType::kStruct:
      return schema_of_table(field.table());
    case FieldType::kText:
    case FieldType::kColour:
      return typed("string");
    default:
      return json::object();  // anything
  }
}

json described(json schema, const Field& field) {
  std::string text = field.meaning;
  const std::string unit = field.range.unit;
  if (!unit.empty()) text += (text.empty() ? "[" : " [") + unit + ']';
  if (!text.empty()) schema["description"] = text;
  return schema;
}

json schema_of_table(const sim::FieldTable& table) {
  json out = {{"type", "object"}, {"properties", json::object()}};
  json& members = out["properties"];
  sim::for_each_field(
      table, static_cast<const void*>(nullptr), [&](const Field& field, const void* /*owner*/) {
        if (protocol::is_in_place(field)) {
          for (const char* part : {"x", "y", "yaw"}) {
            if (field.type == FieldType::kVec2 && std::string_view(part) == "yaw") continue;
            members[field.name + std::string(part)] = described(typed("number"), field);
          }
        } else if (const char* dot = protocol::dot_in(field)) {
          json& owner = members[std::string(field.name, dot)];
          owner["type"] = "object";
          owner["properties"][dot + 1] = described(schema_of_field(field), field);
        } else {
          members[field.name] = described(schema_of_field(field), field);
        }
      });
  return out;
}

}  // namespace

std::string reading_json(std::string_view type, const sim::Reading& reading) {
  const sim::ReadingKind& kind = protocol::reading_kind(type);
  json out = {{"seq", reading.sequence}, {"t", reading.time_ns}};
  protocol::write_fields(*kind.fields, kind.object(reading), out, protocol::Encoding::kJson);
  return dumped(out);
}

std::string reading_schema(std::string_view type) {
  json out = schema_of_table(*protocol::reading_kind(type).fields);
  out["$schema"] = "https://json-schema.org/draft/2020-12/schema";
  out["properties"]["seq"] = {
      {"type", "integer"},
      {"description", "1 for a sensor's first reading, then increasing by one"}};
  out["properties"]["t"] = {{"type", "integer"},
                            {"description", "simulated time of the measurement [ns]"}};
  return dumped(out);
}

std::string command_json(const sim::Command& command) {
  return dumped(protocol::encode_command(command));
}

}  // namespace playerlike
