// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/codec.h"
#include "sim/core/fields.h"

namespace playerlike::protocol {

/// Adds the fields of a struct to a message. An empty std::optional adds nothing.
///
/// A vector or pose without a name becomes the members "x", "y" (and "yaw") of the message itself.
/// With a name, it becomes an object of these. "own.ip" is the member "ip" of an object "own".
void write_fields(const sim::FieldTable& table, const void* object, json& out, Encoding encoding);

/// Reads the fields that write_fields() writes; ignores keys that are not in the table. @throws
/// ProtocolError protocol/bad-value (see codec.h), also if the table's check fails.
void read_fields(const sim::FieldTable& table, const json& in, Encoding encoding, void* object);

/// The keys of a struct's message in the table's order.
[[nodiscard]] std::vector<std::string_view> keys_of(const sim::FieldTable& table);

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
    std::vector<std::string_view> keys = keys_of(kind.fields());
    keys.insert(keys.begin(), "kind");
    refuse_unknown_keys(in, keys, what + ' ' + name);
    Variant value = kind.make();
    read_fields(kind.fields(), in, Encoding::kJson, sim::object_in(value));
    return value;
  }
  refuse_value("kind", "one of " + names, in.at("kind"));
}

}  // namespace playerlike::protocol
