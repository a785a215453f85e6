// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cctype>
#include <functional>
#include <map>
#include <optional>
#include <regex>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "field_pages.h"
#include "sim/world/limits.h"

/// JSON schemas for editors, generated from the tables of fields.
namespace sim::test {

/// Turns a phrase into a sentence without Markdown: "above the floor" -> "Above the floor [m]."
/// Code at its beginning keeps its spelling.
[[nodiscard]] inline std::string sentence(std::string phrase, const std::string& unit) {
  static const std::regex kLink(R"(\[([^\]]+)\]\([^)]+\))");
  phrase = std::regex_replace(phrase, kLink, "$1");
  if (!phrase.empty() && phrase[0] != '`') {
    phrase[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(phrase[0])));
  }
  std::erase(phrase, '`');
  return phrase + (unit.empty() ? "." : " [" + unit + "].");
}

/// Reads members of an object: "a": 1, "b": 2.
[[nodiscard]] inline Json members(const char* text) {
  return Json::parse("{" + std::string(text) + "}");
}

/// Makes the schemas of structs from their tables. Lists, optional members and variants of the
/// objects that hold the defaults get elements and values on the way, for the defaults in these.
class SchemaMaker {
 public:
  /// @param definitions  gets a definition of each struct in a struct; nullptr: they are written in
  ///                     place, without defaults.
  explicit SchemaMaker(Json* definitions = nullptr) : definitions_(definitions) {}

  /// The schema of an object with these fields.
  /// @param defaults  an object with default values; nullptr: they are left out.
  /// @param only      its keys; empty: all.
  [[nodiscard]] Json object(const FieldTable& table, void* defaults,
                            std::span<const char* const> only = {}) {
    Json schema = {{"type", "object"}, {"properties", Json::object()}};
    add_fields(table, defaults, schema, only);
    if (!schema.contains("additionalProperties")) schema["additionalProperties"] = false;
    return schema;
  }

  /// Adds a field, or its parts if it has no name, to the schema of an object.
  void add(const Field& field, void* object, Json& schema) {
    if (field.custom != nullptr && field.custom->keys != nullptr) {
      add_fields(field.custom->keys(), field.set(object), schema);
    } else if (*field.name == '\0') {
      add_parts(field, object, schema);
    } else {
      add_property(field, object, schema);
    }
    if (field.custom == nullptr) return;
    const Json rules = members(field.custom->rules);
    for (const auto& [key, rule] : rules.items()) {
      if (schema.contains(key)) throw std::logic_error("two rules under " + key);
      schema[key] = rule;
    }
  }

 private:
  void add_fields(const FieldTable& table, void* object, Json& schema,
                  std::span<const char* const> only = {}) {
    for_each_field(table, object, [&](const Field& field, void* owner) {
      const bool is_wanted =
          only.empty() || std::ranges::find(only, std::string(field.name)) != only.end();
      if (!is_wanted || (field.read_only && !field.is_read_apart)) return;
      if (only.empty()) return add(field, owner, schema);
      add_property(field, owner, schema);
    });
  }

  void add_parts(const Field& field, void* object, Json& schema) {
    Json& properties = schema["properties"];
    if (field.type == FieldType::kVec2) {
      for (const char* key : {"x", "y"}) {
        properties[key] = {{"description", description(field)}};
        properties[key].update(number(field));
        properties[key]["default"] = 0;
      }
      return;
    }
    // A struct whose keys are among those of its owner; if it is optional, all or none.
    Json parts = {{"properties", Json::object()}};
    add_fields(field.table(), value_in(field, object), parts);
    properties.update(parts["properties"]);
    if (!parts.contains("required")) return;
    const Json needed = parts["required"];
    for (const Json& key : needed) {
      for (const Json& other : needed) {
        if (key != other) schema["dependentRequired"][key.get<std::string>()].push_back(other);
      }
    }
  }

  void add_property(const Field& field, void* object, Json& schema) {
    Json property = {{"description", description(field)}};
    const std::optional<Json> fallback = default_of(field, object);
    if (!(field.type == FieldType::kVariant && definitions_ != nullptr)) {
      property.update(value(field, object));
    } else {
      property.update(variant(field, value_in(field, object)));
      for (const Kind& kind : field.kinds) {
        if (kind.is_beside) add_kind(kind, value_in(field, object), schema["properties"]);
      }
    }
    if (fallback) property["default"] = *fallback;
    schema["properties"][field.name] = property;
    if (field.needed_for != nullptr) schema["required"].push_back(field.name);
  }

  static std::string description(const Field& field) {
    std::string meaning = sentence(field.meaning, field.range.unit);
    if (field.type == FieldType::kColour) meaning += R"( "#rgb", "#rrggbb" or "#rrggbbaa".)";
    return *field.default_text == '\0' ? meaning : meaning + " Default: " + without_markdown(field);
  }
  static std::string without_markdown(const Field& field) {
    std::string text = field.default_text;
    std::erase(text, '`');
    return text + (text.ends_with('.') ? "" : ".");
  }

  /// The value of a field for which defaults are wanted; nullptr if there is none.
  [[nodiscard]] void* value_in(const Field& field, void* object) const {
    return object == nullptr || field.set == nullptr ? nullptr : field.set(object);
  }

  [[nodiscard]] std::optional<Json> default_of(const Field& field, const void* object) const {
    if (object == nullptr) return std::nullopt;
    if (definitions_ != nullptr) return default_json(field, object);
    return field.get(object) == nullptr ? std::nullopt
                                        : std::optional<Json>(value_json(field, object));
  }

  /// The schema of a value, by its type and its format.
  Json value(const Field& field, void* object) {
    if (field.custom == nullptr) return nullable(field, usual(field, object));
    if (field.custom->kinds != nullptr) return typed(field, value_in(field, object));
    Json schema = field.type == FieldType::kCustom ? Json::object() : usual(field, object);
    schema.merge_patch(members(field.custom->schema));
    if (field.custom->is_pair) schema = pair(schema);
    if (*field.custom->or_else != '\0') {
      schema = {{"anyOf", {schema, Json::parse(field.custom->or_else)}}};
    } else if (field.custom->or_field != nullptr) {
      schema = {{"anyOf", {schema, usual(other_form(field), nullptr)}}};
    }
    return nullable(field, schema);
  }
  static Json nullable(const Field& field, const Json& schema) {
    return field.may_be_null ? Json{{"anyOf", {schema, {{"type", "null"}}}}} : schema;
  }
  /// The field that `or_field` names. It is in the same table.
  static const Field& other_form(const Field& field) {
    const Field* other = &field;
    while (std::string(other->name) != field.custom->or_field) ++other;
    return *other;
  }

  static Json pair(const Json& part) {
    return {{"type", "array"}, {"items", part}, {"minItems", 2}, {"maxItems", 2}};
  }
  static Json number(const Field& field) {
    return {{"type", "number"},
            {field.range.min_exclusive ? "exclusiveMinimum" : "minimum", rounded(field.range.min)},
            {"maximum", rounded(field.range.max)}};
  }
  /// A point of the floor, the sides of something on it, or other pairs of numbers.
  Json point(const Field& field) {
    const NumberRange& range = field.range;
    if (definitions_ == nullptr || range.min_exclusive) return pair(number(field));
    const bool is_point = range.min == -kFarthest_m && range.max == kFarthest_m;
    const bool is_size = range.min == kLeastLength_m && range.max == kGreatestLength_m;
    if (!is_point && !is_size) return pair(number(field));
    return defined(is_point ? "point" : "size", nullptr, [&] {
      Json made = {{"description", is_point ? "[x, y] in m" : "[along x, along y] in m"}};
      made.update(pair(number(field)));
      return made;
    });
  }
  Json pose() {
    return defined("pose", nullptr, [this] {
      Json place = {{"type", "number"},
                    {"minimum", rounded(-kFarthest_m)},
                    {"maximum", rounded(kFarthest_m)},
                    {"default", 0}};
      Json x = {{"description", "Position along the world's x axis, to the right [m]."}};
      Json y = {{"description", "Position along the world's y axis, up in pictures [m]."}};
      Json yaw = {{"description",
                   "Heading, counter-clockwise from the x axis [degrees]: 0 looks right, 90 up."}};
      x.update(place);
      y.update(place);
      yaw.update(angle());
      yaw["default"] = 0;
      return Json{{"description", "Where something is and where it looks."},
                  {"type", "object"},
                  {"properties", {{"x", x}, {"y", y}, {"yaw_deg", yaw}}},
                  {"additionalProperties", false}};
    });
  }
  Json angle() {
    return defined("angle", nullptr, [] {
      return Json{{"type", "number"}, {"minimum", -3600}, {"maximum", 3600}};
    });
  }
  Json name() {
    return defined("name", nullptr, [] {
      return Json{{"type", "string"}, {"pattern", "^[A-Za-z0-9_-]{1,64}$"}};
    });
  }

  /// A list of that number of elements.
  static Json list(const Field& field, const Json& items) {
    Json schema = {{"type", "array"}};
    if (field.min_count > 0) schema["minItems"] = field.min_count;
    if (field.max_count < Field{"", FieldType::kList}.max_count) {
      schema["maxItems"] = field.max_count;
    }
    schema["items"] = items;
    return schema;
  }

  /// The schema of the usual format of a type.
  Json usual(const Field& field, void* object) {
    switch (field.type) {
      case FieldType::kNumber:
        return field.is_angle && range_text(field) == "–" ? angle() : number(field);
      case FieldType::kInt: {
        Json whole = number(field);
        whole["type"] = "integer";
        return whole;
      }
      case FieldType::kInt64:
        return number(field);
      case FieldType::kUint64:
        return {{"type", "integer"}, {"minimum", 0}, {"maximum", ~std::uint64_t{0}}};
      case FieldType::kBool:
        return field.words.empty() ? Json{{"type", "boolean"}} : words(field);
      case FieldType::kChoice:
        return words(field);
      case FieldType::kText: {
        if (field.is_name) return name();
        Json text = {{"type", "string"}};
        if (field.max_count < Field{"", FieldType::kText}.max_count) {
          text["maxLength"] = field.max_count;  // in bytes, of which a character has one or more
        }
        return text;
      }
      case FieldType::kColour:
        return {{"type", "string"},
                {"pattern", "^#([0-9A-Fa-f]{3}|[0-9A-Fa-f]{6}|[0-9A-Fa-f]{8})$"}};
      case FieldType::kVec2:
        return point(field);
      case FieldType::kPose:
        return pose();
      case FieldType::kTexts: {
        if (field.words.empty()) return list(field, {{"type", "string"}});
        Json some = list(field, words(field));
        some["uniqueItems"] = true;
        return some;
      }
      case FieldType::kPoints:
        return list(field, point(field));
      case FieldType::kPoses:
        return list(field, pose());
      case FieldType::kList:
        return list_of_structs(field, object);
      case FieldType::kMap:
        return {{"type", "object"}, {"additionalProperties", Json::object()}};
      case FieldType::kStruct:
        return defined(field.name, &field.table(),
                       [&] { return this->object(field.table(), value_in(field, object)); });
      default:
        throw std::logic_error(std::string(field.name) + " has no schema");
    }
  }
  static Json words(const Field& field) {
    return {{"enum", std::vector<std::string>(field.words.begin(), field.words.end())}};
  }

  Json list_of_structs(const Field& field, void* object) {
    void* const all = definitions_ == nullptr ? nullptr : value_in(field, object);
    if (field.element != nullptr) return list(field, Json::parse(field.element->schema));
    void* const element = all == nullptr ? nullptr : field.list->append(all);
    if (!field.kinds.empty()) return list(field, variant(field, element));
    const Field& first = field.table().fields.front();
    if (!field.is_keyed && *first.name == '\0') return list(field, usual(first, nullptr));
    const auto only =
        field.custom == nullptr ? std::span<const char* const>() : field.custom->only_keys;
    if (!field.is_keyed) {
      return list(field, defined(singular(field.name), &field,
                                 [&] { return this->object(field.table(), element, only); }));
    }
    Json schema = {{"type", "object"}};
    if (field.max_count < Field{"", FieldType::kList}.max_count) {
      schema["maxProperties"] = field.max_count;
    }
    if (first.is_name) schema["propertyNames"] = name();
    const Field& second = field.table().fields[1];
    schema["additionalProperties"] =
        *second.name == '\0' ? usual(second, nullptr) : defined(singular(field.name), &field, [&] {
          return this->object(field.table(), element);
        });
    return schema;
  }

  /// An object with one key, which tells the kind.
  Json variant(const Field& field, void* variant) {
    const std::string what = field.issue_expected;  // "an action"
    const std::string word = what.substr(what.find(' ') + 1);
    return defined(word, field.kinds.data(), [&] {
      Json schema = {{"description", "One " + word + ": an object with one of these keys."},
                     {"type", "object"},
                     {"properties", Json::object()}};
      for (const Kind& kind : field.kinds) {
        if (!kind.is_beside) add_kind(kind, variant, schema["properties"], word + '_');
      }
      schema.update({{"minProperties", 1}, {"maxProperties", 1}, {"additionalProperties", false}});
      return schema;
    });
  }
  void add_kind(const Kind& kind, void* variant, Json& properties, const std::string& prefix = "") {
    Json made = {{"properties", Json::object()}};
    void* const object = variant == nullptr ? nullptr : kind.make(variant);
    if (kind.is_bare) {
      add_fields(kind.table(), object, made);
      properties.update(made["properties"]);
      return;
    }
    properties[kind.word] = {{"description", sentence(kind.meaning, "")}};
    properties[kind.word].update(
        defined(prefix + kind.word, &kind, [&] { return this->object(kind.table(), object); }));
  }

  /// An object that states its kind under a key.
  Json typed(const Field& field, void* value) {
    Json all = Json::array();
    for (const Kind& kind : field.custom->kinds()) {
      all.push_back(defined(std::string(field.name) + '_' + kind.word, &kind, [&] {
        const std::string key = field.custom->kind_key;
        Json schema = {{"description", sentence(kind.meaning, "")},
                       {"type", "object"},
                       {"properties",
                        {{key,
                          {{"description", "Kind of " + std::string(field.name) + "."},
                           {"const", kind.word}}}}},
                       {"required", {key}}};
        add_fields(kind.table(), kind.make(value), schema);
        schema["additionalProperties"] = false;
        return schema;
      }));
    }
    return {{"oneOf", all}};
  }

  static std::string singular(const std::string& word) {
    return word.ends_with('s') ? word.substr(0, word.size() - 1) : word;
  }

  /// A reference to a definition, which is made the first time.
  /// @param what  what it defines; two things must not have the same name.
  Json defined(const std::string& name, const void* what, const std::function<Json()>& make) {
    static const std::vector<std::string> kBasic{"point", "size", "angle", "pose", "name"};
    if (definitions_ == nullptr) {
      if (std::ranges::find(kBasic, name) == kBasic.end() || name == "point" || name == "size") {
        return make();
      }
    } else if (!definitions_->contains(name)) {
      (*definitions_)[name] = nullptr;  // its place in the file
      what_[name] = what;
      const Json made = make();
      (*definitions_)[name] = made;
    } else if (what_[name] != what) {
      throw std::logic_error("two definitions are called " + name);
    }
    return {{"$ref", "#/$defs/" + name}};
  }

  Json* definitions_;
  std::map<std::string, const void*> what_;
};

/// Adds the schema of a field, or of its parts if it has no name, to the properties of an object.
inline void add_schema(const Field& field, const void* defaults, Json& properties) {
  Json schema = {{"properties", std::move(properties)}};
  SchemaMaker().add(field, const_cast<void*>(defaults), schema);
  properties = std::move(schema["properties"]);
}

}  // namespace sim::test
