// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
// Readings and commands, encoded by their field tables.
#include "protocol/field_codec.h"

#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

#include "sim/core/assert.h"
#include "sim/devices/builtin.h"

namespace playerlike::protocol {
namespace {

using nlohmann::ordered_json;
using sim::Field;
using sim::FieldType;

constexpr std::int64_t kMostInteger = std::numeric_limits<std::int64_t>::max();

template <typename T>
const T& as(const void* value) {
  return *static_cast<const T*>(value);
}

/// The two fields of the elements of a list that is an object in messages.
std::pair<const Field&, const Field&> key_and_value(const Field& field) {
  return {field.table().fields[0], field.table().fields[1]};
}

template <typename Json>
Json written(const Field& field, const void* value, Encoding encoding);

template <typename Json>
Json list_of(const Field& field, const void* list, Encoding encoding) {
  Json out = field.is_keyed ? Json::object() : Json::array();
  for (std::size_t i = 0; i < field.list->size(list); ++i) {
    const void* const element = field.list->at(list, i);
    if (field.is_keyed) {
      const auto [key, member] = key_and_value(field);
      out[as<std::string>(key.get(element))] = written<Json>(member, member.get(element), encoding);
    } else {
      write_fields(field.table(), element, out.emplace_back(Json::object()), encoding);
    }
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
template <typename Json>
Json written(const Field& field, const void* value, Encoding encoding) {
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
      return list_of<Json>(field, value, encoding);
    case FieldType::kStruct: {
      Json out = Json::object();
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
template <typename Json>
void write_in_place(const Field& field, const void* value, Json& out) {
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

/// Reads a field that is neither a list nor a struct.
void read_leaf(const Field& field, const json& in, const char* key, Encoding encoding,
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
    case FieldType::kForm:
      return field.form->decode(in, key, encoding, value);
    case FieldType::kList:
    case FieldType::kStruct:
      break;  // see read_value()
    case FieldType::kPoints:
    case FieldType::kMap:
    case FieldType::kVariant:
    case FieldType::kInclude:
    case FieldType::kCustom:
      break;  // only in world files
  }
  SIM_ASSERT(false);
}

/// The member `key`, see require().
const json& member_of(const json& in, const char* key) { return require(in, key); }
const ordered_json& member_of(const ordered_json& in, const char* key) {
  if (!in.is_object() || !in.contains(key)) static_cast<void>(require(json(in), key));  // throws
  return in.at(key);
}

/// A message with the members of a field.
const json& leaf_of(const json& in, const Field& /*field*/, const char* /*key*/) { return in; }
json leaf_of(const ordered_json& in, const Field& field, const char* key) {
  if (!is_in_place(field)) return {{key, json(member_of(in, key))}};
  return in;
}

template <typename Json>
void read_value(const Field& field, const Json& in, const char* key, Encoding encoding,
                void* value);

template <typename Json>
void read_list(const Field& field, const Json& in, const char* key, Encoding encoding, void* list) {
  const Json& value = member_of(in, key);
  if (field.is_keyed ? !value.is_object() : !value.is_array()) {
    refuse_value(key, list_in(field), json(value));
  }
  field.list->clear(list);
  for (auto at = value.begin(); at != value.end(); ++at) {
    void* const element = field.list->append(list);
    if (!field.is_keyed) {
      read_fields(field.table(), *at, encoding, element);
      continue;
    }
    const auto [name, member] = key_and_value(field);
    *static_cast<std::string*>(name.set(element)) = at.key();
    read_value(member, value, at.key().c_str(), encoding, member.set(element));
  }
}

template <typename Json>
void read_value(const Field& field, const Json& in, const char* key, Encoding encoding,
                void* value) {
  if (field.type == FieldType::kList) {
    read_list(field, in, key, encoding, value);
  } else if (field.type == FieldType::kStruct) {
    read_fields(field.table(), member_of(in, key), encoding, value);
  } else {
    read_leaf(field, leaf_of(in, field, key), key, encoding, value);
  }
}

/// The object that holds a field: "own" for "own.ip".
template <typename Json>
const Json& require_owner(const Field& field, const char* dot, const Json& in) {
  const std::string owner(field.name, dot);
  const Json& object = member_of(in, owner.c_str());
  if (!object.is_object()) {
    refuse_value(owner, "an object {\"" + std::string(dot + 1) + "\"}", json(object));
  }
  return object;
}

}  // namespace

const sim::ReadingKind& reading_kind(std::string_view type) {
  const sim::DeviceKind* kind = sim::find_device_kind(type);
  if (kind == nullptr || kind->reading.fields == nullptr) {
    refuse_value("type", "a type of device that makes readings", std::string(type));
  }
  return kind->reading;
}

template <typename Json>
void write_fields(const sim::FieldTable& table, const void* object, Json& out, Encoding encoding) {
  sim::for_each_field(table, object, [&](const Field& field, const void* owner) {
    const void* value = field.get(owner);
    if (value == nullptr) {
      if (field.null_if_empty) out[field.name] = nullptr;
      return;
    }
    if (is_in_place(field)) return write_in_place(field, value, out);
    if (const char* dot = dot_in(field)) {
      out[std::string(field.name, dot)][dot + 1] = written<Json>(field, value, encoding);
    } else {
      out[field.name] = written<Json>(field, value, encoding);
    }
  });
}

template <typename Json>
void read_fields(const sim::FieldTable& table, const Json& in, Encoding encoding, void* object) {
  sim::for_each_field(table, object, [&](const Field& field, void* owner) {
    const bool is_optional = field.drop != nullptr;
    const bool may_be_missing = field.may_be_left_out || (is_optional && !field.null_if_empty);
    if (may_be_missing && !in.contains(field.name)) {
      if (is_optional) field.drop(owner);
      return;
    }
    if (field.null_if_empty && member_of(in, field.name).is_null()) return field.drop(owner);
    const char* dot = dot_in(field);
    const Json& from = dot == nullptr ? in : require_owner(field, dot, in);
    read_value(field, from, dot == nullptr ? field.name : dot + 1, encoding, field.set(owner));
  });
  if (table.check == nullptr) return;
  if (const std::optional<sim::FieldError> error = table.check(object)) {
    refuse_value(error->key, error->expected, json(member_of(in, error->key)));
  }
}

json encode_field(const Field& field, const void* value, Encoding encoding) {
  return written<json>(field, value, encoding);
}

void decode_field(const Field& field, const json& in, Encoding encoding, void* value) {
  read_value(field, in, field.name, encoding, value);
}

bool is_in_place(const Field& field) noexcept {
  const std::string_view name = field.name;
  return name.empty() || name.ends_with('_');
}

const char* dot_in(const Field& field) noexcept { return std::strchr(field.name, '.'); }

template void write_fields(const sim::FieldTable&, const void*, json&, Encoding);
template void write_fields(const sim::FieldTable&, const void*, ordered_json&, Encoding);
template void read_fields(const sim::FieldTable&, const json&, Encoding, void*);
template void read_fields(const sim::FieldTable&, const ordered_json&, Encoding, void*);

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
  const sim::ReadingKind& kind = reading_kind(type);
  write_fields(*kind.fields, kind.object(reading), out, encoding);
  return out;
}

DecodedReading decode_reading(const json& reading, Encoding encoding) {
  DecodedReading decoded;
  decoded.device = require_device_id(reading, "device");
  const std::string type = require_text(reading, "type");
  const sim::ReadingKind& kind = reading_kind(type);
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
