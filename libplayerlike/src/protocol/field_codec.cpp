// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Readings and commands, encoded by their field tables.
#include "protocol/field_codec.h"

#include <array>
#include <cmath>
#include <cstring>
#include <limits>

#include "sim/core/assert.h"
#include "sim/devices/builtin.h"

namespace playerlike::protocol {
namespace {

using sim::Field;
using sim::FieldType;

constexpr std::int64_t kMostInteger = std::numeric_limits<std::int64_t>::max();

template <typename T>
const T& as(const void* value) {
  return *static_cast<const T*>(value);
}

bool is_in_place(const Field& field) {
  const std::string_view name = field.name;
  return name.empty() || name.ends_with('_');
}

json list_of(const Field& field, const void* list, Encoding encoding) {
  json out = json::array();
  for (std::size_t i = 0; i < field.list->size(list); ++i) {
    json element = json::object();
    write_fields(field.table(), field.list->at(list, i), element, encoding);
    out.push_back(std::move(element));
  }
  return out;
}

json poses(const std::vector<sim::Pose>& list) {
  json out = json::array();
  for (const sim::Pose& pose : list) out.push_back(encode_pose(pose));
  return out;
}

json octets(const std::vector<std::uint8_t>& numbers, Encoding encoding) {
  return doubles(std::vector<double>(numbers.begin(), numbers.end()), encoding);
}

/// Encodes a field that has a name.
json written(const Field& field, const void* value, Encoding encoding) {
  switch (field.type) {
    case FieldType::kNumber:
      return as<double>(value);
    case FieldType::kInt:
    case FieldType::kInt64:
      return sim::integer_at(field, value);
    case FieldType::kUint32:
    case FieldType::kUint64:
      return static_cast<std::uint64_t>(sim::integer_at(field, value));
    case FieldType::kBool:
      return as<bool>(value);
    case FieldType::kText:
      return as<std::string>(value);
    case FieldType::kChoice:
      return field.words[static_cast<std::size_t>(sim::integer_at(field, value))];
    case FieldType::kColour:
      return sim::to_string(as<sim::Colour>(value));
    case FieldType::kVec2:
      return {{"x", as<sim::Vec2>(value).x()}, {"y", as<sim::Vec2>(value).y()}};
    case FieldType::kPose:
      return encode_pose(as<sim::Pose>(value));
    case FieldType::kVec3: {
      const auto& v = as<std::array<double, 3>>(value);
      return {{"x", v[0]}, {"y", v[1]}, {"z", v[2]}};
    }
    case FieldType::kBytes:
      return bytes(as<std::vector<std::uint8_t>>(value), encoding);
    case FieldType::kOctets:
      return octets(as<std::vector<std::uint8_t>>(value), encoding);
    case FieldType::kNumbers:
      return doubles(as<std::vector<double>>(value), encoding);
    case FieldType::kTexts:
      return as<std::vector<std::string>>(value);
    case FieldType::kPoses:
      return poses(as<std::vector<sim::Pose>>(value));
    case FieldType::kList:
      return list_of(field, value, encoding);
    case FieldType::kStruct: {
      json out = json::object();
      write_fields(field.table(), value, out, encoding);
      return out;
    }
    case FieldType::kForm:
      return field.form->encode(value, encoding);
    case FieldType::kPoints:
    case FieldType::kMap:
    case FieldType::kVariant:
    case FieldType::kInclude:
    case FieldType::kCustom:
      break;  // only in world files
  }
  SIM_ASSERT(false);
  return nullptr;
}

/// Writes the components of a vector or a pose as members of the message itself.
void write_in_place(const Field& field, const void* value, json& out) {
  if (field.type == FieldType::kVec2) {
    out[std::string(field.name) + 'x'] = as<sim::Vec2>(value).x();
    out[std::string(field.name) + 'y'] = as<sim::Vec2>(value).y();
    return;
  }
  SIM_ASSERT(field.type == FieldType::kPose && *field.name == '\0');
  out["x"] = as<sim::Pose>(value).x_m;
  out["y"] = as<sim::Pose>(value).y_m;
  out["yaw"] = as<sim::Pose>(value).yaw_rad;
}

sim::Vec2 read_vec2(const json& in, const std::string& prefix) {
  return {require_number(in, (prefix + 'x').c_str()), require_number(in, (prefix + 'y').c_str())};
}

std::array<double, 3> require_vec3(const json& in, const char* key) {
  const json& vector = require(in, key);
  if (!vector.is_object()) refuse_value(key, "an object {\"x\", \"y\", \"z\"}", vector);
  return {require_number(vector, "x"), require_number(vector, "y"), require_number(vector, "z")};
}

sim::Colour require_colour(const Field& field, const json& in, const char* key) {
  const json& value = require(in, key);
  const auto* text = value.get_ptr<const std::string*>();
  const char* expected = field.issue_expected;
  if (expected == nullptr) expected = text == nullptr ? "a text" : "#rgb, #rrggbb or #rrggbbaa";
  const auto colour = text == nullptr ? std::nullopt : sim::parse_colour(*text);
  if (!colour) refuse_value(key, expected, value);
  return *colour;
}

void read_choice(const Field& field, const json& in, const char* key, void* value) {
  const json& word = require(in, key);
  std::string words;
  for (std::size_t i = 0; i < field.words.size(); ++i) {
    if (word == field.words[i]) return sim::set_integer(field, value, static_cast<std::int64_t>(i));
    words += words.empty() ? "" : ", ";
    words += field.words[i];
  }
  refuse_value(key, "one of " + words, word);
}

std::vector<std::uint8_t> require_octets(const json& in, const char* key, Encoding encoding) {
  std::vector<std::uint8_t> octets;
  for (const double number : require_doubles(in, key, encoding)) {
    const bool fits = number >= 0.0 && number <= 255.0 && number == std::floor(number);
    if (!fits) refuse_value(key, "whole numbers from 0 to 255", json(number));
    octets.push_back(static_cast<std::uint8_t>(number));
  }
  return octets;
}

/// Describes the list of a field in errors.
const char* list_in(const Field& field) {
  return field.issue_expected != nullptr ? field.issue_expected : "a list";
}

void read_value(const Field& field, const json& in, const char* key, Encoding encoding,
                void* value) {
  switch (field.type) {
    case FieldType::kNumber:
      *static_cast<double*>(value) = require_number(in, key);
      return;
    case FieldType::kInt:
    case FieldType::kInt64:
    case FieldType::kUint32:
    case FieldType::kUint64:
      return sim::set_integer(field, value, require_integer(in, key, field.least, field.greatest));
    case FieldType::kBool:
      *static_cast<bool*>(value) = require_bool(in, key);
      return;
    case FieldType::kText:
      *static_cast<std::string*>(value) = require_text(in, key);
      return;
    case FieldType::kChoice:
      return read_choice(field, in, key, value);
    case FieldType::kColour:
      *static_cast<sim::Colour*>(value) = require_colour(field, in, key);
      return;
    case FieldType::kVec2:
      *static_cast<sim::Vec2*>(value) =
          is_in_place(field) ? read_vec2(in, key) : read_vec2(require(in, key), "");
      return;
    case FieldType::kPose:
      *static_cast<sim::Pose*>(value) = decode_pose(is_in_place(field) ? in : require(in, key));
      return;
    case FieldType::kVec3:
      *static_cast<std::array<double, 3>*>(value) = require_vec3(in, key);
      return;
    case FieldType::kBytes:
      *static_cast<std::vector<std::uint8_t>*>(value) = require_bytes(in, key, encoding);
      return;
    case FieldType::kOctets:
      *static_cast<std::vector<std::uint8_t>*>(value) = require_octets(in, key, encoding);
      return;
    case FieldType::kNumbers:
      *static_cast<std::vector<double>*>(value) = require_doubles(in, key, encoding);
      return;
    case FieldType::kTexts:
      *static_cast<std::vector<std::string>*>(value) = require_texts(in, key, field.issue_expected);
      return;
    case FieldType::kPoses:
      static_cast<std::vector<sim::Pose>*>(value)->clear();
      for (const json& pose : require_list(require(in, key), key)) {
        static_cast<std::vector<sim::Pose>*>(value)->push_back(decode_pose(pose));
      }
      return;
    case FieldType::kList:
      field.list->clear(value);
      for (const json& element : require_list(require(in, key), key, list_in(field))) {
        read_fields(field.table(), element, encoding, field.list->append(value));
      }
      return;
    case FieldType::kStruct:
      return read_fields(field.table(), require(in, key), encoding, value);
    case FieldType::kForm:
      return field.form->decode(in, key, encoding, value);
    case FieldType::kPoints:
    case FieldType::kMap:
    case FieldType::kVariant:
    case FieldType::kInclude:
    case FieldType::kCustom:
      SIM_ASSERT(false);  // only in world files
  }
}

/// The position of the dot in "own.ip"; null if there is none.
const char* dot_in(const Field& field) { return std::strchr(field.name, '.'); }

/// The object that holds a field: "own" for "own.ip".
const json& require_owner(const Field& field, const char* dot, const json& in) {
  const std::string owner(field.name, dot);
  const json& object = require(in, owner.c_str());
  if (!object.is_object()) {
    refuse_value(owner, "an object {\"" + std::string(dot + 1) + "\"}", object);
  }
  return object;
}

const sim::DeviceKind& kind_with_readings(std::string_view type) {
  const sim::DeviceKind* kind = sim::find_device_kind(type);
  if (kind == nullptr || kind->reading.fields == nullptr) {
    refuse_value("type", "a type of device that makes readings", std::string(type));
  }
  return *kind;
}

}  // namespace

void write_fields(const sim::FieldTable& table, const void* object, json& out, Encoding encoding) {
  sim::for_each_field(table, object, [&](const Field& field, const void* owner) {
    const void* value = field.get(owner);
    if (value == nullptr) {
      if (field.null_if_empty) out[field.name] = nullptr;
      return;
    }
    if (is_in_place(field)) return write_in_place(field, value, out);
    if (const char* dot = dot_in(field)) {
      out[std::string(field.name, dot)][dot + 1] = written(field, value, encoding);
    } else {
      out[field.name] = written(field, value, encoding);
    }
  });
}

void read_fields(const sim::FieldTable& table, const json& in, Encoding encoding, void* object) {
  sim::for_each_field(table, object, [&](const Field& field, void* owner) {
    const bool is_optional = field.drop != nullptr;
    const bool may_be_missing = field.may_be_left_out || (is_optional && !field.null_if_empty);
    if (may_be_missing && !in.contains(field.name)) {
      if (is_optional) field.drop(owner);
      return;
    }
    if (field.null_if_empty && require(in, field.name).is_null()) return field.drop(owner);
    const char* dot = dot_in(field);
    const json& from = dot == nullptr ? in : require_owner(field, dot, in);
    read_value(field, from, dot == nullptr ? field.name : dot + 1, encoding, field.set(owner));
  });
  if (table.check == nullptr) return;
  if (const std::optional<sim::FieldError> error = table.check(object)) {
    refuse_value(error->key, error->expected, require(in, error->key));
  }
}

std::vector<std::string> keys_of(const sim::FieldTable& table) {
  std::vector<std::string> keys;
  sim::for_each_field(table, static_cast<const void*>(nullptr),
                      [&](const Field& field, const void*) {
                        const std::string name = field.name;
                        if (!is_in_place(field)) return keys.push_back(name);
                        keys.insert(keys.end(), {name + 'x', name + 'y'});
                        if (field.type == FieldType::kPose) keys.push_back(name + "yaw");
                      });
  return keys;
}

void refuse_unknown_keys(const json& object, std::initializer_list<std::string_view> more,
                         const sim::FieldTable& table, std::string_view what) {
  const std::vector<std::string> keys = keys_of(table);
  std::vector<std::string_view> known(more);
  known.insert(known.end(), keys.begin(), keys.end());
  refuse_unknown_keys(object, known, what);
}

std::vector<std::string> require_texts(const json& in, const char* key, const char* expected) {
  std::vector<std::string> texts;
  for (const json& text :
       require_list(require(in, key), key, expected != nullptr ? expected : "a list")) {
    if (!text.is_string()) {
      refuse_value(key, expected != nullptr ? expected : "a list of names", text);
    }
    texts.push_back(text.get<std::string>());
  }
  return texts;
}

json encode_reading(DeviceId device, std::string_view type, const sim::Reading& reading,
                    Encoding encoding) {
  json out = {{"device", encode_device_id(device)},
              {"seq", reading.sequence},
              {"t", reading.time_ns},
              {"type", type}};
  const sim::ReadingKind& kind = kind_with_readings(type).reading;
  write_fields(*kind.fields, kind.object(reading), out, encoding);
  return out;
}

DecodedReading decode_reading(const json& reading, Encoding encoding) {
  DecodedReading decoded;
  decoded.device = require_device_id(reading, "device");
  const std::string type = require_text(reading, "type");
  const sim::ReadingKind& kind = kind_with_readings(type).reading;
  decoded.reading = kind.make();
  read_fields(*kind.fields, reading, encoding, kind.object(*decoded.reading));
  decoded.reading->sequence =
      static_cast<std::uint64_t>(require_integer(reading, "seq", 0, kMostInteger));
  decoded.reading->time_ns = require_integer(reading, "t", 0, kMostInteger);
  return decoded;
}

json encode_command(const sim::Command& command) {
  return encode_alternative(sim::command_kinds(), command);
}

sim::Command decode_command(const json& command) {
  return decode_alternative(sim::command_kinds(), command, "a command");
}

}  // namespace playerlike::protocol
