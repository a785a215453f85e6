// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <optional>
#include <type_traits>

/// @file
/// Conversion between Player's structs and the simulation's values. Each pair of types has an
/// overload same_values(players, value, same), which calls same() with each field and the member
/// that has the same meaning. It serves both directions.
namespace playerlike {

/// U or const U.
template <typename T, typename U>
concept MaybeConst = std::same_as<std::remove_const_t<T>, U>;

/// A number of a message, which is unsigned; readings count with int.
[[nodiscard]] constexpr int as_int(std::uint32_t value) {
  return static_cast<int>(value < 0x7fffffffU ? value : 0x7fffffffU);
}

/// A number as another type.
template <typename To, typename From>
[[nodiscard]] constexpr To number_as(From from) {
  if constexpr (std::is_same_v<To, int> && std::is_same_v<From, std::uint32_t>) {
    return as_int(from);
  } else {
    return static_cast<To>(from);
  }
}

/// Copies values to Player's fields, or back. Elements of lists and members of structs are copied
/// one by one.
template <bool kToPlayer>
struct CopyValues {
  template <typename Field, typename Value>
  void operator()(Field& field, Value& value) const {
    if constexpr (std::is_arithmetic_v<Field>) {
      if constexpr (kToPlayer) {
        field = number_as<Field>(value);
      } else {
        value = number_as<Value>(field);
      }
    } else if constexpr (requires { field.size(); }) {
      if constexpr (kToPlayer) {
        field.resize(value.size());
      } else {
        value.resize(field.size());
      }
      for (std::size_t i = 0; i < field.size(); ++i) (*this)(field[i], value[i]);
    } else {
      same_values(field, value, *this);
    }
  }
  /// Copies a value that Player has in another form. @param to, from  functions that convert it.
  template <typename Field, typename Value, typename To, typename From>
  void converted(Field& field, Value& value, To to, From from) const {
    if constexpr (kToPlayer) {
      field = static_cast<Field>(to(value));
    } else {
      value = from(field);
    }
  }
};

/// A value as one of Player's structs.
template <typename Players, typename Value>
[[nodiscard]] Players to_players(const Value& value) {
  Players players = {};
  CopyValues<true>()(players, value);
  return players;
}
/// The value that one of Player's structs describes. @param value  has the members without a field.
template <typename Value, typename Players>
[[nodiscard]] Value from_players(const Players& players, Value value = {}) {
  CopyValues<false>()(players, value);
  return value;
}

/// A value and its code in Player's interface.
template <typename Value>
struct Code {
  Value value;
  std::uint8_t code;
};

/// The code of a value. @pre the table contains it.
template <typename Value, std::size_t kCount>
[[nodiscard]] std::uint8_t code_of(const Code<Value> (&table)[kCount], Value value) noexcept {
  return std::ranges::find(table, value, &Code<Value>::value)->code;
}

/// The value of a code; nullopt if there is none.
template <typename Value, std::size_t kCount>
[[nodiscard]] std::optional<Value> value_of(const Code<Value> (&table)[kCount], int code) noexcept {
  const auto* row = std::ranges::find(table, code, &Code<Value>::code);
  return row != std::end(table) ? std::optional(row->value) : std::nullopt;
}

}  // namespace playerlike
