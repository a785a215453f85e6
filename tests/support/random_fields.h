// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <random>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/field_codec.h"
#include "protocol/framing.h"
#include "sim/core/fields.h"

/// Structs by their tables of fields: random values, and all values as text for comparison.
namespace test {

/// A finite double with uniformly distributed bits: also tiny, huge and -0.
inline double any_double(std::mt19937_64& random) {
  for (;;) {
    const auto value = std::bit_cast<double>(random());
    if (std::isfinite(value)) return random() % 16 == 0 ? -0.0 : value;
  }
}

inline std::string any_text(std::mt19937_64& random) {
  static const std::vector<std::string> kPieces = {"a", "Z",  "0",    " ",    "\"",   "\\",
                                                   "/", "\n", "\t",   "\x01", "\x7f", "é",
                                                   "Ř", "→",  "🤖", "[1,2"};
  std::string text;
  for (auto i = random() % 12; i > 0; --i) text += kPieces[random() % kPieces.size()];
  return text;
}

/// Fills structs with random values that messages may have.
class RandomFields {
 public:
  explicit RandomFields(std::uint64_t seed) : random_(seed) {}

  [[nodiscard]] std::mt19937_64& random() { return random_; }

  void fill(const sim::FieldTable& table, void* object) {
    sim::for_each_field(table, object, [&](const sim::Field& field, void* owner) {
      if (field.drop != nullptr && random_() % 2 == 0) return field.drop(owner);
      set(field, field.set(owner));
    });
    if (table.check == nullptr || !table.check(object)) return;
    for (const sim::Field& field : table.fields) {  // the check may want positive numbers
      if (field.type != sim::FieldType::kNumber) continue;
      auto& number = *static_cast<double*>(field.set(object));
      number = 1e-300 + std::abs(number);
    }
  }

 private:
  template <typename T, typename... Parts>
  static void assign(void* value, Parts... parts) {
    *static_cast<T*>(value) = T{parts...};
  }
  double number() { return any_double(random_); }
  std::uint8_t octet() { return static_cast<std::uint8_t>(random_()); }
  /// Often so many that a list of numbers counts as long.
  std::size_t length() { return random_() % (2 * playerlike::protocol::kLongList); }
  template <typename T, typename Make>
  void fill_list(void* value, Make make) {
    auto& list = *static_cast<std::vector<T>*>(value);
    list.clear();
    for (std::size_t i = length(); i > 0; --i) list.push_back(make());
  }

  void set_whole(const sim::Field& field, void* value) {
    auto least = static_cast<std::uint64_t>(field.least);
    auto count = static_cast<std::uint64_t>(field.greatest) - least + 1;
    if (field.type == sim::FieldType::kChoice) {
      least = 0;
      count = field.words.size();
    }
    sim::set_integer(
        field, value,
        static_cast<std::int64_t>(least + (count == 0 ? random_() : random_() % count)));
  }

  // Takes one of the samples that the form accepts.
  void set_in_form(const sim::Field& field, void* value) {
    static const nlohmann::json kSamples = nlohmann::json::parse(R"([
        "colour", "grey", "lockstep", "paced", "mini-map", "trinary", "scale", "score", "AQIDBA==",
        [3, 14], [1, -2, 3, 4], [0.1, -2.5, 7], {"a": 1, "": -2}, {"a": 0.1}, {"a": "b"},
        {"a": ["b", ""], "c": []}, {"name": "way", "colour": "#12345678", "priority": -3},
        {"width": 1, "height": 1, "cell_size": 0.5, "x": 0.1, "y": -1.0, "cells": "AACAPw=="}])");
    const std::size_t first = random_() % kSamples.size();
    for (std::size_t i = 0; i < kSamples.size(); ++i) {
      const nlohmann::json sample = {{"it", kSamples[(first + i) % kSamples.size()]}};
      try {
        return field.form->decode(sample, "it", playerlike::protocol::Encoding::kJson, value);
      } catch (const playerlike::protocol::ProtocolError&) {
        continue;  // a sample of another form
      }
    }
    throw std::logic_error(std::string("a sample is missing for the form of ") + field.name);
  }

  void set(const sim::Field& field, void* value) {
    using sim::FieldType;
    switch (field.type) {
      case FieldType::kNumber:
        return assign<double>(value, number());
      case FieldType::kInt:
      case FieldType::kInt64:
      case FieldType::kUint32:
      case FieldType::kUint64:
      case FieldType::kChoice:
        return set_whole(field, value);
      case FieldType::kBool:
        return assign<bool>(value, random_() % 2 == 0);
      case FieldType::kText:
        return assign<std::string>(value, any_text(random_));
      case FieldType::kColour:
        return assign<sim::Colour>(value, octet(), octet(), octet(), octet());
      case FieldType::kVec2:
        return assign<sim::Vec2>(value, number(), number());
      case FieldType::kPose:
        return assign<sim::Pose>(value, number(), number(), number());
      case FieldType::kVec3:
        return assign<std::array<double, 3>>(value, number(), number(), number());
      case FieldType::kBytes:
      case FieldType::kOctets:
        return fill_list<std::uint8_t>(value, [&] { return octet(); });
      case FieldType::kNumbers:
        return fill_list<double>(value, [&] { return number(); });
      case FieldType::kTexts:
        return fill_list<std::string>(value, [&] { return any_text(random_); });
      case FieldType::kPoses:
        return fill_list<sim::Pose>(value, [&] { return sim::Pose{number(), number(), number()}; });
      case FieldType::kList:
        field.list->clear(value);
        for (std::size_t i = length(); i > 0; --i) fill(field.table(), field.list->append(value));
        return;
      case FieldType::kStruct:
        return fill(field.table(), value);
      case FieldType::kForm:
        return set_in_form(field, value);
      case FieldType::kPoints:
      case FieldType::kMap:
      case FieldType::kVariant:
      case FieldType::kInclude:
      case FieldType::kCustom:
        throw std::logic_error("not a field of messages");
    }
  }

  std::mt19937_64 random_;
};

/// Writes all values of structs, doubles by their bits.
class FieldText {
 public:
  /// The values of a struct.
  [[nodiscard]] static std::string of(const sim::FieldTable& table, const void* object) {
    FieldText text;
    text.add_all(table, object);
    return text.out_;
  }
  template <typename Struct>
  [[nodiscard]] static std::string of(const Struct& object) {  ///< of a struct that has a table
    return of(sim::fields_of<Struct>(), &object);
  }

 private:
  void add_all(const sim::FieldTable& table, const void* object) {
    sim::for_each_field(table, object, [&](const sim::Field& field, const void* owner) {
      const void* value = field.get(owner);
      ((out_ += '\n') += field.name) += ':';
      value == nullptr ? add("none") : add_value(field, value);
    });
  }

  void add(std::string_view text) { (out_ += text) += ' '; }
  void add(double number) { add(std::to_string(std::bit_cast<std::uint64_t>(number))); }
  void add(std::uint8_t number) { add(std::to_string(number)); }
  void add(const sim::Pose& pose) { add(pose.x_m), add(pose.y_m), add(pose.yaw_rad); }
  template <typename List>
  void add_elements(const void* value) {
    const auto& list = *static_cast<const List*>(value);
    add(std::to_string(list.size()));
    for (const auto& element : list) add(element);
  }

  void add_value(const sim::Field& field, const void* value) {
    using sim::FieldType;
    switch (field.type) {
      case FieldType::kNumber:
        return add(*static_cast<const double*>(value));
      case FieldType::kInt:
      case FieldType::kInt64:
      case FieldType::kUint32:
      case FieldType::kUint64:
      case FieldType::kChoice:
        return add(std::to_string(sim::integer_at(field, value)));
      case FieldType::kBool:
        return add(*static_cast<const bool*>(value) ? "true" : "false");
      case FieldType::kText:
        return add(*static_cast<const std::string*>(value));
      case FieldType::kColour:
        return add(sim::to_string(*static_cast<const sim::Colour*>(value)));
      case FieldType::kVec2:
        add(static_cast<const sim::Vec2*>(value)->x());
        return add(static_cast<const sim::Vec2*>(value)->y());
      case FieldType::kPose:
        return add(*static_cast<const sim::Pose*>(value));
      case FieldType::kVec3:
        return add_elements<std::array<double, 3>>(value);
      case FieldType::kBytes:
      case FieldType::kOctets:
        return add_elements<std::vector<std::uint8_t>>(value);
      case FieldType::kNumbers:
        return add_elements<std::vector<double>>(value);
      case FieldType::kTexts:
        return add_elements<std::vector<std::string>>(value);
      case FieldType::kPoses:
        return add_elements<std::vector<sim::Pose>>(value);
      case FieldType::kList:
        add(std::to_string(field.list->size(value)));
        for (std::size_t i = 0; i < field.list->size(value); ++i) {
          add_all(field.table(), field.list->at(value, i));
        }
        return;
      case FieldType::kStruct:
        return add_all(field.table(), value);
      case FieldType::kForm:
        return add(field.form->encode(value, playerlike::protocol::Encoding::kJson).dump());
      case FieldType::kPoints:
      case FieldType::kMap:
      case FieldType::kVariant:
      case FieldType::kInclude:
      case FieldType::kCustom:
        return add("not a field of messages");
    }
  }

  std::string out_;
};

/// The field that a key of a message belongs to: "x" to a pose without a name, "own" to "own.ip";
/// nullptr: none.
inline const sim::Field* field_of_key(const sim::FieldTable& table, std::string_view key) {
  constexpr std::string_view kParts[] = {"x", "y", "yaw"};
  const sim::Field* found = nullptr;
  sim::for_each_field(
      table, static_cast<const void*>(nullptr), [&](const sim::Field& field, const void*) {
        const std::string_view name = field.name;
        const bool in_place = name.empty() || name.ends_with('_');
        const bool is_part = in_place && key.starts_with(name) &&
                             std::ranges::count(kParts, key.substr(name.size())) > 0;
        const bool is_owner = name.starts_with(std::string(key) + '.');
        if (name == key || is_part || is_owner) found = &field;
      });
  return found;
}

/// Whether a message may lack a field.
inline bool may_be_missing(const sim::Field* field) {
  return field != nullptr &&
         (field->may_be_left_out || (field->drop != nullptr && !field->null_if_empty));
}

}  // namespace test
