// Copyright (c) 2026 The Playpen authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <optional>

/// @file
/// Values and their codes in Player's interfaces.
namespace playerlike {

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
