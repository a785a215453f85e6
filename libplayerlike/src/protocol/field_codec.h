// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/codec.h"
#include "sim/core/fields.h"
#include "sim/devices/builtin.h"

/// How messages write and read the values of a type that is not a FieldType.
struct sim::MessageForm {
  nlohmann::json (*encode)(const void* value, playerlike::protocol::Encoding encoding);
  void (*decode)(const nlohmann::json& object, const char* key,
                 playerlike::protocol::Encoding encoding, void* value);
};

namespace playerlike::protocol {

/// Adds the fields of a struct to a message. An empty std::optional adds null if its field says so,
/// else nothing.
///
/// A vector or pose without a name becomes the members "x", "y" (and "yaw") of the message itself.
/// With a name, it becomes an object of these. A vector with the name "goal_" becomes the members
/// "goal_x" and "goal_y". "own.ip" is the member "ip" of an object "own". A keyed list is an
/// object: its keys are the first field of the elements, its values the second.
/// @tparam Json  json, or nlohmann::ordered_json, which keeps the order of fields and elements.
template <typename Json>
void write_fields(const sim::FieldTable& table, const void* object, Json& out, Encoding encoding);

/// Reads the fields that write_fields() writes; ignores keys that are not in the table. @throws
/// ProtocolError protocol/bad-value (see codec.h), also if the table's check fails.
template <typename Json>
void read_fields(const sim::FieldTable& table, const Json& in, Encoding encoding, void* object);

/// The value of a field that has a name. @pre it is not empty.
[[nodiscard]] json encode_field(const sim::Field& field, const void* value, Encoding encoding);
/// Reads the member of `in` that encode_field() has made. @throws ProtocolError protocol/bad-value.
void decode_field(const sim::Field& field, const json& in, Encoding encoding, void* value);
/// Whether the components of a field's value are members of the message itself.
[[nodiscard]] bool is_in_place(const sim::Field& field) noexcept;
/// The position of the dot in "own.ip"; null if there is none.
[[nodiscard]] const char* dot_in(const sim::Field& field) noexcept;

/// The keys of a struct's message in the table's order.
[[nodiscard]] std::vector<std::string> keys_of(const sim::FieldTable& table);

/// Refuses keys that are neither in `more` nor in the table; see refuse_unknown_keys() in codec.h.
void refuse_unknown_keys(const json& object, std::initializer_list<std::string_view> more,
                         const sim::FieldTable& table, std::string_view what);

/// The readings of a type of device. @throws ProtocolError protocol/bad-value if it makes none.
[[nodiscard]] const sim::ReadingKind& reading_kind(std::string_view type);

/// A list of texts. @param expected  describes it in errors; nullptr: a list of names.
[[nodiscard]] std::vector<std::string> require_texts(const json& in, const char* key,
                                                     const char* expected);

/// Encodes an alternative of a variant: its name as "kind", and its fields.
template <typename Variant>
[[nodiscard]] json encode_alternative(std::span<const sim::AlternativeKind<Variant>> kinds,
                                      const Variant& value) {
  const sim::AlternativeKind<Variant>& kind = kinds[value.index()];
  json out = {{"kind", kind.name}};
  write_fields(kind.fields(), sim::object_in(value), out, Encoding::kJson);
  return out;
}

/// Decodes the messages of encode_alternative(); refuses unknown kinds and keys.
/// @param what  describes the message in errors: "a command".
template <typename Variant>
[[nodiscard]] Variant decode_alternative(std::span<const sim::AlternativeKind<Variant>> kinds,
                                         const json& in, const std::string& what) {
  const std::string name = require_text(in, "kind");
  std::string names;
  for (const sim::AlternativeKind<Variant>& kind : kinds) {
    names += (names.empty() ? "" : ", ") + std::string(kind.name);
    if (kind.name != name) continue;
    refuse_unknown_keys(in, {"kind"}, kind.fields(), what + ' ' + name);
    Variant value = kind.make();
    read_fields(kind.fields(), in, Encoding::kJson, sim::object_in(value));
    return value;
  }
  refuse_value("kind", "one of " + names, in.at("kind"));
}

}  // namespace playerlike::protocol
