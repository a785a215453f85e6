// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sim/core/fields.h"
#include "sim/io/reader.h"

namespace sim {

/// A list element that is written as a single value in world files.
struct ElementType {
  bool (*read)(const io::Reader& value, void* element);  ///< false: the value is invalid
  std::string (*text)(const void* element);              ///< as JSON
  const char* schema;                                    ///< JSON schema of a value
};

/// The format of a field of a world file that its type does not tell. Its functions get the whole
/// struct. Its JSON schema is that of the field's type, changed by the other members.
struct CustomField {
  void (*read)(io::Reader& settings, const Field& field, void* object) = nullptr;
  std::string (*text)(const void* object) = nullptr;  ///< as JSON
  const char* schema = "";         ///< further members of the schema, without braces; null drops
                                   ///< a member
  const char* rules = "";          ///< further members of the schema of the struct, e.g. keys
                                   ///< that exclude one another
  const char* or_else = "";        ///< schema of another form of the value
  const char* or_field = nullptr;  ///< the field of the struct that files have as another form
  bool is_pair = false;            ///< a list of two such values
  const char* kind_key = nullptr;  ///< under which the value states its kind
  std::span<const Kind> (*kinds)() = nullptr;   ///< the kinds of kind_key
  const FieldTable& (*keys)() = nullptr;        ///< keys of the struct, for the value's fields
  std::span<const char* const> only_keys = {};  ///< of the elements of a list; empty: all
};

}  // namespace sim

namespace sim::io {

/// Reads the kind that a key of an object names: {"KIND": VALUE}.
/// @param what  of what it is a kind, for messages: "an action".
/// @param value  the variant or struct.
void read_kind(Reader& object, std::span<const Kind> kinds, const char* what, void* value);

/// The one of some keys that an object has; nullopt and an issue unless it has exactly one.
/// @param what            what the key decides, for messages.
/// @param has_other_keys  the object may have other keys. Otherwise an unknown key is the issue.
[[nodiscard]] std::optional<std::string> only_key(Reader& object,
                                                  const std::vector<std::string>& keys,
                                                  const char* what, bool has_other_keys = false);

/// Reads an object that states its kind under a key: {"type": "KIND", ...}. By default it is the
/// first.
void read_typed(Reader& object, const char* key, std::span<const Kind> kinds, void* value);

/// Reads a field, in the usual format of its type even if the field has another.
void read_as_usual(Reader& settings, const Field& field, void* object);

/// Reads the fields of a struct from an object of a world file. Missing keys leave the values in
/// `object` unchanged. Errors are recorded with their place, as Reader's getters do.
void read_fields(Reader& settings, const FieldTable& table, void* object);

/// Reads the fields with these keys only, also those that read_fields() leaves to other code.
void read_named(Reader& settings, const FieldTable& table,
                std::initializer_list<std::string_view> keys, void* object);
/// read_named() of a struct's own table.
template <typename Struct>
void read_some(Reader& settings, Struct& object, std::initializer_list<std::string_view> keys) {
  read_named(settings, fields_of<Struct>(), keys, &object);
}

}  // namespace sim::io
